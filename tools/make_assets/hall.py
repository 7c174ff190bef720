"""Foreground of the show: the boat-ribbed hall that stands in the water, its lamps, the window
niche, reeds, a boat.

Thin verticals stand at the seams of the 7 x 4 wall, at depths from the screen plane to far inside
the hall.
"""

import math
import random

from light import WATER_Y, fogged, grain, shade
from mesh import Mesh, add, clamp, mix, mul, smoothstep, unit
from noise import fbm, noise

WALL = (5.185, 2.238)
SEAMS = [-WALL[0] / 2 + k * WALL[0] / 7 for k in range(1, 7)]
RIB_Z = [-1.75 - 2.3 * k for k in range(8)]
HALF, APEX = 2.95, 3.45  # half width at the water, height of the ridge above it is APEX + 1.2
TIMBER = (0.30, 0.185, 0.105)
IRON = (0.045, 0.042, 0.045)
GLASS = (1.0, 0.60, 0.24)

# Lantern posts stand on seams: (seam index, z, height of the lamp).
POSTS = (
    (0, -0.55, -0.22),
    (5, -0.55, -0.22),
    (1, -2.9, 0.02),
    (4, -2.9, 0.02),
    (2, -7.4, 0.10),
    (3, -7.4, 0.10),
    (0, -9.5, -0.05),
    (5, -9.5, -0.05),
    (1, -14.0, 0.05),
    (4, -14.0, 0.05),
    (2, -17.5, 0.15),
    (3, -17.5, 0.15),
)
PENDANTS = tuple((0.0, 1.62, z) for z in RIB_Z[1:])


def lamps():
    found = [((SEAMS[k], y, z), 1.25, 1.30) for k, z, y in POSTS]
    return found + [((x, y, z), 1.75, 2.1) for x, y, z in PENDANTS]


def timber_light(lights):
    def light(p, n, albedo):
        height = p[1] - WATER_Y
        wet = mix((0.42, 0.45, 0.50), (1, 1, 1), smoothstep(0.02, 0.35, height))
        frost = smoothstep(0.75, 1.0, n[1]) * 0.5
        surface = mix(mul(albedo, grain(p, 7.0)), (0.6, 0.68, 0.78), frost)
        colour = shade(p, n, tuple(a * b for a, b in zip(surface, wet)), lights, 0.62)
        return fogged(colour, p, 1 / 260.0)

    return light


def rib_curve(t):
    """(x, y) of the right half's centre line, t = 0 in the water to 1 at the ridge: an upturned
    boat.
    """
    bend = t * math.pi / 2
    x = HALF * math.cos(bend) ** 0.72
    y = WATER_Y - 0.02 + (APEX - WATER_Y) * (0.62 * t + 0.38 * math.sin(bend))
    return x, y


def rib(mesh, z, segments=34):
    for side in (1, -1):
        frames = []
        for k in range(segments + 1):
            t = k / segments
            x, y = rib_curve(t)
            ahead, behind = rib_curve(min(1, t + 0.01)), rib_curve(max(0, t - 0.01))
            along = unit((ahead[0] - behind[0], ahead[1] - behind[1], 0))
            outward = (along[1], -along[0], 0) if t < 0.995 else (1.0, 0.0, 0.0)
            frames.append(((side * x, y, z), (side * outward[0], outward[1], 0), (0, 0, side)))
        w, d = 0.085, 0.065
        outline = [
            (-w, -d + 0.02),
            (-w + 0.02, -d),
            (w - 0.02, -d),
            (w, -d + 0.02),
            (w, d - 0.02),
            (w - 0.02, d),
            (-w + 0.02, d),
            (-w, d - 0.02),
        ]
        mesh.sweep(frames, outline[::-1], TIMBER)
    mesh.box((-HALF * 0.47, 2.24, z - 0.025), (HALF * 0.47, 2.32, z + 0.025), TIMBER, (14, 1))
    for s in (-1, 1):
        foot = Mesh()
        foot.lathe(
            [(0.19, -0.03), (0.185, 0.05), (0.15, 0.11), (0.0, 0.115)], 14, mul(TIMBER, 0.55)
        )
        mesh.append(foot, lambda p: add(p, (s * HALF, WATER_Y, z)))


