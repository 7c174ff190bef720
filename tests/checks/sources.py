"""Which files are Vindu's own sources: what every check looks at."""
import pathlib

FOLDERS = ("core", "tracker", "cluster", "renderer", "simulator", "app", "tests", "bench")
OTHER_FOLDERS = ("shaders", "tools")
CPP = {".h", ".cpp"}
ROOT_SCRIPTS = ("run", "test", ".ci/run")
OTHER = {".vert", ".frag", ".comp", ".geom", ".glsl", ".py", ".sh"}


def cpp_sources(root):
    """Headers and sources, as paths relative to root, in order of name."""
    return _sources(root, FOLDERS, CPP)


def all_sources(root):
    """These, shaders and scripts."""
    scripts = [pathlib.Path(name) for name in ROOT_SCRIPTS if (pathlib.Path(root) / name).is_file()]
    return scripts + _sources(root, FOLDERS + OTHER_FOLDERS, CPP | OTHER)


def _sources(root, folders, suffixes):
    root = pathlib.Path(root)
    files = (path for folder in folders for path in (root / folder).rglob("*"))
    return sorted(path.relative_to(root) for path in files if path.suffix in suffixes)
