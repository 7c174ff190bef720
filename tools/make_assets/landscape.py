"""Far and middle distance of the show: mountains on both sides of a fjord, snowy islets, cabins, a
stave church.
"""

import math
import random

from light import TO_MOON, WATER_Y, fogged, grain, shade
from mesh import Mesh, add, clamp, dot, mix, mul, placed, quaternion, smoothstep, unit
from noise import fbm, noise, ridged

SNOW = (0.74, 0.82, 0.93)
ROCK = (0.060, 0.066, 0.080)
FOREST = (0.020, 0.034, 0.036)
WINDOW = (1.0, 0.50, 0.14)
EYE_REACH = 6.0  # metres: eyes and their images in the water are about as near to the origin
FLAT_TREES = 270.0  # metres: from here on a tree is one triangle


def shore(x, z):
    """Metres from the fjord's shore into the land (negative: water); the fjord winds towards -z and
    ends there.
    """
    middle = 0.11 * -z + 120 * math.sin(-z / 620.0) + 40 * math.sin(-z / 233.0 + 1)
    half = 270 + 0.075 * -z + 90 * (noise(z / 300.0, 0.5, 3) - 0.5)
    side = abs(x - middle) - half
    end = -z - 4300 - 500 * noise(x / 500.0, 2.5, 4)
    wiggle = 70 * (fbm(x / 210.0, z / 210.0, 3, 9) - 0.5)
    return max(side, end) + wiggle


def land_height(x, z):
    """Metres above the water."""
    inland = shore(x, z)
    if inland <= 0:
        return 0.0
    away = math.hypot(x, z)
    crest = ridged(x / 1050.0 + 3.3, z / 1050.0 + 8.1, 6, 21)
    gap = 1 - 0.62 * math.exp(-(((math.atan2(x, -z) - 0.10) / 0.085) ** 2)) * smoothstep(
        2500, 4500, away
    )
    tall = (190 + 0.150 * min(away, 5200)) * gap
    rise = 1 - math.exp(-inland / (150 + 0.09 * away))
    return (
        1.5
        + tall * rise * (0.22 + 1.05 * crest)
        + 9 * fbm(x / 45.0, z / 45.0, 3, 33) * min(1, inland / 60)
    )


def land_colour(position, normal, fine=True):
    x, y, z = position
    height = y - WATER_Y
    rough = fbm(x / 70.0, (y * 1.7 + z) / 70.0, 4, 41) - 0.5
    steep = 1 - normal[1]
    snow = smoothstep(0.50, 0.26, steep + 0.85 * rough) * smoothstep(-20, 60, height + 60 * rough)
    wood = smoothstep(150, 40, height + 160 * rough) * smoothstep(0.85, 0.45, steep)
    ground = mix(ROCK, FOREST, wood * 0.8)
    albedo = mix(ground, SNOW, snow * (1 - 0.72 * wood))
    tilt = clamp(0.62 + 0.9 * dot(normal, TO_MOON))
    lit = mul(shade(position, normal, albedo), 0.55 + 0.75 * tilt)
    return fogged(lit, position)


def hidden(points):
    """For a polar grid around the viewer, what nearer ridges hide from every eye (and from its
    image in the water): a row of truth values for each ring.
    """
    width = len(points[0])
    crest, behind = [-1.0] * width, []
    for ring in points:
        row = []
        for i, (x, y, z) in enumerate(ring):
            away = math.hypot(x, z)
            row.append((y + EYE_REACH) / away < crest[i])
            crest[i] = max(crest[i], (y - EYE_REACH) / away)
        behind.append([all(row[max(0, i - 2) : i + 3]) for i in range(width)])
    return behind


