#!/usr/bin/env python3
"""The shape of the sources: no line over 100 columns, no file over 500 lines, no header without
`#pragma once` (all fail), and the sizes of files and functions, printed and not judged.

Usage: shape.py ROOT. Functions are found by the format that clang-format gives them: they open with
a line at column 0 that ends in "{" and close with a "}" at column 0; those inside a class body are
short and not counted.
"""
import re
import sys
from pathlib import Path

from sources import all_sources

COLUMNS = 100
LINES = 500
NO_FUNCTION = re.compile(r"^(template .*)?(namespace|class|struct|enum|union|extern)\b|= \{$")


def function_sizes(lines):
    """(name line, lines between the braces included) of every function at namespace level."""
    start = opened = None
    for number, line in enumerate(lines):
        at_margin = line and not line[0].isspace()
        if opened is not None:
            if line.startswith("}"):
                yield lines[start], number - start + 1
                start = opened = None
        elif at_margin and not line.startswith(("//", "#", "}", "/*")):
            start = number if start is None else start
            if line.endswith(";"):
                start = None
        elif not line.strip():
            start = None
        if opened is None and start is not None and line.endswith("{"):
            if NO_FUNCTION.search(lines[start]) or "(" not in "".join(lines[start:number + 1]):
                start = None
            else:
                opened = number


def breaches(root):
    for path in all_sources(root):
        lines = (Path(root) / path).read_text(encoding="utf-8").splitlines()
        if len(lines) > LINES:
            yield f"{path}: {len(lines)} lines; at most {LINES}: split it"
        if path.suffix == ".h" and "#pragma once" not in lines:
            yield f"{path}: no #pragma once: it cannot be included twice"
        for number, line in enumerate(lines, 1):
            if len(line) > COLUMNS:
                yield f"{path}:{number}: {len(line)} columns; at most {COLUMNS}"


def quantile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))] if values else 0


def spread(lengths):
    return f"median {quantile(lengths, 0.5)}, p90 {quantile(lengths, 0.9)}"


def report(root):
    root, sizes, functions = Path(root), {}, []
    for path in all_sources(root):
        lines = (root / path).read_text(encoding="utf-8").splitlines()
        kind = "test" if path.parts[0] == "tests" else path.suffix or "script"
        sizes.setdefault(kind, []).append((len(lines), path))
        if path.suffix == ".cpp" and kind != "test":
            functions += [(size, path, name) for name, size in function_sizes(lines)]
    for kind, files in sorted(sizes.items()):
        lengths = [length for length, _ in files]
        print(f"{kind:6} {len(files):4} files, {sum(lengths):6} lines, {spread(lengths)}, "
              f"longest {max(files)[1]} ({max(lengths)})")
    lengths = [size for size, _, _ in functions]
    print(f"{len(functions)} functions, lines each: {spread(lengths)}")
    for size, path, name in sorted(functions, reverse=True)[:5]:
        print(f"  {size:3} lines: {path}: {name[:70]}")


if __name__ == "__main__":
    found = list(breaches(sys.argv[1]))
    report(sys.argv[1])
    print("\n".join(found))
    sys.exit(1 if found else 0)
