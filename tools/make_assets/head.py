"""The wearer's head, assets/lab/head.glb, in head coordinates: head, neck, knitted yoke, helmet
with three LED clusters. +x is the wearer's right, -z forward, the origin the rear cluster. Metres.
"""

import math

import gltf
from figure import BUST_LIFT, CREAM, RED, SKIN, WOOL, along, between, knitted, knitting, loft
from mesh import Mesh, add, clamp, cross, mix, mul, placed, quaternion, smoothstep, unit
from thin import thinned


LEDS = ((-0.09, 0.0, -0.09), (0.0, 0.0, 0.0), (0.09, 0.0, -0.09))
EYES = ((-0.0315, -0.10, -0.19), (0.0315, -0.10, -0.19))
LIPS = (0.50, 0.20, 0.16)
HAIR = (0.085, 0.045, 0.024)
SHELL = (0.055, 0.075, 0.095)
TRIM = (0.45, 0.47, 0.48)
# Height, half width, front z, back z of the skull without features.
SKULL = (
    (-0.1765, 0.006, -0.150, -0.130),
    (-0.174, 0.024, -0.174, -0.100),
    (-0.168, 0.037, -0.1815, -0.082),
    (-0.157, 0.0485, -0.1845, -0.064),
    (-0.142, 0.0575, -0.186, -0.046),
    (-0.122, 0.0645, -0.1875, -0.028),
    (-0.100, 0.0695, -0.1885, -0.016),
    (-0.075, 0.0735, -0.1895, -0.008),
    (-0.045, 0.0755, -0.1890, -0.005),
    (-0.015, 0.0735, -0.1830, -0.010),
    (0.012, 0.0650, -0.1690, -0.024),
    (0.032, 0.0500, -0.150, -0.046),
    (0.044, 0.0300, -0.128, -0.070),
    (0.0495, 0.006, -0.104, -0.094),
)


def bump(x, y, cx, cy, wx, wy):
    return math.exp(-0.5 * (((x - cx) / wx) ** 2 + ((y - cy) / wy) ** 2))


def features(x, y):
    """How far the face stands out (towards -z) at a place, seen from the front."""
    a = abs(x)
    out = 0.0
    bridge = smoothstep(-0.137, -0.126, y) * smoothstep(-0.083, -0.122, y)
    out += (
        0.0245
        * bridge
        * math.exp(-0.5 * (x / (0.0062 + 0.0030 * smoothstep(-0.105, -0.127, y))) ** 2)
    )
    out += 0.0060 * bump(a, y, 0.0115, -0.1290, 0.0040, 0.0045)  # nostrils
    out -= 0.0085 * bump(a, y, 0.0305, -0.0995, 0.0130, 0.0090)  # eye sockets
    out += 0.0050 * bump(a, y, 0.0270, -0.0800, 0.0190, 0.0060)  # brows
    out += 0.0045 * bump(a, y, 0.0430, -0.1200, 0.0130, 0.0120)  # cheeks
    out += 0.0055 * bump(x, y, 0.0, -0.1455, 0.0160, 0.0075)  # mouth
    out -= 0.0032 * bump(x, y, 0.0, -0.1462, 0.0170, 0.0013)
    out -= 0.0028 * bump(x, y, 0.0, -0.1560, 0.0130, 0.0030)
    out += 0.0060 * bump(x, y, 0.0, -0.1660, 0.0140, 0.0070)  # chin
    return out


def skin_colour(p, n):
    x, y, z = p
    if z > -0.10:
        return mul(SKIN, 0.92)
    a = abs(x)
    colour = mix(SKIN, (0.66, 0.27, 0.20), 0.38 * bump(a, y, 0.042, -0.122, 0.014, 0.013))
    colour = mix(colour, (0.60, 0.24, 0.18), 0.30 * bump(x, y, 0, -0.128, 0.010, 0.007))
    lip = max(bump(x, y, 0, -0.1428, 0.0135, 0.0024), bump(x, y, 0, -0.1500, 0.0115, 0.0030))
    colour = mix(colour, LIPS, 0.85 * clamp(1.5 * lip - 0.25))
    colour = mix(colour, mul(LIPS, 0.35), 0.8 * bump(x, y, 0, -0.1462, 0.0150, 0.0010))
    brow = bump(a, y, 0.0300, -0.0815 - 0.10 * (a - 0.030) ** 2 * 60, 0.0125, 0.0022)
    colour = mix(colour, HAIR, 0.85 * clamp(1.6 * brow - 0.3))
    return mul(colour, 1 - 0.30 * bump(a, y, 0.0305, -0.0965, 0.015, 0.007))


