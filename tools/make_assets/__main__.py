"""Makes the models in assets/: python3 tools/make_assets [show] [lab] [head] [body] [wiimote]. Same
bytes each time.
"""

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


def main(wanted):
    unknown = [name for name in wanted if name not in MODELS]
    if unknown:
        sys.exit(f"make_assets: '{unknown[0]}' is none of {', '.join(MODELS)}")
    for name in wanted or MODELS:
        make, file = MODELS[name]
        (ASSETS / file).parent.mkdir(parents=True, exist_ok=True)
        make(ASSETS / file)


if __name__ == "__main__":
    main(sys.argv[1:])