def mountains(columns, rows):
    """A polar grid around the viewer; parts under water or behind others are left out."""
    span = math.radians(206)
    radii = [170.0 * (6600.0 / 170.0) ** (j / (rows - 1)) for j in range(rows)]
    points = []
    for r in radii:
        ring = []
        for i in range(columns):
            a = (i / (columns - 1) - 0.5) * span
            x, z = r * math.sin(a), -r * math.cos(a)
            ring.append((x, WATER_Y + land_height(x, z), z))
        points.append(ring)
    behind = [v for row in hidden(points) for v in row]
    full = Mesh()
    full.grid(points, (1, 1, 1))
    mesh, moved = Mesh(), {}
    for k in range(0, len(full.indices), 3):
        corner = full.indices[k : k + 3]
        if max(full.positions[i][1] for i in corner) <= WATER_Y + 0.01:
            continue
        if all(behind[i] for i in corner):
            continue
        for i in corner:
            if i not in moved:
                p, n = full.positions[i], full.normals[i]
                moved[i] = mesh.vertex(p, n, land_colour(p, n))
            mesh.indices.append(moved[i])
    return mesh


def islet(centre, radius, height, seed, lamps, sides=56, rings=16):
    """A low snow-covered rock with a dark wet foot."""
    cx, cz = centre
    rows = []
    for j in range(rings):
        t = j / (rings - 1)
        ring = []
        for i in range(sides):
            a = 2 * math.pi * i / sides
            out = (
                radius
                * (1 - t)
                * (0.72 + 0.56 * fbm(2.2 * math.cos(a) + 5, 2.2 * math.sin(a) + 5, 3, seed))
            )
            x, z = cx + out * math.cos(a), cz - out * math.sin(a)
            lift = (
                height
                * (t * (2 - t)) ** 1.3
                * (0.75 + 0.5 * fbm(x / radius * 2.5, z / radius * 2.5, 3, seed + 5))
            )
            ring.append((x, WATER_Y + (0.0 if j == 0 else lift), z))
        rows.append(ring)

    def colour(p, n):
        wet = smoothstep(
            0.10,
            0.035,
            (p[1] - WATER_Y) / max(1.0, height) + 0.05 * (noise(p[0] * 2, p[2] * 2, 8) - 0.5),
        )
        bare = smoothstep(
            0.30, 0.55, 1 - n[1] + 0.35 * (fbm(p[0] / 1.3, p[2] / 1.3 + p[1], 2, 17) - 0.5)
        )
        return fogged(
            shade(p, n, mix(SNOW, (0.05, 0.05, 0.055), max(wet, bare)), lamps), p, 1 / 1500.0
        )

    mesh = Mesh()
    mesh.grid(rows, colour, closed=True)
    return mesh


def gable(mesh, size, base, pitch, colours, overhang=0.12):
    """A house of walls and a pitched roof, ridge along x. size: x, wall height, z; colours: wall,
    roof, edge.
    """
    w, h, d = size[0] / 2, size[1], size[2] / 2
    wall, roof, edge = colours
    y0, y1, top = base, base + h, base + h + pitch
    mesh.box((-w, y0, -d), (w, y1, d), wall, (4, 3), "-x+x-z+z")
    for s in (-1, 1):
        tip = [(s * w, y1, s * d), (s * w, y1, -s * d), (s * w, top, 0), (s * w, top, 0)]
        mesh.face(tip, wall)
    o, drop = overhang, overhang * pitch / d
    for s in (-1, 1):
        eave, ridge = y1 - drop, top
        mesh.face(
            [
                (-s * (w + o), eave, s * (d + o)),
                (s * (w + o), eave, s * (d + o)),
                (s * (w + o), ridge, 0),
                (-s * (w + o), ridge, 0),
            ],
            roof,
            (5, 3),
        )
        mesh.face(
            [
                (-s * (w + o), eave - 0.12, s * (d + o)),
                (s * (w + o), eave - 0.12, s * (d + o)),
                (s * (w + o), eave, s * (d + o)),
                (-s * (w + o), eave, s * (d + o)),
            ],
            edge,
        )
        for t in (-1, 1):
            corners = [
                (s * (w + o), eave - 0.14, t * (d + o)),
                (s * (w + o), ridge - 0.14, 0),
                (s * (w + o), ridge, 0),
                (s * (w + o), eave, t * (d + o)),
            ]
            mesh.face(corners if s * t < 0 else corners[::-1], edge)


