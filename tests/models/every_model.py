#!/usr/bin/env python3
"""Every model of Debian's assimp-testmodels through the real program: each gives a picture with
something in it, or one clear line of error and exit code 1. What else happens fails: a crash, a
hang, more than 4 GiB, an empty picture without a word.

Usage: every_model.py VINDU OUT [--sample N] [--only TEXT] [--jobs N] [--models DIR]

Which models are errors stands in errors.txt beside this file, with words of the reason; one that
gives a picture none the less, or another reason, fails too. OUT gets the pictures and index.html, a
contact sheet with what was said. Needs nothing but Python.
"""
import argparse
import concurrent.futures
import html
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from pictures import differing_pixels, read_png

# What lies beside models: their textures, parts and texts.
COMPANIONS = {".png", ".jpg", ".tga", ".bmp", ".txt", ".bin", ".mtl", ".glsl", ".vert", ".frag",
              ".md", ".uc", ".material"}
NO_MODELS = {"README", "LICENSE"}
NO_MODEL_FOLDERS = {"ReferenceImages", "ParsingFiles"}

WALL = """[wall]
columns = 1
rows = 1
width_m = 1.6
height_m = 1.2
tile_width_px = 640
tile_height_px = 480
"""
SCALE = "0.5"
EYE = "0.4,0.5,2"  # beside and above: no plane along two axes is seen by its edge
MOST_MIB = 4096
LEAST_PIXELS = 30  # of 320 x 240
PATIENCE_S = 90  # 30 more than the program gives a reader; and one for each MiB


@dataclass
class Outcome:
    model: Path
    kind: str  # picture, error, or what is wrong
    words: str = ""
    warnings: list = field(default_factory=list)
    seconds: float = 0
    mib: float = 0
    picture: Path = None

    @property
    def wrong(self):
        return self.kind not in ("picture", "error")


def format_of(model):
    return model.suffix.lower() or "(none)"


def all_models(folder):
    return sorted(path.relative_to(folder) for path in folder.rglob("*")
                  if path.is_file() and path.suffix.lower() not in COMPANIONS
                  and path.name not in NO_MODELS
                  and path.relative_to(folder).parts[0] not in NO_MODEL_FOLDERS)


def expected_errors(file):
    """{model: words of its error}"""
    lines = [line for line in file.read_text(encoding="utf-8").splitlines()
             if line and not line.startswith("#")]
    return {Path(model): words for model, _, words in (line.partition(": ") for line in lines)}


def sample(models, errors, count):
    """One of every format, those that give a picture first, then the second of each, and so on."""
    of_format = {}
    for model in sorted(models, key=lambda model: (model in errors, model)):
        of_format.setdefault(format_of(model), []).append(model)
    rounds = [(number, model in errors, model) for several in of_format.values()
              for number, model in enumerate(several)]
    return sorted(model for _, _, model in sorted(rounds)[:count])


class Runner:
    def __init__(self, vindu, out, models):
        self.vindu, self.out, self.models, self.nothing = vindu, out, models, None
        if out.exists():
            shutil.rmtree(out)
        (out / "cache").mkdir(parents=True)
        (out / "wall.toml").write_text(WALL)
        behind = out / "behind_the_eye.obj"
        behind.write_text("v 0 0 99\nv 1 0 99\nv 0 1 99\nf 1 2 3\n")
        seen = self.start(behind, out / "nothing", "--place", "as-is")
        if seen.kind != "nothing to see":
            sys.exit(f"no picture of nothing: {seen.words}")
        self.nothing = read_png(seen.picture)

    def run(self, model):
        return self.start(self.models / model, self.out / "pictures" / model)

    def start(self, file, folder, *more):
        folder.mkdir(parents=True)
        words = [self.vindu, "render", file, "--wall", self.out / "wall.toml", "--tile", "tile-0-0",
                 "--scale", SCALE, "--eye", EYE, "--out", folder, *more]
        environment = dict(os.environ, XDG_CACHE_HOME=str(self.out / "cache"))
        patience = PATIENCE_S + file.stat().st_size / 2**20
        begun = time.monotonic()
        with open(folder / "said", "wb") as said:
            process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=said,
                                       stdin=subprocess.DEVNULL, env=environment,
                                       start_new_session=True)
        status, usage = wait(process, begun + patience)
        said = (folder / "said").read_text(encoding="utf-8", errors="replace").splitlines()
        outcome = self.judge(file, folder / "tile-0-0.png", status, said)
        outcome.seconds, outcome.mib = time.monotonic() - begun, usage.ru_maxrss / 1024
        if outcome.mib > MOST_MIB:
            outcome.kind = "takes more than 4 GiB"
        return outcome

    def judge(self, file, picture, status, said):
        errors = [line for line in said if line.startswith("vindu: ")]
        others = [line for line in said if not line.startswith("vindu: ")]
        outcome = Outcome(file.relative_to(self.models) if self.models in file.parents else file,
                          "", "\n".join(errors),
                          [line for line in others if line.startswith("warning ")])
        if status is None:
            outcome.kind = "hangs"
        elif status == 1:
            clear = len(errors) == 1 and len(errors[0]) < 600 and str(file) in errors[0]
            outcome.kind = "error" if clear else "no clear error"
            outcome.words = "\n".join(said) if not clear else \
                errors[0].removeprefix("vindu: ").removeprefix(f"{file}: ")
        elif status != 0:
            outcome.kind, outcome.words = f"ends with {status}", "\n".join(said)
        else:
            pixels = read_png(picture)
            seen = differing_pixels(pixels, self.nothing) if self.nothing else 0
            outcome.kind = "picture" if seen >= LEAST_PIXELS else "nothing to see"
            outcome.picture = picture
        return outcome


