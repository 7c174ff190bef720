"""The wall laboratory, assets/lab/lab.glb, in room coordinates: a dark, calm room that the wall's
picture lights.

The picture itself is left out (an opening of 5.185 x 2.238 m, centre 1.55 m above the floor at z =
0). Room faces are seen from inside only, so that the room can be looked into from anywhere. All
light is baked.
"""

import math

import gltf
from mesh import Mesh, add, cross, dot, mix, mul, placed, quaternion, scaled, smoothstep, sub, unit
from noise import fbm, noise
from thin import thinned
from voxels import Voxels, hemisphere

HALF, DEPTH, HEIGHT = 4.6, 8.6, 3.0
PICTURE = (5.185, 2.238, 1.55)
WIIMOTES = ((-1.0, 2.3, 5.0), (1.0, 2.3, 5.0))
WIIMOTE_TARGET = (0.0, 1.65, 2.0)

WALL = (0.30, 0.32, 0.35)
FLOOR = (0.200, 0.150, 0.110)
WOOD = (0.42, 0.27, 0.15)
STEEL = (0.16, 0.165, 0.175)
FABRIC = (0.10, 0.16, 0.20)
BLACK = (0.018, 0.018, 0.020)
SCREEN = (0.10, 0.34, 0.42)


class Room:
    """A mesh and the solid model of the same boxes."""

    def __init__(self):
        self.mesh = Mesh()
        self.solid = Voxels((-HALF, 0, 0), (HALF, HEIGHT, DEPTH))

    def box(self, low, high, colour, split=1, faces="-x+x-y+y-z+z"):
        self.mesh.box(low, high, colour, split, faces)
        self.solid.fill(low, high)


def shell(room):
    h = PICTURE
    inside = room.mesh
    inside.face([(-HALF, 0, DEPTH), (HALF, 0, DEPTH), (HALF, 0, 0), (-HALF, 0, 0)], FLOOR, (84, 80))
    inside.face(
        [(-HALF, HEIGHT, 0), (HALF, HEIGHT, 0), (HALF, HEIGHT, DEPTH), (-HALF, HEIGHT, DEPTH)],
        (0.22, 0.23, 0.25),
        (30, 30),
    )
    inside.face(
        [(-HALF, 0, DEPTH), (-HALF, 0, 0), (-HALF, HEIGHT, 0), (-HALF, HEIGHT, DEPTH)],
        WALL,
        (44, 16),
    )
    inside.face(
        [(HALF, 0, 0), (HALF, 0, DEPTH), (HALF, HEIGHT, DEPTH), (HALF, HEIGHT, 0)], WALL, (44, 16)
    )
    inside.face(
        [(HALF, 0, DEPTH), (-HALF, 0, DEPTH), (-HALF, HEIGHT, DEPTH), (HALF, HEIGHT, DEPTH)],
        WALL,
        (40, 14),
    )
    x, low, high = h[0] / 2, h[2] - h[1] / 2, h[2] + h[1] / 2
    dark = (0.07, 0.07, 0.075)
    z = -0.02
    for a, b, c, d, split in (
        (-HALF, -x, 0, HEIGHT, (12, 20)),
        (x, HALF, 0, HEIGHT, (12, 20)),
        (-x, x, 0, low, (40, 4)),
        (-x, x, high, HEIGHT, (40, 4)),
    ):
        inside.face([(a, c, z), (b, c, z), (b, d, z), (a, d, z)], dark, split)


def canvas_frame(room):
    """A slim black frame whose inner edge is the picture's edge, on a low plinth."""
    x, low, high, t = (
        PICTURE[0] / 2,
        PICTURE[2] - PICTURE[1] / 2,
        PICTURE[2] + PICTURE[1] / 2,
        0.055,
    )
    for a, b, c, d in (
        (-x - t, -x, low - t, high + t),
        (x, x + t, low - t, high + t),
        (-x, x, low - t, low),
        (-x, x, high, high + t),
    ):
        room.mesh.box((a, c, -0.02), (b, d, 0.035), (0.035, 0.033, 0.032), 6)
    room.box((-x - t, 0, 0.0), (x + t, low - t - 0.03, 0.10), (0.055, 0.050, 0.048), (40, 3))


