"""The show's focal point: a turning armillary sphere with planets that swing out in front of the
screen plane, and ice crystals that drift before it. Lit by the renderer; everything returns to its
start after PERIOD seconds.
"""

import math
import random

from mesh import Mesh, add, cross, mix, mul, placed, quaternion, smoothstep
from noise import fbm

PERIOD = 60.0
CENTRE = (0.0, 0.06, -0.22)  # in wall
BRASS = (0.88, 0.56, 0.22)
COPPER = (0.80, 0.36, 0.17)
SILVER = (0.72, 0.78, 0.84)


def ring(radius, width, thick, colour, ticks=0):
    """A flat hoop about the y axis, polished, with raised marks."""
    mesh = Mesh()
    sides = 36 + int(80 * radius)
    r0, r1, h = radius - thick / 2, radius + thick / 2, width / 2
    e = min(thick, width) * 0.22
    profile = [
        (r1 - e, -h),
        (r1, -h + e),
        (r1, h - e),
        (r1 - e, h),
        (r0 + e, h),
        (r0, h - e),
        (r0, -h + e),
        (r0 + e, -h),
    ]
    for (ra, ya), (rb, yb) in zip(profile, profile[1:] + profile[:1]):
        mesh.lathe([(ra, ya), (rb, yb)], sides, colour)
    for k in range(ticks):
        long = k % 6 == 0
        a = 2 * math.pi * k / ticks
        mark = Mesh()
        half = 0.0022 if long else 0.0013
        mark.box(
            (r1 - 0.002, -h * (0.92 if long else 0.45), -half),
            (r1 + 0.0035, h * (0.92 if long else 0.45), half),
            mix(colour, (1, 0.9, 0.7), 0.5),
            faces="+x-y+y-z+z" if long else "+x-z+z",
        )
        mesh.append(mark, placed(turn=quaternion((0, 1, 0), a)))
    return mesh


def turned(mesh, axis, degrees):
    return Mesh().append(mesh, placed(turn=quaternion(axis, math.radians(degrees))))


def knob(mesh, place, radius, colour):
    mesh.sphere(place, radius, colour, 12, 8)


def planet(radius, colour, seed, ringed=False):
    """A marbled ball; `ringed`: with a flat ring like Saturn's."""
    mesh = Mesh()

    def marble(p, _):
        swirl = fbm(p[0] * 2.2 + 9 + p[1], p[1] * 5.5 + 4 + 0.8 * p[2], 4, seed)
        return mix(
            mul(colour, 0.30), mix(colour, (1, 0.95, 0.85), 0.10), smoothstep(0.3, 0.7, swirl)
        )

    ball = Mesh()
    ball.sphere((0, 0, 0), 1.0, marble, *((30, 18) if radius > 0.03 else (22, 14)))
    mesh.append(ball, placed(scale=radius))
    if ringed:
        for side in (1, -1):
            profile = [(radius * 2.1, 0.0), (radius * 1.45, 0.001)]
            mesh.lathe(profile if side == 1 else profile[::-1], 64, mul(colour, 0.8))
    return mesh


def sun():
    """The glowing core (unlit): brightest in the middle of its granules."""
    mesh = Mesh()

    def glow(p, n):
        g = fbm(p[0] * 5 + 3 + 2 * p[2], p[1] * 5 + 8 - p[2], 4, 77)
        return mix((1.0, 0.45, 0.10), (1.0, 0.90, 0.58), smoothstep(0.25, 0.62, g))

    mesh.sphere((0, 0, 0), 1.0, glow, 36, 22)
    return Mesh().append(mesh, placed(scale=0.088))


def spin(document, node, axis, turns, tilt=(0, 0, 0, 1), phase=0.0):
    """Whole turns within the loop; keys a quarter turn or less apart."""
    count = max(1, abs(turns)) * 6
    times = [PERIOD * k / count for k in range(count + 1)]
    values = []
    for k in range(count + 1):
        q = quaternion(axis, phase + 2 * math.pi * turns * k / count)
        value = product(tilt, q)
        if values and sum(a * b for a, b in zip(values[-1], value)) < 0:
            value = tuple(-v for v in value)
        values.append(value)
    document.animate(node, "rotation", times, values)


def product(a, b):
    """The quaternion that turns by b, then by a."""
    v = add(add(mul(b[:3], a[3]), mul(a[:3], b[3])), cross(a[:3], b[:3]))
    return (*v, a[3] * b[3] - sum(x * y for x, y in zip(a[:3], b[:3])))


def rings(document, root, metal):
    """Outer frame, and hoops within hoops, each about its own axis."""
    frame = Mesh().append(turned(ring(0.600, 0.030, 0.018, BRASS, 120), (1, 0, 0), 90))
    for s in (-1, 1):
        knob(frame, (0, s * 0.622, 0), 0.022, BRASS)
        frame.tube([(0, s * 0.60, 0), (0, s * 0.52, 0)], 0.006, BRASS, 10)
    document.node(
        "meridian",
        document.mesh("meridian", frame, metal),
        root,
        rotation=quaternion((0, 1, 0), 0.5),
    )
    spin(document, len(document.nodes) - 1, (0, 1, 0), 1, phase=0.5)
    hoops = (
        ("horizon", 0.545, 0.052, 0.008, BRASS, 180, (0, 1, 0), quaternion((0, 0, 1), 0.41), -1),
        ("ecliptic", 0.480, 0.018, 0.014, COPPER, 0, (1, 0, 0), quaternion((0, 0, 1), -0.5), 2),
        ("colure", 0.420, 0.015, 0.012, BRASS, 0, (0, 0, 1), quaternion((1, 0, 0), 1.1), -2),
        ("inner", 0.345, 0.026, 0.007, SILVER, 72, (1, 0, 0), quaternion((0, 1, 0), 0.9), 3),
    )
    for name, radius, width, thick, colour, ticks, axis, tilt, turns in hoops:
        mesh = ring(radius, width, thick, colour, ticks)
        node = document.node(name, document.mesh(name, mesh, metal), root)
        spin(document, node, axis, turns, tilt)


