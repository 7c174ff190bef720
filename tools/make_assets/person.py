"""The wearer: assets/lab/head.glb (head, neck, knitted yoke, helmet with three LED clusters) in head coordinates, and
assets/lab/body.glb, a standing figure whose origin is on the floor below the head's origin. Both face -z. Metres.
"""

import math

import gltf
from mesh import Mesh, add, clamp, cross, dot, mix, mul, placed, quaternion, smoothstep, sub, unit
from noise import fbm, noise

LEDS = ((-0.09, 0.0, -0.09), (0.0, 0.0, 0.0), (0.09, 0.0, -0.09))
EYES = ((-0.0315, -0.10, -0.19), (0.0315, -0.10, -0.19))
HEAD_HEIGHT = 1.75                 # of the head's origin above the floor, for the body
SKIN = (0.62, 0.37, 0.26)
LIPS = (0.50, 0.20, 0.16)
HAIR = (0.085, 0.045, 0.024)
SHELL = (0.055, 0.075, 0.095)
TRIM = (0.45, 0.47, 0.48)
WOOL = (0.055, 0.105, 0.155)
CREAM = (0.62, 0.57, 0.48)
RED = (0.42, 0.055, 0.045)
TROUSERS = (0.060, 0.058, 0.066)
SHOES = (0.16, 0.085, 0.045)

# Height, half width, front z, back z of the skull without features.
SKULL = ((-0.1765, 0.006, -0.150, -0.130), (-0.174, 0.024, -0.174, -0.100), (-0.168, 0.037, -0.1815, -0.082), (-0.157, 0.0485, -0.1845, -0.064),
         (-0.142, 0.0575, -0.186, -0.046), (-0.122, 0.0645, -0.1875, -0.028), (-0.100, 0.0695, -0.1885, -0.016), (-0.075, 0.0735, -0.1895, -0.008),
         (-0.045, 0.0755, -0.1890, -0.005), (-0.015, 0.0735, -0.1830, -0.010), (0.012, 0.0650, -0.1690, -0.024), (0.032, 0.0500, -0.150, -0.046),
         (0.044, 0.0300, -0.128, -0.070), (0.0495, 0.006, -0.104, -0.094))