def skirting_and_tape(room):
    for s in (-1, 1):
        x = s * (HALF - 0.012)
        room.mesh.box(
            (min(x, s * HALF), 0, 0),
            (max(x, s * HALF), 0.09, DEPTH),
            (0.12, 0.12, 0.13),
            (1, 40),
            "-x+x+y",
        )
    white, y = (0.62, 0.62, 0.58), 0.002
    for sx in (-1, 1):  # corners of the area that both Wiimotes see
        for z, dz in ((1.15, 1), (2.85, -1)):
            x = sx * 1.15
            room.mesh.box(
                (min(x, x - sx * 0.32), y - 0.002, z - 0.015),
                (max(x, x - sx * 0.32), y, z + 0.015),
                white,
                (8, 1),
                "+y",
            )
            room.mesh.box(
                (x - 0.015, y - 0.002, min(z, z + dz * 0.32)),
                (x + 0.015, y, max(z, z + dz * 0.32)),
                white,
                (1, 8),
                "+y",
            )


def window(room, z):
    """A tall window to the blue evening, on the left wall."""
    x, y0, y1, w = -HALF + 0.01, 0.95, 2.45, 0.62
    sky = Mesh()
    rows = [
        [(x, y0 + (y1 - y0) * j / 10, z + w - 2 * w * i / 6) for i in range(7)] for j in range(11)
    ]
    sky.grid(
        rows,
        lambda p, n: (
            *mix((0.17, 0.115, 0.10), (0.018, 0.045, 0.105), smoothstep(y0 - 0.3, y0 + 0.85, p[1])),
            1,
        ),
        normal=(1, 0, 0),
    )
    hills = [
        [
            (
                x + 0.002,
                y0 + (0.0 if j == 0 else 0.16 + 0.22 * noise(i * 0.55, z, 5)),
                z + w - 2 * w * i / 12,
            )
            for i in range(13)
        ]
        for j in range(2)
    ]
    sky.grid(hills, (0.020, 0.035, 0.055), normal=(1, 0, 0))
    frame = (0.20, 0.19, 0.18)
    for a, b, c, d in (
        (y0 - 0.07, y0, -w - 0.06, w + 0.06),
        (y1, y1 + 0.06, -w - 0.06, w + 0.06),
        (y0, y1, -w - 0.06, -w),
        (y0, y1, w, w + 0.06),
        (y0, y1, -0.018, 0.018),
        (y0 + 0.98, y0 + 1.01, -w, w),
    ):
        room.mesh.box((-HALF, a, z + c), (-HALF + 0.06, b, z + d), frame, 3)
    room.box(
        (-HALF, y0 - 0.10, z - w - 0.12), (-HALF + 0.20, y0 - 0.07, z + w + 0.12), frame, (2, 8)
    )
    return sky


def table(room, low, high, top=0.74):
    room.box((low[0], top - 0.03, low[1]), (high[0], top, high[1]), WOOD, (10, 14))
    inset = 0.06
    for x in (low[0] + inset, high[0] - inset):
        for z in (low[1] + inset, high[1] - inset):
            room.box((x - 0.022, 0, z - 0.022), (x + 0.022, top - 0.03, z + 0.022), STEEL, (1, 6))
    room.mesh.box(
        (low[0] + inset, top - 0.10, low[1] + inset - 0.01),
        (high[0] - inset, top - 0.03, low[1] + inset + 0.01),
        STEEL,
        2,
    )


def chair(room, place, turn):
    """An office chair on five castors, facing its own -z."""
    part = Mesh()
    for k in range(5):
        a = 2 * math.pi * k / 5
        foot = (0.28 * math.cos(a), 0.045, -0.28 * math.sin(a))
        part.tube([(0, 0.10, 0), foot], [0.028, 0.018], STEEL, 6)
        part.sphere((foot[0], 0.03, foot[2]), 0.03, BLACK, 8, 6)
    part.tube([(0, 0.08, 0), (0, 0.44, 0)], 0.028, STEEL, 10)
    seat = [(0.0, 0.425), (0.21, 0.43), (0.238, 0.45), (0.235, 0.485), (0.20, 0.50), (0.0, 0.495)]
    part.lathe(seat, 18, FABRIC)
    part.sphere((0, 0.80, 0.255), (0.205, 0.215, 0.032), FABRIC, 18, 10)
    part.tube([(0, 0.46, 0.16), (0, 0.50, 0.27), (0, 0.72, 0.285)], 0.02, STEEL, 8)
    room.mesh.append(part, placed((place[0], 0, place[1]), quaternion((0, 1, 0), turn)))
    x, z = place
    room.solid.fill((x - 0.20, 0.42, z - 0.20), (x + 0.20, 0.50, z + 0.20))
    room.solid.fill((x - 0.05, 0.02, z - 0.05), (x + 0.05, 0.42, z + 0.05))
    bx, bz = x + 0.25 * math.sin(turn), z + 0.25 * math.cos(turn)
    room.solid.fill((bx - 0.10, 0.60, bz - 0.10), (bx + 0.10, 1.0, bz + 0.10))