def panes(mesh, places, facing, size, colour=WINDOW):
    """Lit windows on a wall; colours above 0.9 mean: glows, no light falls on it."""
    w, h = size[0] / 2, size[1] / 2
    for x, y, z in places:
        if facing in "+z-z":
            s = 1 if facing == "+z" else -1
            mesh.face(
                [
                    (x - s * w, y - h, z),
                    (x + s * w, y - h, z),
                    (x + s * w, y + h, z),
                    (x - s * w, y + h, z),
                ],
                colour,
            )
        else:
            s = 1 if facing == "+x" else -1
            mesh.face(
                [
                    (x, y - h, z + s * w),
                    (x, y - h, z - s * w),
                    (x, y + h, z - s * w),
                    (x, y + h, z + s * w),
                ],
                colour,
            )


def cabin(size, wall, stilts):
    """A fisherman's cabin, front towards +z, floor at y = 0."""
    mesh = Mesh()
    gable(mesh, size, 0.0, size[2] * 0.42, (wall, SNOW, (0.5, 0.5, 0.5)), 0.22)
    x, y, z = size[0] / 2, size[1] * 0.52, size[2] / 2 + 0.02
    panes(
        mesh,
        [(-x * 0.52, y, z), (x * 0.10, y, z), (x * 0.62, y, z)],
        "+z",
        (size[0] * 0.13, size[1] * 0.34),
    )
    for s in "+x", "-x":
        panes(
            mesh,
            [((x + 0.02) * (1 if s == "+x" else -1), y, 0)],
            s,
            (size[2] * 0.2, size[1] * 0.34),
        )
    mesh.box(
        (x * 0.55, size[1] + size[2] * 0.2, -0.3),
        (x * 0.55 + 0.45, size[1] + size[2] * 0.42 + 0.6, 0.15),
        (0.10, 0.09, 0.09),
    )
    if stilts:
        mesh.box((-x - 0.3, -0.16, -z), (x + 0.3, 0.0, z + 1.1), (0.16, 0.12, 0.09))
        for k in range(6):
            for zz in (z + 0.9, -z * 0.2):
                px = -x + 2 * x * k / 5
                mesh.box(
                    (px - 0.09, -stilts, zz - 0.09),
                    (px + 0.09, -0.1, zz + 0.09),
                    (0.09, 0.07, 0.06),
                )
    return mesh


def stave_church():
    """Roofs stacked to a spire, tarred wood with snow on the shingles; front towards +z."""
    mesh = Mesh()
    tar, roof, edge = (0.085, 0.050, 0.034), (0.55, 0.61, 0.70), (0.20, 0.12, 0.08)

    def tier(width, height, depth, base, pitch, turned=False, lift=0.3):
        part = Mesh()
        gable(part, (width, height, depth), base, pitch, (tar, roof, edge), lift)
        mesh.append(part, placed(turn=quaternion((0, 1, 0), math.pi / 2)) if turned else None)

    tier(8.4, 2.2, 7.4, 0.0, 2.5, True, 0.55)
    tier(5.6, 3.1, 4.2, 2.6, 2.9, True, 0.45)
    tier(3.3, 2.2, 2.8, 6.9, 2.2, True, 0.35)
    tier(1.7, 1.5, 1.5, 10.2, 1.3, True, 0.25)
    spire = Mesh()
    spire.lathe([(0.0, 11.6), (0.95, 11.6), (0.32, 13.4), (0.06, 16.6), (0.0, 16.7)], 8, roof)
    mesh.append(spire)
    tier(2.6, 2.2, 2.6, 0.0, 1.7, True, 0.3)
    porch = Mesh()
    gable(porch, (2.8, 2.0, 2.4), 0.0, 1.8, (tar, roof, edge), 0.3)
    mesh.append(porch, lambda p: add(rotated_quarter(p), (0, 0, 5.1)))
    panes(mesh, [(0, 1.0, 6.55)], "+z", (1.1, 1.9), (1.0, 0.56, 0.18))
    panes(mesh, [(-2.6, 1.25, 4.24), (2.6, 1.25, 4.24)], "+z", (0.55, 0.9))
    panes(mesh, [(0, 5.0, 2.83), (-1.2, 4.6, 2.83), (1.2, 4.6, 2.83)], "+z", (0.5, 0.9))
    panes(mesh, [(0, 8.2, 1.68)], "+z", (0.5, 0.8))
    panes(mesh, [(-3.73, 1.25, z) for z in (-2.4, 0, 2.4)], "-x", (0.55, 0.9))
    panes(mesh, [(3.73, 1.25, z) for z in (-2.4, 0, 2.4)], "+x", (0.55, 0.9))
    return mesh


