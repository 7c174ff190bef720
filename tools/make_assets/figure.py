"""What head and body share: colours, lofts, knitting, smooth tubes."""

import math

from mesh import Mesh, clamp


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


def stitches(mesh, rows, colour):
    """A grid of closed rings whose faces each have one colour: colour(column, row)."""
    width = len(rows[0])
    for j in range(len(rows) - 1):
        for i in range(width):
            k = (i + 1) % width
            corners = [(j, i), (j, k), (j + 1, k), (j + 1, i)]
            tone = colour(i, j)
            first = [
                mesh.vertex(rows[r][c], Mesh._grid_normal(rows, c, r, True), tone)
                for r, c in corners
            ]
            mesh.triangle(first[0], first[1], first[2])
            mesh.triangle(first[0], first[2], first[3])


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


def limb(mesh, points, radii, colour, sides=22):
    """A smooth tube through points (Catmull-Rom), closed with round ends by its own radii."""
    fine_points, fine_radii = [], []
    n = len(points)
    for k in range(n - 1):
        p0, p1, p2, p3 = points[max(0, k - 1)], points[k], points[k + 1], points[min(n - 1, k + 2)]
        for j in range(6):
            t = j / 6
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
