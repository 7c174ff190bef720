#!/usr/bin/env python3
"""The models in assets/ are what tools/make_assets makes, byte by byte.

Usage: assets.py ROOT [NAME...]: these models, or all. Prints each file that is not; exit code 1
when there is one.
"""
import subprocess
import sys
import tempfile
from pathlib import Path


def differing(made, kept):
    """Files of the folder `made` that `kept` lacks or has with other bytes, in order of name."""
    files = sorted(path.relative_to(made) for path in made.rglob("*") if path.is_file())
    return [file for file in files
            if not (kept / file).is_file()
            or (made / file).read_bytes() != (kept / file).read_bytes()]


def main(root, names):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-B", root / "tools/make_assets", "--out", folder, *names],
                       check=True)
        found = differing(Path(folder), root / "assets")
    for file in found:
        print(f"assets/{file} is not what tools/make_assets makes: make it anew")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2:]))