def rotated_quarter(p):
    return (p[2], p[1], -p[0])


def lit_building(mesh, centre, floor_y, turn, lamps, scale=1.0):
    """Placed in the scene and baked; windows (pure lamp colours) keep their glow."""
    world = Mesh().append(
        mesh, placed((centre[0], floor_y, centre[1]), quaternion((0, 1, 0), turn), scale)
    )

    def light(p, n, albedo):
        if albedo[0] > 0.95:
            return albedo
        low = 0.55 + 0.45 * smoothstep(0.0, 2.2, p[1] - floor_y)
        return fogged(shade(p, n, mul(albedo, grain(p, 3.0)), lamps, low), p, 1 / 1500.0)

    return world.bake(light)


def spruce(mesh, centre, base, height, seed, lamps):
    """A snowy spruce of stacked ragged cones."""
    cx, cz = centre
    tiers = 5
    for k in range(tiers):
        t = k / tiers
        y0, y1 = base + height * (0.12 + 0.80 * t), base + height * (
            0.40 + 0.62 * t if k < tiers - 1 else 1.0
        )
        wide = height * 0.20 * (1 - t) + 0.05
        rim = []
        for i in range(11):
            a = 2 * math.pi * i / 11 + k
            r = wide * (0.78 + 0.44 * noise(i * 1.7, k * 2.3, seed))
            rim.append(
                (
                    cx + r * math.cos(a),
                    y0 - 0.05 * height * noise(i * 3.1, k, seed + 1),
                    cz - r * math.sin(a),
                )
            )

        def colour(p, n):
            frost = 0.30 + 0.5 * noise(p[0] * 5, p[1] * 5 + p[2] * 3, seed)
            lean = unit((p[0] - cx, 0.5, p[2] - cz))
            return fogged(
                shade(
                    p, lean, mix(FOREST, SNOW, frost * (0.15 if p[1] < y0 + 0.01 else 0.9)), lamps
                ),
                p,
                1 / 1500.0,
            )

        mesh.grid([rim, [(cx, y1, cz)] * 11], colour, closed=True)


def behind_land(azimuth, away, top):
    """Do nearer slopes hide a treetop (y in wall) from every eye?"""
    line = (top + EYE_REACH) / away
    for k in range(1, 20):
        r = 170 + (away - 170) * k / 20
        ground = WATER_Y + land_height(r * math.sin(azimuth), -r * math.cos(azimuth))
        if (ground - EYE_REACH) / r > line:
            return True
    return False


def forest(count=4600):
    """Snowy spruces on the lower slopes on both sides: they give the near mountains their scale."""
    mesh, dice = Mesh(), random.Random(19)
    planted = tries = 0
    while planted < count and tries < 60000:
        tries += 1
        azimuth = math.radians(205) * (dice.random() - 0.5)
        away = 230 * (1500 / 230) ** dice.random()
        x, z = away * math.sin(azimuth), -away * math.cos(azimuth)
        height = land_height(x, z)
        share = smoothstep(0.40, 0.62, fbm(x / 120.0, z / 120.0, 3, 91)) * smoothstep(
            135, 40, height
        )
        if height < 2.5 or dice.random() > share:
            continue
        planted += 1
        tall = (5 + 7 * dice.random()) * (0.7 + 0.3 * share)
        wide, base = tall * (0.17 + 0.05 * dice.random()), WATER_Y + height - 0.8
        frost, turn = 0.10 + 0.5 * dice.random() ** 1.5, dice.random() * 2
        if behind_land(azimuth, away, base + tall):
            continue
        rim = [
            (x + wide * math.cos(a + turn), base, z - wide * math.sin(a + turn))
            for a in (0, math.pi / 2, math.pi, 3 * math.pi / 2)
        ]

        def colour(p, n):
            snowy = frost if p[1] > base + 0.1 else frost * 0.25
            return fogged(shade(p, unit((n[0], 0.4, n[2])), mix(FOREST, SNOW, snowy)), p)

        top = (x, base + tall, z)
        if away > FLAT_TREES:
            across = (math.cos(azimuth), 0, math.sin(azimuth))
            toward = (-x / away, 0.25, -z / away)
            for s in (-1, 1, 0):
                side = s * 0.85 * wide
                p = (x + side * across[0], base, z + side * across[2]) if s else top
                n = unit(add(toward, mul(across, s)))
                mesh.indices.append(mesh.vertex(p, n, colour(p, n)))
            continue
        for k in range(4):
            a, b = rim[k], rim[(k + 1) % 4]
            n = unit((0.5 * (a[0] + b[0]) - x, 0.25 * wide, 0.5 * (a[2] + b[2]) - z))
            mesh.triangle(*(mesh.vertex(p, n, colour(p, n)) for p in (a, b, top)))
    return mesh


