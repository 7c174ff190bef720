"""What head and body share: colours, lofts, knitting, smooth tubes."""

import math

from gltf import png
from mesh import Mesh, clamp
from sky import srgb


# Of the yoke and of the body's shoulders, m; the head's origin is 1.75 m above the floor.
BUST_LIFT = 0.045
SKIN = (0.62, 0.37, 0.26)
WOOL = (0.055, 0.105, 0.155)
CREAM = (0.62, 0.57, 0.48)
RED = (0.42, 0.055, 0.045)


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
        result.append(
            0.5
            * (
                2 * p1
                + (p2 - p0) * t
                + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t * t
                + (3 * p1 - p0 - 3 * p2 + p3) * t**3
            )
        )
    return result


def loft(mesh, table, centre_z, colour, sides=48, levels=40, power=1.0):
    """Ellipses by height: (y, half width, half depth, shift of z)."""
    low, high = table[0][0], table[-1][0]
    rows = []
    for j in range(levels + 1):
        y = low + (high - low) * j / levels
        half, deep, shift = between(table, y)
        rows.append(
            [
                (
                    half * math.copysign(abs(math.cos(a)) ** power, math.cos(a)),
                    y,
                    centre_z + shift - deep * math.copysign(abs(math.sin(a)) ** power, math.sin(a)),
                )
                for a in (2 * math.pi * i / sides for i in range(sides))
            ]
        )
    mesh.grid(rows, colour, closed=True)


def knitted(mesh, rows, top, bottom):
    """A grid of closed rings from bottom to top that shows a knitting's rows from `bottom` (v, of
    its texture) to `top`.
    """
    width, height = len(rows[0]), len(rows)
    uvs = [
        [(i / width, bottom + (top - bottom) * j / (height - 1)) for i in range(width + 1)]
        for j in range(height)
    ]
    base = len(mesh.positions)
    mesh.grid([[*row, row[0]] for row in rows], (1, 1, 1), uvs=uvs)
    for j in range(height):  # the seam is where the rings close
        n = Mesh._grid_normal(rows, 0, j, True)
        mesh.normals[base + j * (width + 1)] = mesh.normals[base + j * (width + 1) + width] = n


def knitting(columns, rows, colour, size=4):
    """PNG of stitches, `size` pixels wide and high; colour(column, row from the bottom), linear."""
    pixels = bytearray()
    for j in reversed(range(rows)):
        line = bytearray()
        for i in range(columns):
            line += bytes(int(255 * srgb(v) + 0.5) for v in colour(i, j)) * size
        pixels += line * size
    return png(columns * size, rows * size, bytes(pixels))


def plain(mesh, uv):
    """The mesh with one place of the texture for all that has none."""
    mesh.uvs += [uv] * (len(mesh.positions) - len(mesh.uvs))


def along(profile, count):
    """`count` points evenly along a polyline of (radius, y)."""
    lengths = [math.hypot(b[0] - a[0], b[1] - a[1]) for a, b in zip(profile, profile[1:])]
    result = []
    for k in range(count):
        left = sum(lengths) * k / (count - 1)
        index = 0
        while index < len(lengths) - 1 and left > lengths[index]:
            left -= lengths[index]
            index += 1
        a, b = profile[index], profile[index + 1]
        t = min(1.0, left / lengths[index])
        result.append((a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t))
    return result


def limb(mesh, points, radii, colour, sides=18):
    """A smooth tube through points (Catmull-Rom), closed with round ends by its own radii."""
    fine_points, fine_radii = [], []
    n = len(points)
    for k in range(n - 1):
        p0, p1, p2, p3 = points[max(0, k - 1)], points[k], points[k + 1], points[min(n - 1, k + 2)]
        for j in range(4):
            t = j / 4
            fine_points.append(
                tuple(
                    0.5
                    * (
                        2 * b
                        + (c - a) * t
                        + (2 * a - 5 * b + 4 * c - d) * t * t
                        + (3 * b - a - 3 * c + d) * t**3
                    )
                    for a, b, c, d in zip(p0, p1, p2, p3)
                )
            )
            fine_radii.append(radii[k] + (radii[k + 1] - radii[k]) * t)
    fine_points.append(points[-1])
    fine_radii.append(radii[-1])
    mesh.tube(fine_points, fine_radii, colour, sides)
