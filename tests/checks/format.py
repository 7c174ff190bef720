#!/usr/bin/env python3
"""Every C++ source is formatted as .clang-format says.

Usage: format.py ROOT CLANG_FORMAT. To repair: clang-format -i FILE.
"""
import subprocess
import sys

from sources import cpp_sources


def unformatted(root, clang_format):
    """What clang-format would change, as its own lines of error; empty when nothing."""
    files = [path.as_posix() for path in cpp_sources(root)]
    run = subprocess.run([clang_format, "--dry-run", "-Werror", "--style=file", *files], cwd=root,
                         capture_output=True, text=True, check=False)
    return run.stderr if run.returncode else ""


if __name__ == "__main__":
    found = unformatted(*sys.argv[1:])
    print(found or "every source is formatted")
    sys.exit(1 if found else 0)