def purlins(mesh):
    """Long thin laths along the hall: their foreshortening leads the eye to the fjord's end."""
    near, far = RIB_Z[0] + 0.10, RIB_Z[-1] - 0.10
    for t in (0.36, 0.60, 0.80, 1.0):
        for side in (1, -1) if t < 1 else (1,):
            x, y = rib_curve(t)
            out = 0.10
            centre = (side * (x + out * (1 - t)), y + out * t)
            w, h = (0.022, 0.045) if t < 1 else (0.05, 0.09)
            mesh.box(
                (centre[0] - w, centre[1] - h, far),
                (centre[0] + w, centre[1] + h, near),
                mul(TIMBER, 0.9),
                (40, 1),
                "-x+x",
            )
            mesh.face(
                [
                    (centre[0] - w, centre[1] - h, far),
                    (centre[0] + w, centre[1] - h, far),
                    (centre[0] + w, centre[1] - h, near),
                    (centre[0] - w, centre[1] - h, near),
                ],
                mul(TIMBER, 0.9),
                (1, 40),
            )
            mesh.face(
                [
                    (centre[0] - w, centre[1] + h, near),
                    (centre[0] + w, centre[1] + h, near),
                    (centre[0] + w, centre[1] + h, far),
                    (centre[0] - w, centre[1] + h, far),
                ],
                mul(TIMBER, 0.9),
                (1, 40),
            )


def lantern(body, glow, centre, size):
    """Six-sided: glass with iron bars, a roof and a ring; y is the glass' centre."""

    def put(mesh, part):
        mesh.append(part, lambda p: add(mul(p, size), centre))

    glass, iron = Mesh(), Mesh()
    glass.lathe(
        [(0, -0.95), (0.44, -0.95), (0.60, 0.60), (0, 0.60)],
        6,
        lambda p, n: mix((1.0, 0.93, 0.66), (1.0, 0.60, 0.20), clamp(abs(p[1] + 0.2) * 0.95)),
    )
    iron.lathe(
        [(0.0, 1.55), (0.06, 1.5), (0.10, 1.12), (0.74, 0.66), (0.70, 0.58), (0.0, 0.58)][::-1],
        6,
        IRON,
    )
    iron.lathe([(0.0, -1.12), (0.30, -1.12), (0.50, -0.98), (0.46, -0.90), (0, -0.90)], 6, IRON)
    for k in range(6):
        a = 2 * math.pi * k / 6
        low, high = (0.45 * math.cos(a), -0.95, -0.45 * math.sin(a)), (
            0.61 * math.cos(a),
            0.60,
            -0.61 * math.sin(a),
        )
        iron.tube([low, high], 0.037, IRON, 3, False)
    put(body, iron)
    put(glow, glass)


def halo(mesh, centre, radius, strength, colour=(1.0, 0.56, 0.20), stretch=1.0):
    """A soft disc that faces the viewer: light scattered in cold air."""
    sides, steps = 12, (0.0, 0.07, 0.18, 0.36, 0.62, 1.0)
    rings = []
    for t in steps:
        alpha = strength * (1 - t) ** 2.2
        rings.append(
            [
                mesh.vertex(
                    add(centre, (t * radius * math.cos(a), t * radius * stretch * math.sin(a), 0)),
                    (0, 0, 1),
                    (*colour, alpha),
                )
                for a in (2 * math.pi * k / sides for k in range(sides))
            ]
        )
    for inner, outer in zip(rings, rings[1:]):
        for k in range(sides):
            n = (k + 1) % sides
            mesh.triangle(inner[k], outer[k], outer[n])
            if inner is not rings[0]:
                mesh.triangle(inner[k], outer[n], inner[n])


def posts(body, glow, glows):
    """Slender posts with lanterns, exactly on seams; they end in the water."""
    for seam, z, y in POSTS:
        x = SEAMS[seam]
        count = 24
        body.tube(
            [(x, WATER_Y - 0.02 + (y - 0.09 - WATER_Y) * k / count, z) for k in range(count + 1)],
            0.011,
            IRON,
            8,
        )
        base = Mesh()
        base.lathe([(0.05, -0.02), (0.045, 0.05), (0.02, 0.10), (0.012, 0.16)], 10, IRON)
        body.append(base, lambda p: add(p, (x, WATER_Y, z)))
        lantern(body, glow, (x, y, z), 0.085)
        glows.append(((x, y, z), 0.42, 0.42))
    for x, y, z in PENDANTS:
        body.tube([(x, y + 0.1 + (2.25 - y - 0.1) * k / 3, z) for k in range(4)], 0.006, IRON, 6)
        lantern(body, glow, (x, y, z), 0.12)
        glows.append(((x, y, z), 0.60, 0.36))


