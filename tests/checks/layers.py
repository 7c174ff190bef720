#!/usr/bin/env python3
"""The layer rule over the includes: core <- tracker, cluster, renderer <- simulator <- app,
siblings apart from each other, every third-party library private to the folder that it belongs to,
and the emulated Wiimote apart from what reads it.

Usage: layers.py ROOT. Prints each include that breaks the rule; exit code 1 when there is one.
"""
import re
import sys
from pathlib import Path

from sources import cpp_sources

# Folder -> the folders whose headers it may include, besides its own.
LAYERS = {
    "core": set(),
    "tracker": {"core"},
    "cluster": {"core"},
    "renderer": {"core"},
    "simulator": {"core", "tracker", "cluster", "renderer"},
    "app": {"core", "tracker", "cluster", "renderer", "simulator"},
}

# Library -> (how its headers begin, where they may show). No other library may show at all.
LIBRARIES = {
    "Eigen": (r"Eigen/", r".*"),
    "OpenCV": (r"opencv2/", r"tracker/.*"),
    "Ceres": (r"ceres/", r"tracker/calibration/.*"),
    "hidapi": (r"hidapi", r"tracker/wiimote/hidapi_bus\.cpp"),
    "zlib": (r"zlib\.h", r"tracker/[^/]*\.cpp"),
    "sdbus-c++": (r"sdbus-c\+\+/", r"tracker/wiimote/bluez_client\.cpp"),
    "Cyclone DDS": (r"dds/|wire\.h", r"cluster/[^/]*\.cpp|cluster/internal/.*"),
    "OpenSSL": (r"openssl/", r"cluster/keys/.*|core/sha256\.cpp"),
    "GLFW": (r"GLFW/", r"renderer/.*"),
    "EGL": (r"EGL/", r"renderer/.*"),
    "epoxy": (r"epoxy/|GL/|GLES\d?/", r"renderer/.*"),
    "Assimp": (r"assimp/", r"renderer/.*"),
    "meshoptimizer": (r"meshoptimizer\.h", r"renderer/[^/]*\.cpp"),
    "GLM": (r"glm/", r"renderer/.*"),
    "libpng": (r"png\.h", r"renderer/.*"),
    "stb": (r"stb(/|_)", r"renderer/.*"),
    "toml++": (r"toml\+\+/|toml\.hpp", r"core/[^/]*\.cpp|core/internal/.*"),
    "spdlog": (r"spdlog/", r"core/[^/]*\.cpp|core/internal/.*"),
    "fmt": (r"fmt/", r".*\.cpp"),
    "liblo": (r"lo/", r"app/.*"),
    "CLI11": (r"CLI/", r"app/.*"),
}

# Of C++ itself, of POSIX and of Linux.
SYSTEM = re.compile(
    r"[a-z_]+|(sys|net|arpa|linux)/\w+\.h"
    r"|(dlfcn|fcntl|ifaddrs|malloc|netdb|poll|spawn|unistd)\.h")

# The emulator and the driver share no code, so that a layout misread on one side cannot cancel out
# on the other: (files, tracker's headers that they may not include).
EMULATOR = r"tracker/wiimote/(emulator|uhid_device)"
STRANGERS = [
    (EMULATOR, r"tracker/(?!wiimote/(emulator|uhid_device|hid_device\.h))"),
    (r"tracker/(?!wiimote/(emulator|uhid_device))", EMULATOR),
]

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def broken_layer(file, header):
    """Why a header of ours may not be included by `file`, or None."""
    folder, target = file.split("/")[0], header.split("/")[0]
    if target != folder and target not in LAYERS[folder]:
        return f"{folder} does not know {target}"
    if header.startswith("core/internal/") and folder != "core":
        return "core/internal is core's own"
    if any(re.match(files, file) and re.match(headers, header) for files, headers in STRANGERS):
        return "the emulated Wiimote and what reads it share no code"
    return None


def broken_rule(file, header):
    """Why `file` may not include `header`, or None. Both relative to the root."""
    if ".." in header.split("/"):
        return "write the path from the root"
    if header.split("/")[0] in LAYERS:
        return broken_layer(file, header)
    for library, (begins, places) in LIBRARIES.items():
        if re.match(begins, header):
            known = re.fullmatch(places, file)
            return None if known else f"{library} may show only in {places}"
    return None if SYSTEM.fullmatch(header) else "of no library that layers.py knows"


def violations(root):
    for path in cpp_sources(root):
        file = path.as_posix()
        if file.split("/")[0] not in LAYERS:  # tests and benches stand above all layers
            continue
        text = (Path(root) / path).read_text(encoding="utf-8")
        for number, line in enumerate(text.splitlines(), 1):
            include = INCLUDE.match(line)
            reason = include and broken_rule(file, include.group(1))
            if reason:
                yield f"{file}:{number}: includes {include.group(1)}: {reason}"


if __name__ == "__main__":
    found = list(violations(sys.argv[1]))
    print("\n".join(found) or "no include breaks the layer rule")
    sys.exit(1 if found else 0)