def skull():
    mesh = Mesh()
    rows, sides = [], 112
    heights = [-0.1765 + 0.0085 * (j / 8) ** 1.6 for j in range(8)]  # under the chin
    heights += [-0.168 + 0.096 * j / 62 for j in range(62)]  # the face
    heights += [
        -0.072 + 0.1215 * math.sin(math.pi / 2 * j / 14) for j in range(15)
    ]  # under the helmet
    for y in heights:
        half, front, back = between(SKULL, y)
        middle, reach = 0.5 * (front + back), 0.5 * (back - front)
        ring = []
        for i in range(sides):
            a = 2 * math.pi * i / sides
            # Points are closer together on the face.
            a += 0.45 * math.cos(a)
            c, s = math.cos(a), math.sin(a)
            x = half * math.copysign(abs(c) ** 0.92, c)
            z = middle - reach * math.copysign(abs(s) ** 0.92, s)
            if s > 0:
                z -= features(x, y) * smoothstep(0.0, 0.45, s)
            ring.append((x, y, z))
        rows.append(ring)
    rows = [[rows[0][0]] * sides] + rows + [[(0, 0.0502, -0.099)] * sides]
    rows[0] = [(0, -0.1768, -0.140)] * sides
    mesh.grid(rows, skin_colour, closed=True)
    return mesh


def ear(side):
    mesh = Mesh()
    rows, n = [], 20
    for depth, size in (
        (0.0, 0.62),
        (0.007, 0.98),
        (0.0105, 1.0),
        (0.0095, 0.80),
        (0.0060, 0.55),
        (0.0052, 0.0),
    ):
        rows.append(
            [
                (
                    side * (0.066 + depth),
                    -0.098 + 0.029 * size * math.sin(a) - 0.002,
                    -0.083 + 0.0165 * size * math.cos(a) + 0.30 * depth,
                )
                for a in (2 * math.pi * i / n for i in range(n))
            ]
        )
    # The ring must run counter-clockwise as seen from outside, on either side.
    rows = [row[::-1] for row in rows] if side > 0 else rows
    mesh.grid(rows, mix(SKIN, (0.62, 0.24, 0.18), 0.25), closed=True)
    return mesh


def eyes(mesh):
    for x, y, z in EYES:
        centre = (x * 0.98, y + 0.0005, z + 0.0228)
        ball = Mesh()

        def colour(p, n):
            toward = math.acos(clamp(-n[2], -1, 1))
            if toward < 0.25:
                return (0.01, 0.01, 0.012)
            if toward < 0.56:
                return mix((0.10, 0.24, 0.30), (0.03, 0.07, 0.10), smoothstep(0.44, 0.56, toward))
            return (0.72, 0.70, 0.67)

        ball.sphere((0, 0, 0), 0.0122, (1, 1, 1), 18, 20)
        turned = Mesh().append(ball, placed(turn=quaternion((1, 0, 0), math.pi / 2)))
        turned.bake(lambda p, n, c: colour(p, n))
        mesh.append(turned, lambda p: add(p, centre))
        lid = Mesh()
        for low, high, tone in (
            (math.radians(17), math.radians(85), 0.90),
            (math.radians(-80), math.radians(-22), 0.95),
        ):
            rows = []
            for j in range(5):
                e = low + (high - low) * j / 4
                rows.append(
                    [
                        (
                            0.0132 * math.cos(e) * math.sin(a),
                            0.0132 * math.sin(e),
                            -0.0132 * math.cos(e) * math.cos(a),
                        )
                        for a in (math.radians(84 - 168 * i / 10) for i in range(11))
                    ]
                )
            lid.grid(rows, mul(SKIN, tone * 0.92))
        mesh.append(lid, lambda p: add(p, centre))