def monitor(room, place, turn, screens):
    """A flat screen on a foot; it shows a dim trace. Faces its own +z."""
    part, glow = Mesh(), Mesh()
    part.box((-0.11, 0, -0.09), (0.11, 0.015, 0.09), BLACK, 2)
    part.box((-0.02, 0.015, -0.035), (0.02, 0.20, -0.015), BLACK, 2)
    part.box((-0.29, 0.12, -0.02), (0.29, 0.47, 0.012), BLACK, 3)
    rows = [
        [(-0.275 + 0.55 * i / 20, 0.135 + 0.32 * j / 12, 0.0135) for i in range(21)]
        for j in range(13)
    ]

    def picture(p, _):
        wave = 0.295 + 0.07 * math.sin(p[0] * 19) * math.cos(p[0] * 7)
        return (
            *mix(mul(SCREEN, 0.30), (0.35, 0.75, 0.62), math.exp(-(((p[1] - wave) / 0.022) ** 2))),
            1,
        )

    glow.grid(rows, picture, normal=(0, 0, 1))
    carry = placed(place, quaternion((0, 1, 0), turn))
    room.mesh.append(part, carry)
    screens.append(Mesh().append(glow, carry))
    room.solid.fill(
        (place[0] - 0.08, place[1] + 0.12, place[2] - 0.25),
        (place[0] + 0.02, place[1] + 0.47, place[2] + 0.25),
    )


def desks(room, screens):
    table(room, (-4.35, 1.4), (-3.55, 3.4))
    table(room, (-4.35, 3.9), (-3.55, 5.9))
    table(room, (3.55, 1.6), (4.35, 3.6))
    for z, turn in ((2.0, 0.15), (2.8, -0.1), (4.5, 0.1)):
        monitor(room, (-4.08, 0.74, z), math.pi / 2 + turn, screens)
    monitor(room, (4.08, 0.74, 2.6), -math.pi / 2 - 0.12, screens)
    for z in (2.05, 2.85, 4.55):
        room.mesh.box((-3.88, 0.74, z - 0.21), (-3.74, 0.757, z + 0.21), BLACK, 2)
    room.mesh.box((3.74, 0.74, 2.4), (3.88, 0.757, 2.82), BLACK, 2)
    for place, turn in (
        ((-3.05, 2.1), 1.35),
        ((-3.2, 4.7), 1.85),
        ((3.10, 2.7), -1.75),
        ((-2.5, 6.9), 2.6),
    ):
        chair(room, place, turn)
    for k, (x, y, z) in enumerate(((-4.1, 0.74, 5.3), (-4.05, 0.74, 5.36), (4.05, 0.74, 3.2))):
        tall = 0.03 + 0.02 * k
        room.mesh.box(
            (x - 0.10, y, z - 0.14),
            (x + 0.10, y + tall, z + 0.14),
            ((0.42, 0.10, 0.06), (0.10, 0.22, 0.26), (0.45, 0.33, 0.12))[k],
            2,
        )
    mug = Mesh()
    mug.lathe(
        [(0.0, 0.0), (0.036, 0.0), (0.038, 0.09), (0.033, 0.09), (0.030, 0.02), (0.0, 0.02)],
        18,
        (0.55, 0.14, 0.08),
    )
    room.mesh.append(mug, lambda p: add(p, (-3.8, 0.74, 3.2)))


