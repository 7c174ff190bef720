"""Makes the models in assets/: python3 tools/make_assets [show] [lab] [head] [body] [wiimote]. Same bytes each time."""

import pathlib
import sys

ASSETS = pathlib.Path(__file__).resolve().parents[2] / "assets"


def main(wanted):
    known = {"show": "show/show.glb"}
    for name in wanted or known:
        if name not in known:
            sys.exit(f"make_assets: '{name}' is none of {', '.join(known)}")
        file = ASSETS / known[name]
        file.parent.mkdir(parents=True, exist_ok=True)
        module = __import__("show" if name == "show" else "laboratory")
        getattr(module, "make" if name == "show" else f"make_{name}")(file)


if __name__ == "__main__":
    main(sys.argv[1:])