def between(table, y):
    """Rows of a table, smoothly interpolated by their first column (Catmull-Rom)."""
    k = 0
    while k < len(table) - 2 and table[k + 1][0] < y:
        k += 1
    a, b = table[k], table[k + 1]
    before, after = table[max(0, k - 1)], table[min(len(table) - 1, k + 2)]
    t = clamp((y - a[0]) / (b[0] - a[0]))
    result = []
    for p0, p1, p2, p3 in zip(before[1:], a[1:], b[1:], after[1:]):
        result.append(0.5 * (2 * p1 + (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t * t + (3 * p1 - p0 - 3 * p2 + p3) * t ** 3))
    return result


def bump(x, y, cx, cy, wx, wy):
    return math.exp(-0.5 * (((x - cx) / wx) ** 2 + ((y - cy) / wy) ** 2))


def features(x, y):
    """How far the face stands out (towards -z) at a place, seen from the front."""
    a = abs(x)
    out = 0.0
    bridge = smoothstep(-0.137, -0.126, y) * smoothstep(-0.083, -0.122, y)
    out += 0.0245 * bridge * math.exp(-0.5 * (x / (0.0062 + 0.0030 * smoothstep(-0.105, -0.127, y))) ** 2)
    out += 0.0060 * bump(a, y, 0.0115, -0.1290, 0.0040, 0.0045)          # nostrils
    out -= 0.0095 * bump(a, y, 0.0305, -0.0995, 0.0125, 0.0095)          # eye sockets
    out += 0.0050 * bump(a, y, 0.0270, -0.0800, 0.0190, 0.0060)          # brows
    out += 0.0045 * bump(a, y, 0.0430, -0.1200, 0.0130, 0.0120)          # cheeks
    out += 0.0055 * bump(x, y, 0.0, -0.1455, 0.0160, 0.0075)             # mouth
    out -= 0.0032 * bump(x, y, 0.0, -0.1462, 0.0170, 0.0013)
    out -= 0.0028 * bump(x, y, 0.0, -0.1560, 0.0130, 0.0030)
    out += 0.0060 * bump(x, y, 0.0, -0.1660, 0.0140, 0.0070)             # chin
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
    rows, sides, levels = [], 128, 110
    for j in range(levels + 1):
        t = j / levels
        y = -0.1765 + (0.0495 + 0.1765) * (0.5 - 0.5 * math.cos(math.pi * (0.04 + 0.92 * t)) - 0.0039) / 0.9921
        y = clamp(y, -0.1765, 0.0495)
        half, front, back = between(SKULL, y)
        middle, reach = 0.5 * (front + back), 0.5 * (back - front)
        ring = []
        for i in range(sides):
            a = 2 * math.pi * i / sides
            # Points are closer together on the face.
            a += 0.45 * math.cos(a) * 1.0
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
    for depth, size in ((0.0, 0.62), (0.007, 0.98), (0.0105, 1.0), (0.0095, 0.80), (0.0060, 0.55), (0.0052, 0.0)):
        rows.append([(side * (0.066 + depth + 0.004 * math.sin(a) * 0.0), -0.098 + 0.029 * size * math.sin(a) - 0.002, -0.083 + 0.0165 * size * math.cos(a) + 0.30 * depth)
                     for a in (2 * math.pi * i / n for i in range(n))])
    # Seen from +x, +y up and -z right: the ring runs counter-clockwise for the right ear when z falls first.
    rows = [row[::-1] for row in rows] if side > 0 else rows
    mesh.grid(rows, mix(SKIN, (0.62, 0.24, 0.18), 0.25), closed=True)
    return mesh


def eyes(mesh):
    for x, y, z in EYES:
        centre = (x * 0.97, y + 0.0005, z + 0.0165)
        ball = Mesh()

        def colour(p, n):
            toward = math.acos(clamp(-n[2], -1, 1))
            if toward < 0.20:
                return (0.01, 0.01, 0.012)
            if toward < 0.46:
                return mix((0.10, 0.24, 0.30), (0.03, 0.07, 0.10), smoothstep(0.36, 0.46, toward))
            return (0.72, 0.70, 0.67)
        ball.sphere((0, 0, 0), 0.0122, (1, 1, 1), 40, 28)
        turned = Mesh().append(ball, placed(turn=quaternion((1, 0, 0), math.pi / 2)))
        turned.bake(lambda p, n, c: colour(p, n))
        mesh.append(turned, lambda p: add(p, centre))
        lid = Mesh()
        for low, high, tone in ((math.radians(14), math.radians(80), 0.90), (math.radians(-70), math.radians(-27), 0.95)):
            rows = []
            for j in range(7):
                e = low + (high - low) * j / 6
                rows.append([(0.0132 * math.cos(e) * math.sin(a), 0.0132 * math.sin(e), -0.0132 * math.cos(e) * math.cos(a))
                             for a in (math.radians(78 - 156 * i / 16) for i in range(17))])
            lid.grid(rows, mul(SKIN, tone * 0.92))
        mesh.append(lid, lambda p: add(p, centre))


def helmet():
    """A light shell over the crown with vents, a trim, a chin strap, and a bracket for each LED cluster."""
    mesh = Mesh()
    centre, radii = (0, -0.040, -0.100), (0.0865, 0.1080, 0.1055)
    sides, levels = 96, 26

    def edge(a):
        """Lower edge's elevation: high over the brow, low behind."""
        forward = math.sin(a)
        return math.radians(-14 + 20 * smoothstep(-0.3, 0.9, forward))

    def point(a, t, grow=0.0):
        e = edge(a) + (math.pi / 2 - edge(a)) * t
        ridge = 0.0022 * math.cos(5 * (a - math.pi / 2)) ** 2 * math.sin(math.pi * t)
        r = 1 + (grow + ridge) / 0.1
        return (centre[0] + radii[0] * r * math.cos(e) * math.cos(a), centre[1] + radii[1] * r * math.sin(e),
                centre[2] - radii[2] * r * math.cos(e) * math.sin(a))

    angles = [2 * math.pi * i / sides for i in range(sides)]

    def paint(p, n):
        across = abs(p[0])
        stripe = smoothstep(0.0125, 0.0110, across) * smoothstep(-0.02, 0.0, p[1])
        return mix(SHELL, RED, stripe)
    mesh.grid([[point(a, j / levels, 0.002) for a in angles] for j in range(levels + 1)], paint, closed=True)
    mesh.grid([[point(a, 0, -0.009) for a in angles], [point(a, 0, 0.002) for a in angles]], mul(SHELL, 0.6), closed=True)
    rim = [point(a, 0.0, 0.003) for a in angles] + [point(angles[0], 0.0, 0.003)]
    mesh.tube(rim, 0.0040, TRIM, 8, False)
    for side in (-1, 1):                                  # vents: dark slots from front to back
        for offset in (0.42, 0.80):
            slot = []
            for j in range(9):
                t = 0.30 + 0.38 * j / 8
                slot.append(point(math.pi / 2 - side * offset * (1 + 0.5 * t), t, 0.0035))
            mesh.tube(slot, [0.001, 0.003, 0.0042, 0.005, 0.005, 0.005, 0.0042, 0.003, 0.001], (0.006, 0.006, 0.007), 8)
    for side in (-1, 1):
        strap = [(side * 0.078, -0.060, -0.100), (side * 0.0735, -0.105, -0.112), (side * 0.0665, -0.140, -0.126), (side * 0.040, -0.172, -0.140), (0, -0.1815, -0.145)]
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
        holder.lathe([(0.0125, -0.012), (0.0150, -0.003), (0.0150, 0.0), (0.0128, 0.0015), (0.0118, -0.0005), (0.0, -0.0005)], 28, (0.02, 0.02, 0.022))
        disc.lathe([(0.0117, -0.0002), (0.0, -0.0001)], 28, (0.75, 0.03, 0.02))
        for k in range(4):
            a = math.pi / 4 + math.pi / 2 * k
            led = Mesh()
            led.sphere((0.0060 * math.cos(a), 0.0, -0.0060 * math.sin(a)), (0.0026, 0.0030, 0.0026), (1.0, 0.42, 0.30), 12, 8)
            disc.append(led)
        body.append(holder, carry)
        light.append(disc, carry)


def loft(mesh, table, centre_z, colour, sides=48, levels=40, power=1.0):
    """Ellipses by height: (y, half width, half depth, shift of z)."""
    low, high = table[0][0], table[-1][0]
    rows = []
    for j in range(levels + 1):
        y = low + (high - low) * j / levels
        half, deep, shift = between(table, y)
        rows.append([(half * math.copysign(abs(math.cos(a)) ** power, math.cos(a)), y,
                      centre_z + shift - deep * math.copysign(abs(math.sin(a)) ** power, math.sin(a)))
                     for a in (2 * math.pi * i / sides for i in range(sides))])
    mesh.grid(rows, colour, closed=True)


def knit(angle, y):
    """The yoke's pattern in the tradition of Norwegian sweaters: bands, diamonds and dots."""
    u = (angle / (2 * math.pi) * 24) % 1
    d = abs(u - 0.5) * 2
    if -0.292 < y < -0.283 or -0.352 < y < -0.344:
        return CREAM
    if -0.343 < y < -0.293:
        v = abs((y + 0.318) / 0.025)
        if abs(d + v - 0.95) < 0.16 or d + v < 0.35:
            return CREAM
        return RED if d + v < 0.8 else WOOL
    if -0.372 < y < -0.356:
        return CREAM if (u * 2) % 1 < 0.4 and abs(y + 0.364) < 0.004 else WOOL
    return WOOL


def bust(mesh):
    """Neck, collar, and a round knitted yoke that may turn with the head over the body's shoulders."""
    loft(mesh, ((-0.275, 0.060, 0.060, 0.0), (-0.235, 0.0535, 0.056, 0.0), (-0.19, 0.0515, 0.056, -0.004), (-0.135, 0.0525, 0.058, -0.012), (-0.10, 0.050, 0.05, -0.016)),
         -0.078, lambda p, n: mul(SKIN, 0.62 + 0.38 * smoothstep(-0.150, -0.235, p[1])))
    rows, sides = [], 144
    profile = ((0.168, -0.415), (0.166, -0.398), (0.160, -0.375), (0.150, -0.350), (0.136, -0.325), (0.117, -0.302), (0.098, -0.285), (0.082, -0.272),
               (0.074, -0.260), (0.0735, -0.243), (0.0715, -0.236), (0.066, -0.2345), (0.062, -0.240), (0.060, -0.26))
    fine = []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        fine += [(r0 + (r1 - r0) * k / 6, y0 + (y1 - y0) * k / 6) for k in range(6)]
    fine.append(profile[-1])
    for r, y in fine:
        rows.append([(r * 1.04 * math.cos(a), y, -0.078 - r * 0.92 * math.sin(a)) for a in (2 * math.pi * i / sides for i in range(sides))])

    def colour(p, n):
        angle = math.atan2(-(p[2] + 0.078), p[0]) % (2 * math.pi)
        rib = 0.85 + 0.15 * math.cos(angle * 72) if p[1] > -0.27 else 1.0
        shade = 0.55 + 0.45 * smoothstep(-0.262, -0.30, p[1]) if p[1] < -0.262 else 0.9
        return mul(knit(angle, p[1]), rib * shade)
    mesh.grid(rows, colour, closed=True)


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
    document = gltf.Document("Head with helmet")
    parts = (("skin", solid, document.material("skin", (0.80, 0.80, 0.80, 1), roughness=0.55)),
             ("wool", cloth, document.material("wool", (0.80, 0.80, 0.80, 1), roughness=0.95)),
             ("helmet", shell, document.material("helmet", roughness=0.32)),
             ("leds", light, document.material("leds", (0.4, 0.4, 0.4, 1), roughness=0.4, emissive=(0.80, 0.05, 0.03))))
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


def limb(mesh, points, radii, colour, sides=22):
    """A smooth tube through points (Catmull-Rom), closed with round ends by its own radii."""
    fine_points, fine_radii = [], []
    n = len(points)
    for k in range(n - 1):
        p0, p1, p2, p3 = points[max(0, k - 1)], points[k], points[k + 1], points[min(n - 1, k + 2)]
        for j in range(6):
            t = j / 6
            fine_points.append(tuple(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t ** 3)
                                     for a, b, c, d in zip(p0, p1, p2, p3)))
            fine_radii.append(radii[k] + (radii[k + 1] - radii[k]) * t)
    fine_points.append(points[-1])
    fine_radii.append(radii[-1])
    mesh.tube(fine_points, fine_radii, colour, sides)