def shelves(room):
    """A low cabinet with folders at the right, an equipment rack with small lights at the rear
    left.
    """
    room.box((4.12, 0, 4.2), (4.56, 1.10, 5.9), (0.24, 0.16, 0.10), (4, 10))
    tones = (
        (0.34, 0.07, 0.05),
        (0.08, 0.20, 0.24),
        (0.36, 0.26, 0.10),
        (0.30, 0.31, 0.32),
        (0.07, 0.13, 0.10),
    )
    z = 4.28
    for k in range(26):
        w = 0.045 + 0.022 * noise(k * 1.3, 0.5, 3)
        tall = 0.24 + 0.09 * noise(k * 2.7, 1.5, 4)
        if k % 9 != 8:
            room.mesh.box(
                (4.26, 1.10, z),
                (4.48, 1.10 + tall, z + w),
                tones[int(noise(k * 3.1, 2.5, 5) * 4.99)],
                2,
            )
        z += w + 0.004
    room.box((-4.55, 0, 7.0), (-3.85, 1.95, 7.7), (0.035, 0.036, 0.040), (6, 14))
    lights = Mesh()
    for k in range(9):
        y = 0.30 + 0.18 * k
        room.mesh.box(
            (-3.85, y - 0.06, 7.06), (-3.842, y + 0.06, 7.64), (0.075, 0.078, 0.085), (1, 4)
        )
        for j in range(5):
            if noise(k * 5.3, j * 3.7, 9) > 0.35:
                c = (0.10, 0.75, 0.50) if noise(k * 2.2, j * 7.1, 10) > 0.3 else (0.95, 0.45, 0.10)
                lights.box(
                    (-3.842, y - 0.008, 7.12 + 0.05 * j),
                    (-3.838, y + 0.008, 7.135 + 0.05 * j),
                    c,
                    1,
                    "+x",
                )
    return lights


def tripod(room, wiimote):
    """A lamp stand with a ball head, and a clamp under the Wiimote's body."""
    forward = unit(sub(WIIMOTE_TARGET, wiimote))
    right = unit(cross(forward, (0, 1, 0)))
    up = cross(right, forward)
    grip = add(wiimote, mul(forward, -0.074))
    foot = (grip[0], 0, grip[2])
    part = Mesh()
    part.tube([add(foot, (0, 0.20, 0)), add(foot, (0, 1.25, 0))], 0.016, STEEL, 10)
    part.tube([add(foot, (0, 1.2, 0)), add(foot, (0, 2.20, 0))], 0.011, (0.24, 0.245, 0.25), 10)
    part.tube([add(foot, (0, 1.19, 0)), add(foot, (0, 1.27, 0))], 0.024, BLACK, 10)
    for k in range(3):
        a = 2 * math.pi * k / 3 + 0.5
        tip = add(foot, (0.46 * math.cos(a), 0.012, -0.46 * math.sin(a)))
        part.tube([add(foot, (0, 0.80, 0)), tip], 0.011, STEEL, 8)
        part.tube(
            [add(foot, (0, 0.26, 0)), mix(add(foot, (0, 0.80, 0)), tip, 0.62)], 0.007, STEEL, 6
        )
        part.sphere(tip, 0.02, BLACK, 8, 6)
    part.sphere(add(foot, (0, 2.215, 0)), 0.024, BLACK, 14, 10)
    part.tube([add(foot, (0, 2.225, 0)), add(grip, mul(up, -0.022))], 0.010, STEEL, 8)
    for side in (-1, 1):
        clamp_at = add(grip, mul(right, side * 0.0215))
        part.tube([add(clamp_at, mul(up, -0.022)), add(clamp_at, mul(up, 0.010))], 0.0035, BLACK, 6)
    part.tube(
        [
            add(grip, add(mul(right, -0.024), mul(up, -0.022))),
            add(grip, add(mul(right, 0.024), mul(up, -0.022))),
        ],
        0.005,
        BLACK,
        6,
    )
    room.mesh.append(part)
    room.solid.fill(add(foot, (-0.02, 0.0, -0.02)), add(foot, (0.02, 2.2, 0.02)))


def ceiling_lights(room):
    """Two long dimmed lamps, and the rails of the acoustic ceiling."""
    glow = Mesh()
    for x in (-2.3, 2.3):
        room.mesh.box(
            (x - 0.09, HEIGHT - 0.07, 1.2), (x + 0.09, HEIGHT, 7.6), (0.05, 0.05, 0.055), (2, 30)
        )
        glow.face(
            [
                (x - 0.06, HEIGHT - 0.0705, 1.25),
                (x + 0.06, HEIGHT - 0.0705, 1.25),
                (x + 0.06, HEIGHT - 0.0705, 7.55),
                (x - 0.06, HEIGHT - 0.0705, 7.55),
            ],
            (0.30, 0.19, 0.10),
        )
    for k in range(8):
        z = 0.6 + 1.1 * k
        room.mesh.box(
            (-HALF, HEIGHT - 0.012, z - 0.012),
            (HALF, HEIGHT, z + 0.012),
            (0.10, 0.105, 0.11),
            (24, 1),
            "-y-z+z",
        )
    return glow


