#!/usr/bin/env python3
"""clang-tidy over every source of Vindu, by .clang-tidy, with the commands of the preset dev.

Usage: tidy.py [REGEX ...]: those sources alone whose path matches one: tools/tidy.py core/frustum.
Configures a build of its own for those commands, build/tidy. A source that was clean is remembered
in build/tidy-clean by its text, that of all headers of the project that it includes, and the
settings; it is looked at again when one of them changes. So a run that is stopped goes on where it
was. Tests and benches are not analysed (clang-analyzer-*).
"""
import concurrent.futures
import hashlib
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
MOST = 12  # sources that are looked at as one; CMAKE_UNITY_BUILD_BATCH_SIZE of tools/common.sh
FOLDERS = ("core", "tracker", "cluster", "renderer", "simulator", "app", "bench", "tests")
# The static analyzer follows every path through GoogleTest's macros: minutes for nothing.
UNANALYSED = ("bench", "tests")


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


def configure(root):
    """The commands, and the sources that are generated."""
    for command in (["cmake", "--preset", "dev", "-B", str(root / "build/tidy"),
                     "-DVINDU_TESTS=ON", "-DVINDU_BENCH=ON"],
                    ["cmake", "--build", str(root / "build/tidy"),
                     "--target", "vindu_wire_sources_generate"]):
        done = subprocess.run(command, capture_output=True, text=True, cwd=root)
        if done.returncode:
            sys.exit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")


def sources_to_check(root, patterns):
    """(source, compile command) of each that stands in the database, once, in its order."""
    database = json.loads((root / "build/tidy/compile_commands.json").read_text())
    found = {}
    for entry in database:
        path = Path(entry["directory"], entry["file"])
        if not path.is_relative_to(root):
            continue
        source = path.relative_to(root)
        wanted = not patterns or any(re.search(p, source.as_posix()) for p in patterns)
        if source.parts[0] in FOLDERS and wanted:
            found.setdefault(source, entry["command"])
    return list(found.items())


def flags_of(command):
    """Those of a compile command, without compiler, source and output."""
    words = shlex.split(command)
    first = next(i for i, word in enumerate(words) if word.startswith("-"))
    flags, skip = [], False
    for word in words[first:]:
        if skip or word in ("-MD", "-Werror"):
            skip = False
        elif word in ("-o", "-c", "-MT", "-MF"):
            skip = True
        else:
            flags.append(word)
    return flags


def target_of(command):
    """"tests/core/CMakeFiles/core_test.dir" of what is compiled for it."""
    return re.search(r"-o (\S*\.dir)/", command)[1]


def batches_of(waiting):
    """Sources of one target that are compiled alike, up to MOST of them each: as the build joins
    them, so that names do not clash."""
    alike = {}
    for source, command in waiting:
        key = (target_of(command), source.parts[0] in UNANALYSED, tuple(flags_of(command)))
        alike.setdefault(key, []).append(source)
    return [(sources[i:i + MOST], flags)
            for (*_, flags), sources in alike.items() for i in range(0, len(sources), MOST)]


def joined(root, sources):
    """The text of all of them, and for each of its lines the source's line that it is. What sources
    before have included is not included again: it would be called a duplicate."""
    lines, places, before = [], [], set()
    for source in sources:
        own = set()
        for number, line in enumerate((root / source).read_text(encoding="utf-8").splitlines(), 1):
            included = line.startswith("#include ")
            lines.append("" if included and line in before - own else line)
            places.append((source, number))
            if included:
                own.add(line)
        before |= own
    return "\n".join(lines) + "\n", places


def findings_in(root, sources, flags, file):
    """[(sources, what clang-tidy says of them)]; empty where they are clean. They are looked at as
    one, since most of the time goes into the headers; where names of theirs clash, halved."""
    text, places = joined(root, sources)
    file.write_text(text, encoding="utf-8")
    checks = ["--checks=-clang-analyzer-*"] if sources[0].parts[0] in UNANALYSED else []
    result = subprocess.run(["clang-tidy", "-quiet", *checks, str(file), "--", *flags],
                            capture_output=True, text=True, cwd=root / "build/tidy")
    if result.returncode == 0:
        return [(sources, "")]
    if "[clang-diagnostic-error]" in result.stdout and len(sources) > 1:
        half = len(sources) // 2
        return (findings_in(root, sources[:half], flags, file) +
                findings_in(root, sources[half:], flags, file))

    def place(found):
        source, number = places[int(found[1]) - 1]
        return f"{root / source}:{number}:"
    said = re.sub(re.escape(str(file)) + r":(\d+):", place, result.stdout or result.stderr)
    return [(sources, said)]


def main(patterns):
    configure(ROOT)
    clean, settings = ROOT / "build/tidy-clean", settings_of(ROOT)
    clean.mkdir(parents=True, exist_ok=True)
    commands = dict(sources_to_check(ROOT, patterns))
    keys = {source: key_of(ROOT, source, command, settings) for source, command in commands.items()}
    waiting = [(source, commands[source]) for source, key in keys.items()
               if not (clean / key).exists()]
    print(f"{len(keys)} sources, {len(keys) - len(waiting)} of them known to be clean", flush=True)
    done = bad = 0
    with (concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool,
          tempfile.TemporaryDirectory(dir=clean.parent) as folder):
        looks = [pool.submit(findings_in, ROOT, sources, flags, Path(folder, f"{number}.cpp"))
                 for number, (sources, flags) in enumerate(batches_of(waiting))]
        for look in concurrent.futures.as_completed(looks):
            for sources, found in look.result():
                done += len(sources)
                names = ", ".join(str(source) for source in sources)
                print(f"[{done}/{len(waiting)}] {names}{': ' if found else ''}\n{found}".rstrip(),
                      flush=True)
                bad += bool(found)
                for source in sources if not found else ():
                    (clean / keys[source]).touch()
    if bad:
        sys.exit("clang-tidy found something.")


if __name__ == "__main__":
    main(sys.argv[1:])