def torso(mesh, z):
    table = ((0.86, 0.155, 0.105, 0.0), (0.90, 0.172, 0.122, 0.0), (0.98, 0.170, 0.120, 0.0), (1.08, 0.160, 0.112, 0.0), (1.20, 0.176, 0.120, 0.0),
             (1.30, 0.196, 0.124, 0.0), (1.365, 0.205, 0.114, 0.004), (1.405, 0.190, 0.098, 0.006), (1.435, 0.140, 0.078, 0.006), (1.452, 0.090, 0.062, 0.004), (1.458, 0.050, 0.045, 0.002))

    def colour(p, n):
        angle = math.atan2(-(p[2] - z), p[0]) % (2 * math.pi)
        if p[1] < 0.905:
            return mul(WOOL, 0.75 + 0.25 * math.cos(angle * 80))
        if p[1] < 1.30:
            u, v = (angle / (2 * math.pi) * 56) % 1, (p[1] * 26) % 1
            if abs(u - 0.5) < 0.16 and abs(v - 0.5) < 0.16:
                return mix(WOOL, CREAM, 0.75)
        return WOOL
    loft(mesh, table, z, colour, 168, 120, 0.9)


def legs(mesh, z):
    for s in (-1, 1):
        limb(mesh, [(s * 0.070, 0.93, z), (s * 0.088, 0.84, z - 0.004), (s * 0.095, 0.66, z - 0.008), (s * 0.098, 0.48, z - 0.006), (s * 0.100, 0.30, z + 0.012), (s * 0.102, 0.10, z + 0.018), (s * 0.102, 0.055, z + 0.018)],
             [0.080, 0.094, 0.082, 0.062, 0.060, 0.054, 0.056], TROUSERS)
        shoe = Mesh()
        shoe.sphere((0, 0, 0), 1.0, SHOES, 32, 20)
        for i, (x, y, zz) in enumerate(shoe.positions):
            toe = -zz
            shoe.positions[i] = (s * 0.104 + 0.047 * x * (1 - 0.15 * toe), max(0.0, 0.040 + (0.052 - 0.016 * toe) * y), z - 0.045 + 0.140 * zz)
        mesh.append(shoe)