def picture_samples():
    """Points on the picture with their share of its light: cool fjord, warm heart."""
    samples = []
    for i in range(5):
        for j in range(2):
            u, v = (i + 0.5) / 5 - 0.5, (j + 0.5) / 2 - 0.5
            warm = math.exp(-((u / 0.16) ** 2))
            samples.append(
                (
                    (u * PICTURE[0], PICTURE[2] + v * PICTURE[1], 0.03),
                    mix((0.34, 0.66, 0.80), (1.00, 0.70, 0.42), warm),
                )
            )
    return samples


class Light:
    """What a surface of the room receives: the picture, the windows, the dimmed lamps, and what is
    scattered.
    """

    def __init__(self, solid, windows_z):
        self.solid = solid
        self.picture = picture_samples()
        self.windows = [(-HALF + 0.05, 1.7, z) for z in windows_z]
        self.rays = hemisphere(18)

    def __call__(self, p, n, albedo):
        start = add(p, mul(n, 0.065))
        total = (0.0, 0.0, 0.0)
        area = PICTURE[0] * PICTURE[1] / len(self.picture)
        for place, colour in self.picture:
            total = add(total, self._from(start, n, place, (0, 0, 1), mul(colour, 4.2 * area)))
        for place in self.windows:
            total = add(total, self._from(start, n, place, (1, 0, 0), (0.16, 0.30, 0.55)))
        open_share = self.solid.openness(p, n, self.rays, 0.75)
        scattered = mix((0.050, 0.060, 0.078), (0.085, 0.080, 0.078), 0.5 + 0.5 * n[1])
        lamps = mul((0.085, 0.058, 0.036), max(0.0, n[1]) + 0.35 * (1 - abs(n[1])))
        ambient = mul(add(scattered, lamps), 0.25 + 0.75 * open_share**1.3)
        speckle = 0.90 + 0.20 * fbm(p[0] * 6 + p[1] * 3, p[2] * 6 + p[1] * 4, 2, 7)
        return scaled(mul(albedo, speckle), add(total, ambient))

    def _from(self, start, n, place, facing, power):
        d = sub(place, start)
        squared = dot(d, d) + 0.02
        length = math.sqrt(squared)
        direction = mul(d, 1 / length)
        cosines = dot(n, direction) * max(0.0, -dot(facing, direction))
        if cosines <= 0 or self.solid.blocked(start, direction, length - 0.12):
            return (0.0, 0.0, 0.0)
        return mul(power, cosines / (math.pi * squared))


def planks(mesh):
    """Darker joints and changing tone of the floor's boards, by position."""
    for i, (p, n, c) in enumerate(zip(mesh.positions, mesh.normals, mesh.colours)):
        if p[1] == 0 and n[1] > 0.99 and c[:3] == FLOOR:
            tone = 0.90 + 0.20 * fbm(p[0] * 1.7, p[2] * 0.35, 3, 14)
            mesh.colours[i] = (*mul(FLOOR, tone), 1)


def make_lab(file):
    room, screens = Room(), []
    shell(room)
    canvas_frame(room)
    skirting_and_tape(room)
    windows = (2.4, 4.6)
    glow = Mesh()
    for z in windows:
        glow.append(window(room, z))
    desks(room, screens)
    glow.append(shelves(room))
    for wiimote in WIIMOTES:
        tripod(room, wiimote)
    glow.append(ceiling_lights(room))
    for screen in screens:
        glow.append(screen)
    planks(room.mesh)
    room.mesh.bake(Light(room.solid, windows))
    # Seen from some 4 m, so that a thousandth of it is 4 mm.
    whole = thinned(room.mesh.append(glow), 0.0005, lambda p: 1 / 4.0)
    document = gltf.Document("The wall laboratory")
    baked = document.material("baked", unlit=True)
    document.node("room", document.mesh("room", whole, baked))
    document.write(file)
