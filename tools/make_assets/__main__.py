"""Makes the models in assets/, the same bytes each time (tests/checks/assets.py):
python3 tools/make_assets [--out FOLDER] [show] [lab] [head] [body] [wiimote]
"""

import argparse
import pathlib
import sys

import body
import head
import laboratory
import show
import wiimote

ASSETS = pathlib.Path(__file__).resolve().parents[2] / "assets"
MODELS = {
    "show": (show.make, "show/show.glb"),
    "lab": (laboratory.make_lab, "lab/lab.glb"),
    "wiimote": (wiimote.make_wiimote, "lab/wiimote.glb"),
    "head": (head.make_head, "lab/head.glb"),
    "body": (body.make_body, "lab/body.glb"),
}


def main():
    parser = argparse.ArgumentParser(prog="make_assets")
    parser.add_argument("--out", type=pathlib.Path, default=ASSETS, help="default: assets/")
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(MODELS))
    asked = parser.parse_args()
    unknown = [name for name in asked.names if name not in MODELS]
    if unknown:
        sys.exit(f"make_assets: '{unknown[0]}' is none of {', '.join(MODELS)}")
    for name in asked.names or MODELS:
        make, file = MODELS[name]
        (asked.out / file).parent.mkdir(parents=True, exist_ok=True)
        make(asked.out / file)


if __name__ == "__main__":
    main()