def helmet():
    """A light shell over the crown with vents, a trim, a chin strap, and a bracket for each LED
    cluster.
    """
    mesh = Mesh()
    centre, radii = (0, -0.040, -0.100), (0.0865, 0.1060, 0.0985)
    sides, levels = 96, 12

    def edge(a):
        """Lower edge's elevation: high over the brow, low behind."""
        forward = math.sin(a)
        return math.radians(-14 + 20 * smoothstep(-0.3, 0.9, forward))

    def point(a, t, grow=0.0):
        e = edge(a) + (math.pi / 2 - edge(a)) * t
        ridge = 0.0022 * math.cos(5 * (a - math.pi / 2)) ** 2 * math.sin(math.pi * t)
        r = 1 + (grow + ridge) / 0.1
        return (
            centre[0] + radii[0] * r * math.cos(e) * math.cos(a),
            centre[1] + radii[1] * r * math.sin(e),
            centre[2] - radii[2] * r * math.cos(e) * math.sin(a),
        )

    angles = [2 * math.pi * i / sides for i in range(sides)]

    def paint(p, n):
        across = abs(p[0])
        stripe = smoothstep(0.0125, 0.0110, across) * smoothstep(-0.02, 0.0, p[1])
        return mix(SHELL, RED, stripe)

    mesh.grid(
        [[point(a, j / levels, 0.002) for a in angles] for j in range(levels + 1)],
        paint,
        closed=True,
    )
    mesh.grid(
        [[point(a, 0, -0.009) for a in angles], [point(a, 0, 0.002) for a in angles]],
        mul(SHELL, 0.6),
        closed=True,
    )
    rim = [point(a, 0.0, 0.003) for a in angles] + [point(angles[0], 0.0, 0.003)]
    mesh.tube(rim, 0.0040, TRIM, 6, False)
    for side in (-1, 1):  # vents: dark slots from front to back
        for offset in (0.42, 0.80):
            slot = []
            for j in range(9):
                t = 0.30 + 0.38 * j / 8
                slot.append(point(math.pi / 2 - side * offset * (1 + 0.5 * t), t, 0.0035))
            mesh.tube(
                slot,
                [0.001, 0.003, 0.0042, 0.005, 0.005, 0.005, 0.0042, 0.003, 0.001],
                (0.006, 0.006, 0.007),
                6,
            )
    for side in (-1, 1):
        strap = [
            (side * 0.078, -0.060, -0.100),
            (side * 0.0735, -0.105, -0.112),
            (side * 0.0665, -0.140, -0.126),
            (side * 0.040, -0.172, -0.140),
            (0, -0.1815, -0.145),
        ]
        mesh.tube(strap, 0.0032, (0.03, 0.03, 0.032), 6)
    return mesh


def clusters(body, light):
    """Each cluster: a dark round holder and a red disc with brighter LEDs, facing outwards."""
    for place in LEDS:
        outward = unit((place[0], 0.0, 1.0 if place[0] == 0 else 0.0))
        if place[0]:
            outward = unit((math.copysign(1, place[0]), 0.1, 0.35))
        side = unit(cross((0, 1, 0), outward))
        up = cross(outward, side)

        def carry(p):
            return add(place, add(add(mul(side, p[0]), mul(up, -p[2])), mul(outward, p[1])))

        holder, disc = Mesh(), Mesh()
        holder.lathe(
            [
                (0.0125, -0.012),
                (0.0150, -0.003),
                (0.0150, 0.0),
                (0.0128, 0.0015),
                (0.0118, -0.0005),
                (0.0, -0.0005),
            ],
            20,
            (0.02, 0.02, 0.022),
        )
        disc.lathe([(0.0117, -0.0002), (0.0, -0.0001)], 20, (0.75, 0.03, 0.02))
        for k in range(4):
            a = math.pi / 4 + math.pi / 2 * k
            led = Mesh()
            led.sphere(
                (0.0060 * math.cos(a), 0.0, -0.0060 * math.sin(a)),
                (0.0026, 0.0030, 0.0026),
                (1.0, 0.42, 0.30),
                8,
                5,
            )
            disc.append(led)
        body.append(holder, carry)
        light.append(disc, carry)


YOKE = (  # one motif of the knitted yoke, from the collar down; w: wool, c: cream, r: red
    "wwwwwwww",
    "cccccccc",
    "wwwwwwww",
    "wcwwwcww",
    "ccwcccwc",
    "crrrcrrr",
    "rrcrrrcr",
    "rcccrccc",
    "rrcrrrcr",
    "crrrcrrr",
    "ccwcccwc",
    "wcwwwcww",
    "wwwwwwww",
    "cccccccc",
    "wwwwwwww",
    "cwcwcwcw",
    "wwwwwwww",
    "wwwcwwww",
)
STITCH = {"w": WOOL, "c": CREAM, "r": RED}
ROUNDS, COLLAR = 22, 6  # rows of stitches