def islands():
    """All islets, and what stands on them."""
    ground, built = Mesh(), Mesh()
    church_x, church_z, church_y = 13.5, -52.0, WATER_Y + 2.55
    lamps = [
        ((church_x - 0.5, church_y + 1.6, church_z + 9.5), 2.6, 6.5),
        ((church_x - 6, church_y + 1.2, church_z + 3), 0.9, 4),
        ((church_x + 6, church_y + 1.4, church_z + 3), 0.9, 4),
        ((church_x - 0.3, church_y + 6.4, church_z + 7.5), 1.6, 6),
    ]
    ground.append(islet((church_x, church_z), 19, 3.1, 3, lamps, 80, 22))
    built.append(
        lit_building(stave_church(), (church_x, church_z), church_y - 0.3, -0.32, lamps, 1.2)
    )
    for k, (dx, dz, h) in enumerate(
        (
            (-9, -2, 5.5),
            (-11, 1, 4.2),
            (9.5, -3, 6.4),
            (11.5, 0.5, 4.6),
            (8.2, 4.6, 3.0),
            (-7.4, -7, 7),
        )
    ):
        spruce(built, (church_x + dx, church_z + dz), church_y - 0.9, h, 50 + k, lamps)
    reds = ((0.36, 0.045, 0.030), (0.40, 0.060, 0.034), (0.45, 0.30, 0.10))
    village = (
        (-21.5, -34, 0.42, 0),
        (-30.5, -40, 0.30, 1),
        (-17.0, -43.5, 0.25, 2),
        (-40, -33, 0.75, 0),
        (31, -36, -0.6, 1),
        (40, -41, -0.75, 0),
        (-52, -24, 1.0, 1),
        (50, -22, -1.1, 2),
        (-27, -62, 0.3, 0),
        (33, -78, -0.3, 1),
    )
    for k, (x, z, turn, tone) in enumerate(village):
        front = (x + 4.2 * math.sin(turn), WATER_Y + 2.3, z + 4.2 * math.cos(turn))
        lamps = [
            (front, 1.25, 2.6),
            ((x - 4.0 * math.cos(turn), WATER_Y + 2.4, z + 4 * math.sin(turn)), 0.6, 2.4),
        ]
        back = (x - 3.2 * math.sin(turn), z - 3.2 * math.cos(turn))
        ground.append(islet(back, 8.5, 1.5 + 0.4 * (k % 3), 60 + k, lamps, 44, 12))
        size = (5.4 + 0.8 * (k % 2), 2.3, 4.0)
        house = cabin(size, reds[tone], 1.3)
        built.append(lit_building(house, (x, z), WATER_Y + 1.15, turn, lamps))
        spruce(
            built, (back[0] - 3.5, back[1] - 2.5), WATER_Y + 0.7, 4.2 + 1.3 * (k % 3), 80 + k, lamps
        )
    rocks = random.Random(4)
    for k in range(16):
        side = -1 if k % 2 else 1
        x, z = side * (5.0 + 34 * rocks.random()), -4.5 - 30 * rocks.random()
        if abs(x) < 6.5 and z > -10:
            x += side * 3
        size = 0.5 + 1.5 * rocks.random() ** 2
        ground.append(islet((x, z), size, size * 0.42, 200 + k, [], 22, 8))
    return ground, built
