#!/usr/bin/env python3
"""clang-tidy over every source of Vindu, by .clang-tidy, with the commands of the preset dev.

Usage: tidy.py [REGEX ...]: those sources alone whose path matches one: tools/tidy.py core/frustum.
Needs a configured build (./test). A source that was clean is remembered in build/tidy-clean by its
text, that of all headers of the project that it includes, and the settings; it is looked at again
when one of them changes. So a run that is stopped goes on where it was.
"""
import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
FOLDERS = ("core", "tracker", "cluster", "renderer", "simulator", "app", "bench", "tests")


def texts_behind(root, source):
    """The source and, through any number of includes, the project's headers: path -> bytes."""
    texts, waiting = {}, [source]
    while waiting:
        path = waiting.pop()
        if path in texts:
            continue
        texts[path] = (root / path).read_bytes()
        for name in INCLUDE.findall(texts[path].decode("utf-8", "replace")):
            for candidate in (Path(name), path.parent / name):
                if (root / candidate).is_file():
                    waiting.append(candidate)
                    break
    return texts


def key_of(root, source, command, settings):
    digest = hashlib.sha256(settings + command.encode())
    for path, text in sorted(texts_behind(root, source).items()):
        digest.update(f"{path}\0{len(text)}\0".encode() + text)
    return digest.hexdigest()


def settings_of(root):
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    return (root / ".clang-tidy").read_bytes() + version


def sources_to_check(root, patterns):
    """(source, compile command) of each that stands in the database, once."""
    database = json.loads((root / "build/dev/compile_commands.json").read_text())
    found = {}
    for entry in database:
        path = Path(entry["directory"], entry["file"])
        if not path.is_relative_to(root):
            continue
        source = path.relative_to(root)
        wanted = not patterns or any(re.search(p, source.as_posix()) for p in patterns)
        if source.parts[0] in FOLDERS and wanted:
            found.setdefault(source, entry["command"])
    return sorted(found.items())


def findings_in(root, source):
    """What clang-tidy says of the source; empty where it is clean."""
    result = subprocess.run(
        ["clang-tidy", "-quiet", "-p", str(root / "build/dev"), str(root / source)],
        capture_output=True, text=True)
    return "" if result.returncode == 0 else result.stdout or result.stderr


def main(patterns):
    if not (ROOT / "build/dev/compile_commands.json").is_file():
        sys.exit("build/dev is not configured: run ./test first.")
    clean, settings = ROOT / "build/tidy-clean", settings_of(ROOT)
    clean.mkdir(parents=True, exist_ok=True)
    keys = {source: key_of(ROOT, source, command, settings)
            for source, command in sources_to_check(ROOT, patterns)}
    waiting = [source for source, key in keys.items() if not (clean / key).exists()]
    print(f"{len(keys)} sources, {len(keys) - len(waiting)} of them known to be clean", flush=True)
    bad = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for number, (source, found) in enumerate(
                zip(waiting, pool.map(lambda s: findings_in(ROOT, s), waiting)), 1):
            print(f"[{number}/{len(waiting)}] {source}{': ' if found else ''}\n{found}".rstrip(),
                  flush=True)
            bad += bool(found)
            if not found:
                (clean / keys[source]).touch()
    if bad:
        sys.exit(f"clang-tidy found something in {bad} sources.")


if __name__ == "__main__":
    main(sys.argv[1:])