def wait(process, until):
    """Exit code, None where it was killed for taking too long, and what it and the processes that
    it waited for have used."""
    late = False
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            process.returncode = os.waitstatus_to_exitcode(status)
            return (None if late else process.returncode), usage
        if time.monotonic() > until and not late:
            late = True
            os.killpg(process.pid, signal.SIGKILL)
        time.sleep(0.01)


def compare(outcome, errors):
    """With what is known of the model."""
    known = errors.get(outcome.model)
    if outcome.kind == "error" and known is None:
        outcome.kind = "gave a picture once"
    elif outcome.kind == "error" and known not in outcome.words:
        outcome.kind = f"another error than \"{known}\""
    elif outcome.kind == "picture" and known is not None:
        outcome.kind = "a picture, though errors.txt names it"


def report(outcome, progress):
    """On a terminal over the last line; what is wrong stays."""
    why = f": {outcome.words}" if outcome.wrong else ""
    line = f"{progress} {outcome.kind:8} {outcome.model}{why}"
    if sys.stdout.isatty():
        line = "\r\033[K" + line + ("\n" if outcome.wrong else "")
    print(line, end="" if sys.stdout.isatty() else "\n", flush=True)


def table(outcomes):
    formats = {}
    for outcome in outcomes:
        formats.setdefault(format_of(outcome.model), []).append(outcome)
    yield f"  {'FORMAT':10}{'FILES':>6}{'PICTURES':>10}{'ERRORS':>8}{'WRONG':>7}{'s':>8}{'MiB':>7}"
    for name, of in sorted(formats.items()) + [("all", outcomes)]:
        count = [sum(o.kind == kind for o in of) for kind in ("picture", "error")]
        yield (f"  {name:10}{len(of):6}{count[0]:10}{count[1]:8}{sum(o.wrong for o in of):7}"
               f"{max(o.seconds for o in of):8.1f}{max(o.mib for o in of):7.0f}")
    for what, key in (("slowest", lambda o: o.seconds), ("largest", lambda o: o.mib)):
        most = sorted(outcomes, key=key, reverse=True)[:3]
        yield f"  {what}: " + ", ".join(f"{o.model} {o.seconds:.1f} s {o.mib:.0f} MiB"
                                        for o in most)


def sheet(outcomes, out):
    """All pictures on one page, with what was said of each."""
    cells = []
    for o in outcomes:
        picture = f'<img src="{html.escape(str(o.picture.relative_to(out)))}">' if o.picture else ""
        text = html.escape("\n".join([o.kind, o.words, *o.warnings]).strip())
        cells.append(f"<figure>{picture}<figcaption><b>{html.escape(str(o.model))}</b>"
                     f"<pre>{text}</pre></figcaption></figure>")
    style = ("figure{display:inline-block;width:320px;margin:4px;vertical-align:top}"
             "pre{white-space:pre-wrap}")
    (out / "index.html").write_text("<!doctype html><meta charset=utf-8>"
                                    f"<style>{style}</style>" + "\n".join(cells), encoding="utf-8")


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("vindu", type=Path)
    parser.add_argument("out", type=Path, help="a folder, emptied first")
    parser.add_argument("--models", type=Path, default=Path("/usr/share/assimp/models"))
    parser.add_argument("--sample", type=int, help="so many, of as many formats as can be")
    parser.add_argument("--only", default="", help="those with this in their path")
    parser.add_argument("--jobs", type=int, default=2)
    return parser.parse_args(words)


def main(words):
    options = parse(words)
    errors = expected_errors(Path(__file__).with_name("errors.txt"))
    models = [model for model in all_models(options.models) if options.only in str(model)]
    if not models:
        sys.exit(f"no models in {options.models}; apt-get install assimp-testmodels")
    if options.sample:
        models = sample(models, errors, options.sample)
    runner = Runner(options.vindu.absolute(), options.out.absolute(), options.models)
    outcomes = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for outcome in pool.map(runner.run, models):
            compare(outcome, errors)
            outcomes.append(outcome)
            report(outcome, f"{len(outcomes):4}/{len(models)}")
    sheet(outcomes, options.out.absolute())
    print("\n" + "\n".join(table(outcomes)))
    print(f"  all pictures: {options.out}/index.html")
    return 1 if any(outcome.wrong for outcome in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
