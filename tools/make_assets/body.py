"""A standing figure, assets/lab/body.glb: its origin is on the floor below the head's origin (which
is 1.75 m above it), it faces -z. Metres. The head's knitted yoke covers its neckline.
"""

import math

import gltf
from figure import BUST_LIFT, CREAM, SKIN, WOOL, between, knitted, knitting, limb, plain
from mesh import Mesh, add, mix, mul, smoothstep

SIDES, ROUNDS = 112, 72  # stitches of the jumper, round it and up
TROUSERS = (0.060, 0.058, 0.066)
SHOES = (0.16, 0.085, 0.045)


def jumper():
    """Its texture; the row above the knitting is white, for what is not knitted."""

    def stitch(i, j):
        if j == ROUNDS:
            return (1, 1, 1)
        if j < 5:
            return mul(WOOL, 0.95 if i % 2 else 0.60)
        dotted = 8 < j < 56 and j % 4 == 0 and (i + 2 * (j // 4)) % 4 == 0
        return mix(WOOL, CREAM, 0.8) if dotted else CREAM if j in (6, 7) else WOOL

    return knitting(SIDES, ROUNDS + 1, stitch)


def torso(mesh, z):
    table = (
        (0.86, 0.155, 0.105, 0.0),
        (0.90, 0.172, 0.122, 0.0),
        (0.98, 0.170, 0.120, 0.0),
        (1.08, 0.160, 0.112, 0.0),
        (1.20, 0.176, 0.120, 0.0),
        (1.30, 0.196, 0.124, 0.0),
        (1.365, 0.205, 0.114, 0.004),
        (1.405, 0.190, 0.098, 0.006),
        (1.435, 0.140, 0.078, 0.006),
        (1.452, 0.090, 0.062, 0.004),
        (1.458, 0.050, 0.045, 0.002),
    )

    sides, rounds = 40, 30
    rows = []
    for j in range(rounds + 1):
        y = table[0][0] + (table[-1][0] - table[0][0]) * j / rounds
        half, deep, shift = between(table, y)
        rows.append(
            [
                (
                    half * math.copysign(abs(math.cos(a)) ** 0.9, math.cos(a)),
                    y,
                    z + shift - deep * math.copysign(abs(math.sin(a)) ** 0.9, math.sin(a)),
                )
                for a in (2 * math.pi * i / sides for i in range(sides))
            ]
        )

    knitted(mesh, rows, 1.5 / (ROUNDS + 1), 1 - 0.3 / (ROUNDS + 1))


def legs(mesh, z):
    for s in (-1, 1):
        limb(
            mesh,
            [
                (s * 0.070, 0.93, z),
                (s * 0.088, 0.84, z - 0.004),
                (s * 0.095, 0.66, z - 0.008),
                (s * 0.098, 0.48, z - 0.006),
                (s * 0.100, 0.30, z + 0.012),
                (s * 0.102, 0.10, z + 0.018),
                (s * 0.102, 0.055, z + 0.018),
            ],
            [0.080, 0.094, 0.082, 0.062, 0.060, 0.054, 0.056],
            TROUSERS,
        )
        shoe = Mesh()
        shoe.sphere((0, 0, 0), 1.0, SHOES, 24, 14)
        for i, (x, y, zz) in enumerate(shoe.positions):
            toe = -zz
            shoe.positions[i] = (
                s * 0.104 + 0.047 * x * (1 - 0.15 * toe),
                max(0.0, 0.040 + (0.052 - 0.016 * toe) * y),
                z - 0.045 + 0.140 * zz,
            )
        mesh.append(shoe)


def arms(mesh, z):
    for s in (-1, 1):
        limb(
            mesh,
            [
                (s * 0.150, 1.385, z + 0.004),
                (s * 0.195, 1.365, z + 0.006),
                (s * 0.226, 1.25, z + 0.012),
                (s * 0.242, 1.10, z + 0.010),
                (s * 0.250, 0.97, z - 0.016),
                (s * 0.250, 0.865, z - 0.050),
            ],
            [0.050, 0.062, 0.055, 0.047, 0.043, 0.038],
            WOOL,
        )
        limb(
            mesh,
            [(s * 0.250, 0.885, z - 0.043), (s * 0.250, 0.860, z - 0.052)],
            [0.041, 0.041],
            CREAM,
        )
        palm = Mesh()
        palm.sphere((0, 0, 0), (0.021, 0.052, 0.039), SKIN, 20, 14)
        for k in range(4):
            palm.tube(
                [
                    (0, -0.035, -0.026 + 0.017 * k),
                    (-s * 0.006, -0.075 - 0.006 * (k in (1, 2)), -0.026 + 0.016 * k),
                    (-s * 0.016, -0.098 - 0.006 * (k in (1, 2)), -0.023 + 0.015 * k),
                ],
                [0.0105, 0.0095, 0.007],
                SKIN,
                8,
            )
        palm.tube(
            [
                (-s * 0.004, 0.000, -0.030),
                (-s * 0.016, -0.030, -0.048),
                (-s * 0.020, -0.052, -0.050),
            ],
            [0.013, 0.011, 0.008],
            SKIN,
            8,
        )
        mesh.append(palm, lambda p: add(p, (s * 0.249, 0.815, z - 0.068)))


def make_body(file):
    mesh = Mesh()
    z = -0.078
    torso(mesh, z)
    legs(mesh, z)
    arms(mesh, z)
    plain(mesh, (0.5, 0.4 / (ROUNDS + 1)))

    def contact(p, n, c):
        shade = 0.55 + 0.45 * smoothstep(0.0, 0.25, p[1])
        inner = (
            0.70 + 0.30 * smoothstep(0.16, 0.21, abs(p[0]))
            if 0.9 < p[1] < 1.33 and abs(p[0]) > 0.13
            else 1.0
        )
        crotch = 0.65 + 0.35 * smoothstep(0.0, 0.07, abs(p[0])) if p[1] < 0.88 else 1.0
        return mul(c, shade * inner * crotch)

    mesh.bake(contact)
    tall = 1 + BUST_LIFT / 1.40
    mesh.positions = [(x, y * tall, depth) for x, y, depth in mesh.positions]
    document = gltf.Document("Standing body")
    cloth = document.material(
        "cloth",
        (0.80, 0.80, 0.80, 1),
        roughness=0.9,
        texture=document.texture(jumper(), "jumper"),
    )
    document.node("body", document.mesh("body", mesh, cloth))
    document.write(file)
