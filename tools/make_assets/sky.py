"""The sky of the show: a dome with dusk and aurora as a texture, and stars as small faces.

The aurora is drawn as it is in nature: thin folded curtains of light 100 km up, seen from below;
where a fold turns along the line of sight it is brighter.
"""

import math
import random

import gltf
from light import WATER_Y, sky_colour
from mesh import Mesh, add, clamp, cross, mix, mul, smoothstep, unit
from noise import fbm, noise

WIDTH, HEIGHT = 1792, 640
SPAN = math.radians(212)  # of azimuth, centred on -z
RADIUS = 9000.0
CURTAINS = (  # distance of the nearest part and height are in units of the aurora's lower edge
    # distance, drift, folds, strength, seed, reach
    (4.10, 0.10, 0.60, 1.00, 11, 1.35),
    (6.00, -0.22, 0.90, 0.80, 23, 1.60),
    (2.10, 0.22, 0.40, 0.55, 37, 1.50),
)


def elevation_of(v):
    """Rows are denser near the horizon. v: 0 at the zenith, 1 at the horizon."""
    return math.pi / 2 * (1 - v) ** 1.6


def row_of(elevation):
    return (1 - (max(0.0, elevation) / (math.pi / 2)) ** (1 / 1.6)) * (HEIGHT - 1)


def curtain_point(curtain, s):
    distance, drift, folds, _, seed, _ = curtain
    x = s
    z = distance + drift * s + folds * (fbm(s * 0.55 + 7, 0.5, 2, seed) - 0.5) * 3.0
    swirl = folds * 0.42
    x += swirl * (noise(s * 1.9, 3.5, seed + 3) - 0.5) * 3.2
    z += swirl * math.sin(s * 2.4 + 5 * noise(s * 0.8, 9.5, seed + 4)) * 0.8
    return x, max(0.25, z)


def splat(light, column, share, bottom, top, colour_strength):
    """One thin column of a curtain: sharp lower edge, long fade upwards."""
    low, high = row_of(bottom), row_of(top)
    foot = min(HEIGHT - 1, int(low + 0.02 * HEIGHT))
    span = max(1.0, low - high)
    strength = colour_strength * share
    for row in range(foot, max(0, int(high)) - 1, -1):
        t = (low - row) / span
        if t < 0:
            w = strength * max(0.0, 1 + t * span / (0.016 * HEIGHT))
            green, violet = w, 0.0
        else:
            w = strength * math.exp(-3.1 * t) * (1 - t)
            green, violet = w * (1 - t) ** 2, w * 0.62 * smoothstep(0.10, 0.75, t)
        cell = light[row * WIDTH + column]
        cell[0] += green
        cell[1] += violet


def draw_curtain(light, curtain):
    strength, seed, reach = curtain[3:]
    steps = 7000
    for k in range(steps):
        s = -9.0 + 18.0 * k / steps
        x, z = curtain_point(curtain, s)
        u = (math.atan2(x, z) / SPAN + 0.5) * (WIDTH - 1)
        column = int(u)
        if not 0 <= column < WIDTH - 1:
            continue
        away = math.hypot(x, z)
        rays = 0.35 + 0.65 * noise(s * 26, 1.5, seed + 8) * (
            0.4 + 1.2 * noise(s * 7, 4.5, seed + 9)
        )
        patches = smoothstep(0.28, 0.66, fbm(s * 0.42 + 3, 6.5, 2, seed + 10))
        bright = strength * rays * patches * 0.30 / (0.35 + 0.25 * away)
        if bright < 0.002:
            continue
        bottom = math.atan2(1.0, away)
        top = math.atan2(1.0 + reach * (0.55 + 0.8 * noise(s * 9, 2.5, seed + 12)), away)
        part = u - column
        splat(light, column, 1 - part, bottom, top, bright)
        splat(light, column + 1, part, bottom, top, bright)