def mullions(mesh):
    """Hair-thin rods exactly on the outer seams, a hand behind the screen, from edge to edge of the
    niche.
    """
    for seam in (0, 5):
        mesh.tube(
            [(SEAMS[seam], -1.2 + 2.4 * k / 40, -0.05) for k in range(41)],
            0.0055,
            (0.50, 0.30, 0.11),
            8,
        )


def niche(mesh):
    """The opening's cheeks behind the screen plane: what tells the eye that this is a hole in a
    wall.
    """
    x, y, depth = WALL[0] / 2, WALL[1] / 2, 0.17
    stone = (0.115, 0.088, 0.070)
    steps = 60
    mesh.face([(-x, -y, -depth), (-x, -y, 0), (-x, y, 0), (-x, y, -depth)], stone, (6, steps))
    mesh.face([(x, -y, 0), (x, -y, -depth), (x, y, -depth), (x, y, 0)], stone, (6, steps))
    mesh.face([(-x, -y, 0), (x, -y, 0), (x, -y, -depth), (-x, -y, -depth)], stone, (steps * 2, 6))
    mesh.face([(-x, y, -depth), (x, y, -depth), (x, y, 0), (-x, y, 0)], stone, (steps * 2, 6))
    # A thin brass line round the inner edge.
    brass, t, z = (0.62, 0.36, 0.12), 0.012, -depth
    mesh.box((-x, -y, z - t), (-x + t, y, z), brass, (1, steps))
    mesh.box((x - t, -y, z - t), (x, y, z), brass, (1, steps))
    mesh.box((-x, y - t, z - t), (x, y, z), brass, (steps, 1))
    # Behind the opening the wall goes on: seen only from far to the side.
    for s in (-1, 1):
        far = s * (x + 0.9)
        edge = sorted((s * x, far))
        mesh.box((edge[0], -1.6, -depth - t), (edge[1], 1.6, -depth), stone, (8, 12), "-z")


def niche_light(lights):
    def light(p, n, albedo):
        deep = clamp(-p[2] / 0.17)
        corner = min(
            1.0,
            0.35 + 2.2 * max(0.0, WALL[1] / 2 - abs(p[1]))
            if abs(n[0]) > 0.5
            else 0.35 + 2.2 * max(0.0, WALL[0] / 2 - abs(p[0])),
        )
        colour = shade(p, n, mul(albedo, grain(p, 14.0)), lights, 0.75 * corner)
        glint = mul((0.30, 0.46, 0.55), 0.030 * deep * corner)
        return add(colour, glint)

    return light


def reeds(count_side=64):
    """Frosted reeds in the lower corners and at the feet of the seams' posts."""
    mesh, dice = Mesh(), random.Random(12)
    spots = []
    for side in (-1, 1):
        for _ in range(count_side):
            spots.append((side * (1.45 + 2.2 * dice.random() ** 0.7), -0.30 - 1.15 * dice.random()))
    for seam in (0, 1, 4, 5):
        spots += [
            (SEAMS[seam] + 0.10 * (dice.random() - 0.5), -0.62 + 0.2 * (dice.random() - 0.5))
            for _ in range(7)
        ]
    for x, z in spots:
        tall = (0.28 + 0.50 * dice.random()) * (0.65 + 0.5 * smoothstep(1.2, 2.6, abs(x)))
        lean, turn = 0.05 + 0.22 * dice.random(), 2 * math.pi * dice.random()
        tone = mix((0.34, 0.27, 0.15), (0.52, 0.55, 0.56), dice.random())
        points, radii = [], []
        for k in range(7):
            t = k / 6
            bend = lean * tall * t * t
            points.append(
                (x + bend * math.cos(turn), WATER_Y - 0.01 + tall * t, z + bend * math.sin(turn))
            )
            radii.append(0.0045 * (1 - 0.85 * t))
        plume = dice.random() < 0.42
        mesh.tube(points, radii, tone, 3, False)
        if plume:
            tip = points[-1]
            mesh.tube(
                [
                    add(
                        points[-2],
                        mul(
                            (
                                tip[0] - points[-2][0],
                                tip[1] - points[-2][1],
                                tip[2] - points[-2][2],
                            ),
                            0.4 + 0.3 * k,
                        ),
                    )
                    for k in range(5)
                ],
                [0.002, 0.0085, 0.0100, 0.0065, 0.001],
                mix(tone, (0.62, 0.66, 0.70), 0.45),
                5,
                False,
            )
    return mesh