def bust(mesh):
    """Neck, collar, and a round knitted yoke that turns with the head over the shoulders."""
    loft(
        mesh,
        (
            (-0.275, 0.060, 0.060, 0.0),
            (-0.235, 0.0535, 0.056, 0.0),
            (-0.19, 0.0515, 0.056, -0.004),
            (-0.135, 0.0525, 0.058, -0.012),
            (-0.10, 0.050, 0.05, -0.016),
        ),
        -0.078,
        lambda p, n: mul(SKIN, 0.62 + 0.38 * smoothstep(-0.150, -0.215, p[1])),
        28,
        10,
    )
    angles = [2 * math.pi * i / 48 for i in range(48)]

    def rings(profile, count):
        return [
            [
                (r * 1.04 * math.cos(a), y + BUST_LIFT, -0.078 - r * 0.92 * math.sin(a))
                for a in angles
            ]
            for r, y in along(profile, count)
        ]

    yoke = (
        (0.166, -0.400),
        (0.160, -0.375),
        (0.150, -0.350),
        (0.136, -0.325),
        (0.117, -0.302),
        (0.098, -0.285),
        (0.080, -0.272),
    )
    collar = (
        (0.080, -0.272),
        (0.0735, -0.262),
        (0.0745, -0.243),
        (0.0720, -0.236),
        (0.066, -0.2345),
        (0.062, -0.240),
        (0.058, -0.26),
    )
    line = 1 / (ROUNDS + COLLAR + 1)
    base = len(mesh.positions)
    mesh.uvs = [(0.5, 0.4 * line)] * base
    knitted(mesh, rings(yoke, 9), (1 + COLLAR) * line, 1 - 0.3 * line)
    knitted(mesh, rings(collar, 10), 1.5 * line, (1 + COLLAR) * line)


def jumper():
    """The wool's texture: yoke, ribbed collar, and a white row for what is not knitted."""

    def stitch(i, j):
        if j == ROUNDS + COLLAR:
            return (1, 1, 1)
        if j >= ROUNDS:
            return mul(WOOL, 0.62 + 0.28 * math.cos(math.pi / 2 * i))
        row = ROUNDS - 1 - j - 2
        tone = STITCH[YOKE[row][i % 8]] if 0 <= row < len(YOKE) else WOOL
        return mul(tone, 0.62 if j >= ROUNDS - 1 else 0.80 if j == ROUNDS - 2 else 1.0)

    return knitting(144, ROUNDS + COLLAR + 1, stitch)


def skin_look(n, c):
    return (*n, *(2 * math.sqrt(v) for v in c[:3]))


def make_head(file):
    solid, cloth, shell, light = Mesh(), Mesh(), Mesh(), Mesh()
    solid.append(skull())
    for side in (-1, 1):
        solid.append(ear(side))
    eyes(solid)
    bust(cloth)
    shell.append(helmet())
    clusters(shell, light)
    under_helmet(solid)
    # Seen from 1.5 m at the nearest.
    solid = thinned(solid, 0.0001, lambda p: 1 / 1.5, skin_look, 0.01)
    document = gltf.Document("Head with helmet")
    wool = document.material(
        "wool",
        (0.80, 0.80, 0.80, 1),
        roughness=0.95,
        texture=document.texture(jumper(), "jumper"),
    )
    parts = (
        ("skin", solid, document.material("skin", (1.0, 1.0, 1.0, 1), roughness=0.55)),
        ("wool", cloth, wool),
        ("helmet", shell, document.material("helmet", roughness=0.32)),
        (
            "leds",
            light,
            document.material(
                "leds", (0.4, 0.4, 0.4, 1), roughness=0.4, emissive=(0.80, 0.05, 0.03)
            ),
        ),
    )
    for name, mesh, material in parts:
        document.node(name, document.mesh(name, mesh, material))
    document.write(file)


def under_helmet(mesh):
    """Contact shadow of the helmet, hair at the nape and temples."""
    for i, (p, c) in enumerate(zip(mesh.positions, mesh.colours)):
        x, y, z = p
        rim = -0.066 + 0.026 * smoothstep(-0.06, -0.17, z)
        behind = smoothstep(-0.112, -0.088, z) * smoothstep(-0.150, -0.128, y)
        temple = smoothstep(-0.128, -0.116, z) * smoothstep(-0.105, -0.092, y)
        hair = max(behind if abs(x) < 0.068 else 0.0, temple if abs(x) < 0.0755 else 0.0)
        colour = mix(c[:3], HAIR, clamp(hair))
        shade = 0.45 + 0.55 * smoothstep(rim + 0.004, rim - 0.020, y)
        under = 0.62 + 0.38 * smoothstep(-0.178, -0.160, y) if z < -0.08 else 1.0
        mesh.colours[i] = (*mul(colour, shade * under), 1)