def blurred(light, radius):
    """Box blur along the rows: softens the splats' grain."""
    result = []
    for row in range(HEIGHT):
        line = light[row * WIDTH : (row + 1) * WIDTH]
        for channel in (0, 1):
            sums, total = [], 0.0
            for cell in line:
                total += cell[channel]
                sums.append(total)
            for i in range(WIDTH):
                a, b = max(-1, i - radius - 1), min(WIDTH - 1, i + radius)
                low = sums[a] if a >= 0 else 0.0
                line[i][2 + channel] = (sums[b] - low) / (b - max(a, -1))
        result += line
    return result


def srgb(linear):
    v = clamp(linear)
    return 12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055


def texture():
    """PNG bytes: azimuth to the right, horizon at the bottom; dithered, since it is dark and
    smooth.
    """
    light = [[0.0, 0.0, 0.0, 0.0] for _ in range(WIDTH * HEIGHT)]
    for curtain in CURTAINS:
        draw_curtain(light, curtain)
    light = blurred(light, 1)
    dice = random.Random(2)
    encode = [srgb(i / 4095) * 255 for i in range(4096)]
    pixels = bytearray()
    for row in range(HEIGHT):
        elevation = elevation_of(row / (HEIGHT - 1))
        haze = smoothstep(math.radians(2), math.radians(9), elevation)
        sky = [
            sky_colour(((i * 8) / (WIDTH - 1) - 0.5) * SPAN, elevation)
            for i in range(WIDTH // 8 + 2)
        ]
        for column in range(WIDTH):
            base = mix(sky[column >> 3], sky[(column >> 3) + 1], (column & 7) / 8)
            cell = light[row * WIDTH + column]
            g, v = cell[2] * haze, cell[3] * haze
            colour = (
                base[0] + 0.10 * g + 0.62 * v,
                base[1] + 0.95 * g + 0.16 * v,
                base[2] + 0.50 * g + 0.95 * v,
            )
            grain = dice.random() - 0.5
            for value in colour:
                value = 1 - math.exp(-value * 1.15) if value > 0.4 else value * 0.92
                pixels.append(
                    max(0, min(255, int(encode[min(4095, int(value * 4095))] + grain + 0.5)))
                )
    return gltf.png(WIDTH, HEIGHT, bytes(pixels))


def dome(mirror):
    """The upper half around the view; `mirror`: its image in the water, a little dimmer."""
    columns, rows = 40, 14
    mesh = Mesh()
    points, uvs = [], []
    for j in range(rows + 1):
        v = j / rows
        elevation = elevation_of(v)
        ring, ring_uv = [], []
        for i in range(columns + 1):
            a = (i / columns - 0.5) * SPAN
            y = RADIUS * math.sin(elevation)
            flat = RADIUS * math.cos(elevation)
            ring.append((flat * math.sin(a), WATER_Y + (-y if mirror else y), -flat * math.cos(a)))
            ring_uv.append((0.001 + 0.998 * i / columns, v))
        points.append(ring)
        uvs.append(ring_uv)
    if not mirror:
        points.reverse()
        uvs.reverse()
    tint = (0.80, 0.84, 0.88) if mirror else (1, 1, 1)
    mesh.grid(points, tint, normal=(0, 0, 1), uvs=uvs)
    return mesh


def stars(count=620):
    mesh = Mesh()
    dice = random.Random(7)
    for _ in range(count):
        azimuth = (dice.random() - 0.5) * SPAN * 0.98
        elevation = math.asin(0.10 + 0.88 * dice.random())
        magnitude = dice.random() ** 3.2
        size = RADIUS * math.radians(0.026 + 0.055 * magnitude)
        towards = (
            math.cos(elevation) * math.sin(azimuth),
            math.sin(elevation),
            -math.cos(elevation) * math.cos(azimuth),
        )
        n = mul(towards, -1)
        right = unit(cross(towards, (0, 1, 0)))
        up = cross(right, towards)
        centre = mul(towards, RADIUS * 0.985)
        warm = dice.random()
        glow = 0.22 + 0.78 * magnitude
        colour = mul(mix((0.72, 0.85, 1.0), (1.0, 0.86, 0.68), warm**2), glow)
        corners = (add(mul(right, -0.95), mul(up, -0.6)), add(mul(right, 0.95), mul(up, -0.6)), up)
        mesh.triangle(*(mesh.vertex(add(centre, mul(d, 1.15 * size)), n, colour) for d in corners))
    return mesh