def boat():
    """A Nordland boat, 4.6 m, bow towards +x; y = 0 is the water line."""
    mesh = Mesh()
    stations, strakes, length = 19, 7, 2.3

    def hull(u, v, inset):
        s = 2 * u - 1  # -1 stern, 1 bow
        wide = (0.66 - inset) * (1 - abs(s) ** 2.4) ** 0.8
        sheer = 0.40 + 0.62 * abs(s) ** 3.2  # the gunwale rises to both ends
        keel = -0.16 + 0.50 * abs(s) ** 7 + inset
        return (
            s * length,
            keel + (sheer - keel) * v**1.25,
            wide * math.sin(v * math.pi / 2) ** 0.62,
        )

    wood, inner = (0.20, 0.115, 0.062), (0.26, 0.16, 0.09)
    for side in (1, -1):
        for k in range(strakes):  # each strake overlaps the one below
            lap = 0.012
            rows = []
            for v, out in ((k / strakes, lap), ((k + 1) / strakes, 0.0)):
                rows.append(
                    [
                        (x, y, side * (z + out))
                        for x, y, z in (hull(i / (stations - 1), v, 0) for i in range(stations))
                    ]
                )
            tone = mul(wood, 0.85 + 0.3 * (k % 2))
            mesh.grid(rows if side == 1 else [r[::-1] for r in rows], tone)
        rows = [
            [
                (x, y, side * z)
                for x, y, z in (hull(i / (stations - 1), v, 0.03) for i in range(stations))
            ]
            for v in (0, 0.3, 0.6, 1)
        ]
        mesh.grid(rows if side == -1 else [r[::-1] for r in rows], inner)
        rail = [add(hull(i / (stations - 1), 1, 0.01), (0, 0.01, 0)) for i in range(stations)]
        mesh.tube([(x, y, side * z) for x, y, z in rail], 0.026, (0.32, 0.20, 0.10), 6)
    for s in (-1, 1):  # the high stems
        mesh.tube(
            [
                (s * (length - 0.12), 0.30, 0),
                (s * (length + 0.02), 0.80, 0),
                (s * (length + 0.05), 1.18, 0),
                (s * (length - 0.03), 1.42, 0),
            ],
            [0.06, 0.05, 0.04, 0.025],
            (0.32, 0.20, 0.10),
            6,
        )
    for x in (-1.1, 0.0, 1.0):
        mesh.box((x - 0.12, 0.20, -0.55), (x + 0.12, 0.24, 0.55), inner, (1, 4))
    mesh.tube([(0.2, 0.1, 0), (0.2, 3.3, 0)], [0.045, 0.028], (0.32, 0.20, 0.10), 8)
    mesh.tube(
        [(0.26, 3.0, -0.9), (0.26, 3.02, 0), (0.26, 3.0, 0.9)],
        [0.02, 0.03, 0.02],
        (0.32, 0.20, 0.10),
        6,
    )
    return mesh


def rippled(mesh):
    """The image in moving water: sideways shivers that grow with the depth of the image."""
    for i, (x, y, z) in enumerate(mesh.positions):
        depth = WATER_Y - y
        near = clamp(-z / 3.0)
        push = (noise(y * 11.0 + z, z * 1.3, 71) - 0.5) * 0.05 * smoothstep(0.0, 0.8, depth) * near
        mesh.positions[i] = (x + push, y, z)
    return mesh


def water():
    """The surface over the mirrored scene: dark where one looks down into it, clear where one looks
    along it.
    """
    mesh = Mesh()
    columns = 92
    radii = [1.6 * (7000.0 / 1.6) ** ((j / 79) ** 1.35) for j in range(80)]
    eye_height, span = 1.3, math.radians(196)

    def colour(p, _):
        r = math.hypot(p[0], p[2] - 2.0)
        facing = eye_height / math.hypot(r, eye_height)
        mirror = 0.20 + 0.80 * (1 - facing) ** 2.6
        streak = fbm(p[0] * 1.1, p[2] * 5.5, 3, 55) - 0.5
        calm = 1 / (1 + r / 26.0)
        alpha = clamp(1 - mirror + 0.30 * streak * calm)
        light = clamp(0.5 + 2.0 * (streak - 0.10)) * calm
        tint = add((0.0025, 0.012, 0.019), mul((0.018, 0.050, 0.058), light * 0.9))
        return (*tint, max(0.05, alpha))

    rows = []
    for r in radii:
        rows.append(
            [
                (r * math.sin(a), WATER_Y, 2.0 - r * math.cos(a))
                for a in ((i / (columns - 1) - 0.5) * span for i in range(columns))
            ]
        )
    mesh.grid(rows, colour, normal=(0, 1, 0))
    return mesh