def arms(mesh, z):
    for s in (-1, 1):
        limb(mesh, [(s * 0.150, 1.385, z + 0.004), (s * 0.195, 1.365, z + 0.006), (s * 0.226, 1.25, z + 0.012), (s * 0.242, 1.10, z + 0.010), (s * 0.250, 0.97, z - 0.016), (s * 0.250, 0.865, z - 0.050)],
             [0.050, 0.062, 0.055, 0.047, 0.043, 0.038], WOOL)
        limb(mesh, [(s * 0.250, 0.885, z - 0.043), (s * 0.250, 0.860, z - 0.052)], [0.041, 0.041], CREAM)
        palm = Mesh()
        palm.sphere((0, 0, 0), (0.021, 0.052, 0.039), SKIN, 20, 14)
        for k in range(4):
            palm.tube([(0, -0.035, -0.026 + 0.017 * k), (-s * 0.006, -0.075 - 0.006 * (k in (1, 2)), -0.026 + 0.016 * k), (-s * 0.016, -0.098 - 0.006 * (k in (1, 2)), -0.023 + 0.015 * k)], [0.0105, 0.0095, 0.007], SKIN, 10)
        palm.tube([(-s * 0.004, 0.000, -0.030), (-s * 0.016, -0.030, -0.048), (-s * 0.020, -0.052, -0.050)], [0.013, 0.011, 0.008], SKIN, 10)
        mesh.append(palm, lambda p: add(p, (s * 0.249, 0.815, z - 0.068)))


def make_body(file):
    mesh = Mesh()
    z = -0.078
    torso(mesh, z)
    legs(mesh, z)
    arms(mesh, z)

    def contact(p, n, c):
        shade = 0.55 + 0.45 * smoothstep(0.0, 0.25, p[1])
        inner = 0.70 + 0.30 * smoothstep(0.16, 0.21, abs(p[0])) if 0.9 < p[1] < 1.33 and abs(p[0]) > 0.13 else 1.0
        crotch = 0.65 + 0.35 * smoothstep(0.0, 0.07, abs(p[0])) if p[1] < 0.88 else 1.0
        return mul(c, shade * inner * crotch)
    mesh.bake(contact)
    document = gltf.Document("Standing body")
    document.node("body", document.mesh("body", mesh, document.material("cloth", (0.80, 0.80, 0.80, 1), roughness=0.9)))
    document.write(file)