def planets(document, root, metal, enamel):
    """Each on a thin arm; the outer ones pass 0.6 m in front of the wall."""
    family = (  # name, orbit, radius, colour, inclination, turns, phase
        ("ember", 0.165, 0.020, (0.75, 0.22, 0.08), 8, 8, 0.4),
        ("pearl", 0.225, 0.026, (0.82, 0.74, 0.60), -10, -6, 2.2),
        ("fjord", 0.290, 0.034, (0.06, 0.38, 0.48), 14, 5, 4.0),
        ("rust", 0.385, 0.028, (0.60, 0.19, 0.09), -6, -4, 5.2),
        ("giant", 0.690, 0.062, (0.66, 0.42, 0.22), 6, 2, 1.15),
        ("ice", 0.660, 0.040, (0.20, 0.55, 0.70), -17, -3, 3.6),
    )
    for k, (name, orbit, radius, colour, inclination, turns, phase) in enumerate(family):
        tilt = quaternion((0.4 * math.cos(k), 0, 1), math.radians(inclination))
        arm = Mesh()
        arm.tube([(0.10, 0, 0), (orbit - radius, 0, 0)], 0.0035, BRASS, 6)
        knob(arm, (orbit - radius * 1.02, 0, 0), 0.0085, BRASS)
        carrier = document.node(name + " arm", document.mesh(name + " arm", arm, metal), root)
        spin(document, carrier, (0, 1, 0), turns, tilt, phase)
        ball = document.mesh(name, planet(radius, colour, 90 + k, name == "giant"), enamel)
        node = document.node(
            name, ball, carrier, translation=(orbit, 0, 0), rotation=quaternion((1, 0, 0.4), 0.4)
        )
        spin(document, node, (0, 1, 0), 6, quaternion((1, 0, 0.4), 0.4))


def crystal(seed):
    """A long six-sided ice crystal with chamfered tips, 1 high."""
    mesh = Mesh()
    dice = random.Random(seed)
    angles = [2 * math.pi * (k + 0.35 * (dice.random() - 0.5)) / 6 for k in range(6)]
    levels = [(0.0, -0.5), (0.15, -0.26), (0.19, 0.20), (0.0, 0.5)]
    for (ra, ya), (rb, yb) in zip(levels, levels[1:]):
        for k in range(6):
            a, b = angles[k], angles[(k + 1) % 6]
            corners = [
                (ra * math.cos(a), ya, -ra * math.sin(a)),
                (ra * math.cos(b), ya, -ra * math.sin(b)),
                (rb * math.cos(b), yb, -rb * math.sin(b)),
                (rb * math.cos(a), yb, -rb * math.sin(a)),
            ]
            tone = mix((0.10, 0.42, 0.55), (0.78, 0.95, 1.0), dice.random())
            mesh.face(corners, tone)
    return mesh


CRYSTALS = (  # place in wall, height, lean
    ((-1.34, 0.40, 0.34), 0.17, 0.5),
    ((-1.02, -0.34, 0.52), 0.12, -0.7),
    ((-1.48, -0.02, 0.12), 0.09, 0.2),
    ((1.30, 0.34, 0.40), 0.14, -0.4),
    ((1.05, -0.40, 0.55), 0.15, 0.8),
    ((1.46, -0.10, 0.16), 0.08, -0.2),
    ((0.80, 0.62, 0.22), 0.07, 0.3),
    ((-0.78, 0.66, 0.26), 0.08, -0.5),
)


def crystals(document, ice):
    for k, (place, height, lean) in enumerate(CRYSTALS):
        shape = Mesh().append(crystal(300 + k), placed(scale=height))
        node = document.node(
            f"crystal {k}", document.mesh(f"crystal {k}", shape, ice), translation=place
        )
        spin(
            document,
            node,
            (0, 1, 0),
            (3, -2, 4, -3, 2, -4, 5, -5)[k],
            quaternion((0.3, 0, 1), lean),
            0.7 * k,
        )
        steps, waves = 48, (4, 3, 5, 4, 3, 5, 6, 6)[k]
        times = [PERIOD * i / steps for i in range(steps + 1)]
        bob = [
            add(place, (0, 0.035 * math.sin(2 * math.pi * (waves * i / steps) + k), 0))
            for i in range(steps + 1)
        ]
        document.animate(node, "translation", times, bob)


def build(document, metal, enamel, core, ice):
    root = document.node("orrery", translation=CENTRE)
    heart = document.node("sun", document.mesh("sun", sun(), core), root)
    spin(document, heart, (0.2, 1, 0), 2)
    rings(document, root, metal)
    planets(document, root, metal, enamel)
    crystals(document, ice)
