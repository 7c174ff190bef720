"""A Wiimote, assets/lab/wiimote.glb, in the camera frame: +x right, +y down, +z along the optical
axis.

The origin is the camera behind the dark window at the front end; the body reaches 148 mm back.
Metres.
"""

import math

import gltf
from mesh import Mesh, mix

WIDTH, TALL, LENGTH = 0.0362, 0.0308, 0.148
WHITE = (0.66, 0.67, 0.69)
GREY = (0.42, 0.44, 0.47)
DARK = (0.012, 0.008, 0.014)
BLUE = (0.25, 0.70, 1.0)
FRONT, BACK = 0.002, 0.002 - LENGTH


def outline(width, tall, radius, steps=5):
    """A rectangle with round corners, counter-clockwise about +z."""
    points = []
    for cx, cy, start in ((1, 1, 0), (-1, 1, 90), (-1, -1, 180), (1, -1, 270)):
        for k in range(steps + 1):
            a = math.radians(start + 90 * k / steps)
            points.append(
                (
                    cx * (width / 2 - radius) + radius * math.cos(a),
                    cy * (tall / 2 - radius) + radius * math.sin(a),
                )
            )
    return points


def body():
    mesh = Mesh()
    rows = []
    for z, shrink in (
        (BACK, 1.0),
        (BACK, 0.005),
        (BACK + 0.002, 0.001),
        (BACK + 0.006, 0.0),
        (FRONT - 0.006, 0.0),
        (FRONT - 0.0015, 0.0008),
        (FRONT, 0.004),
        (FRONT, 1.0),
    ):
        if shrink == 1.0:
            rows.append([(0.0, 0.0, z)] * 24)
        else:
            rows.append(
                [(x, y, z) for x, y in outline(WIDTH - 2 * shrink, TALL - 2 * shrink, 0.0085)]
            )
    mesh.grid(rows, WHITE, closed=True)
    return mesh


def button(mesh, place, radius, colour, lift=0.0016):
    """A round key on the upper side (towards -y)."""
    key = Mesh()
    key.lathe(
        [(radius * 1.12, 0.0), (radius, lift * 0.7), (radius * 0.82, lift), (0.0, lift)], 22, colour
    )
    mesh.append(key, lambda p: (place[0] + p[0], -TALL / 2 + 0.0002 - p[1], place[1] - p[2]))


def details(mesh):
    top = -TALL / 2
    for low, high in (
        ((-0.0105, -0.0035), (0.0105, 0.0035)),
        ((-0.0035, -0.0105), (0.0035, 0.0105)),
    ):
        mesh.box(
            (low[0], top - 0.0022, -0.032 + low[1]), (high[0], top + 0.001, -0.032 + high[1]), GREY
        )
    button(mesh, (0.0, -0.056), 0.0088, mix(WHITE, GREY, 0.35), 0.0022)
    for x in (-0.011, 0.0, 0.011):
        button(mesh, (x, -0.078), 0.0036, GREY)
    button(mesh, (-0.0115, -0.013), 0.0032, (0.55, 0.06, 0.05))
    for z in (-0.108, -0.120):
        button(mesh, (0.0, z), 0.0050, GREY)
    for row in range(4):  # the speaker's holes
        for x in (-0.006, -0.002, 0.002, 0.006):
            z = -0.088 - 0.0036 * row
            mesh.box(
                (x - 0.0008, top - 0.0003, z - 0.0008), (x + 0.0008, top + 0.001, z + 0.0008), DARK
            )
    trigger = Mesh()
    trigger.sphere((0, TALL / 2 - 0.001, -0.052), (0.0105, 0.0075, 0.014), GREY, 20, 12)
    mesh.append(trigger)
    mesh.tube([(0, 0, BACK), (0, 0.002, BACK - 0.010), (0, 0.012, BACK - 0.016)], 0.0022, DARK, 8)


def make_wiimote(file):
    document = gltf.Document("Wiimote")
    shell = body()
    details(shell)
    lamps = Mesh()
    lamps.box(
        (-0.012, -0.0122, FRONT - 0.001), (0.012, 0.0003, FRONT + 0.0006), DARK
    )  # passes infrared only
    for k in range(4):
        x = (k - 1.5) * 0.0062
        lamps.box(
            (x - 0.0012, -TALL / 2 - 0.0004, -0.1365),
            (x + 0.0012, -TALL / 2 + 0.001, -0.1341),
            BLUE if k == 0 else (0.10, 0.12, 0.14),
        )
    plastic = document.material("plastic", (0.62, 0.62, 0.62, 1), roughness=0.35)
    light = document.material("light", unlit=True)
    document.node("wiimote", document.mesh("wiimote", shell, plastic))
    document.node("lamps and window", document.mesh("lamps and window", lamps, light))
    document.write(file)
