"""Triangle meshes built from simple shapes, and the few vector functions that they need.

Vectors are tuples. A mesh carries position, normal and linear colour per vertex; `bake` turns
albedo into light. Triangles are counter-clockwise as seen from outside (glTF's front).
"""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def mul(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def scaled(a, b):
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return (a[0] / length, a[1] / length, a[2] / length) if length > 1e-12 else (0.0, 1.0, 0.0)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def clamp(v, low=0.0, high=1.0):
    return low if v < low else high if v > high else v


def smoothstep(low, high, v):
    t = clamp((v - low) / (high - low))
    return t * t * (3 - 2 * t)


def quaternion(axis, angle):
    """(x, y, z, w) of a turn by `angle` radians about `axis`."""
    a, s = unit(axis), math.sin(angle / 2)
    return (a[0] * s, a[1] * s, a[2] * s, math.cos(angle / 2))


def rotate(q, v):
    u, w = q[:3], q[3]
    t = mul(cross(u, v), 2)
    return add(add(v, mul(t, w)), cross(u, t))


def placed(translation=(0, 0, 0), turn=(0, 0, 0, 1), scale=1.0):
    """A function that carries points, for Mesh.append."""
    return lambda p: add(rotate(turn, mul(p, scale)), translation)


class Mesh:
    def __init__(self):
        self.positions, self.normals, self.colours, self.uvs, self.indices = [], [], [], [], []

    def vertex(self, position, normal, colour=(1, 1, 1), uv=None):
        self.positions.append(position)
        self.normals.append(normal)
        self.colours.append(tuple(colour) if len(colour) == 4 else (*colour, 1))
        if uv is not None:
            self.uvs.append(uv)
        return len(self.positions) - 1

    def triangle(self, a, b, c):
        self.indices += (a, b, c)

    def face(self, corners, colour, split=1):
        """A flat four-cornered face, counter-clockwise, divided into split x split parts."""
        a, b, c, d = corners
        normal = unit(cross(sub(c, a), sub(d, b)))
        if split == 1:
            first = [self.vertex(p, normal, colour) for p in corners]
            self.triangle(first[0], first[1], first[2])
            self.triangle(first[0], first[2], first[3])
            return
        nu, nv = split if isinstance(split, tuple) else (split, split)
        self.grid(
            [
                [mix(mix(a, b, u / nu), mix(d, c, u / nu), v / nv) for u in range(nu + 1)]
                for v in range(nv + 1)
            ],
            colour,
            normal,
        )

    def grid(self, rows, colour, normal=None, closed=False, uvs=None):
        """Rows of points; front is where columns run right and rows run up. Colour: a value or
        f(point, normal).
        """
        height, width = len(rows), len(rows[0])
        base = len(self.positions)
        for j in range(height):
            for i in range(width):
                n = normal or self._grid_normal(rows, i, j, closed)
                c = colour(rows[j][i], n) if callable(colour) else colour
                self.vertex(rows[j][i], n, c, uvs[j][i] if uvs else None)
        for j in range(height - 1):
            for i in range(width if closed else width - 1):
                k = (i + 1) % width
                a, b = base + j * width + i, base + j * width + k
                c, d = base + (j + 1) * width + k, base + (j + 1) * width + i
                if rows[j][i] != rows[j][k]:
                    self.triangle(a, b, c)
                if rows[j + 1][i] != rows[j + 1][k]:
                    self.triangle(a, c, d)

    @staticmethod
    def _grid_normal(rows, i, j, closed):
        width = len(rows[0])
        left, right = (i - 1, (i + 1) % width) if closed else (max(i - 1, 0), min(i + 1, width - 1))
        low, high = max(j - 1, 0), min(j + 1, len(rows) - 1)
        along, up = sub(rows[j][right], rows[j][left]), sub(rows[high][i], rows[low][i])
        if dot(along, along) < 1e-14:  # a pole: take the neighbouring row's direction
            other = low if low != j else high
            along = sub(rows[other][right], rows[other][left])
        return unit(cross(along, up))

    def box(self, low, high, colour, split=1, faces="-x+x-y+y-z+z"):
        (x0, y0, z0), (x1, y1, z1) = low, high
        sides = {
            "-x": ((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)),
            "+x": ((x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)),
            "-y": ((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)),
            "+y": ((x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)),
            "-z": ((x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)),
            "+z": ((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)),
        }
        for name, corners in sides.items():
            if name in faces:
                self.face(corners, colour, split)

    def lathe(self, profile, sides, colour, start=0.0, end=2 * math.pi):
        """Profile of (radius, y) from bottom to top, turned about the y axis."""
        closed = end - start > 6.28
        count = sides if closed else sides + 1
        angles = [start + (end - start) * i / sides for i in range(count)]
        rows = [[(r * math.cos(a), y, -r * math.sin(a)) for a in angles] for r, y in profile]
        self.grid(rows, colour, closed=closed)

    def sphere(self, centre, radii, colour, sides=24, rings=14):
        if not isinstance(radii, tuple):
            radii = (radii, radii, radii)
        base = len(self.positions)
        self.lathe(
            [
                (math.sin(math.pi * i / rings), -math.cos(math.pi * i / rings))
                for i in range(rings + 1)
            ],
            sides,
            colour,
        )
        for i in range(base, len(self.positions)):
            p = self.positions[i]
            self.positions[i] = add(centre, scaled(p, radii))
            self.normals[i] = unit((p[0] / radii[0], p[1] / radii[1], p[2] / radii[2]))

    def tube(self, points, radius, colour, sides=8, cap=True):
        """A round rod along points; radius: a number or one for each point."""
        radii = radius if isinstance(radius, (list, tuple)) else [radius] * len(points)
        along = unit(sub(points[-1], points[0]))
        side = unit(cross(along, (0, 0, 1) if abs(along[2]) < 0.8 else (0, 1, 0)))
        rows = []
        for i, p in enumerate(points):
            along = unit(sub(points[min(i + 1, len(points) - 1)], points[max(i - 1, 0)]))
            side = unit(sub(side, mul(along, dot(side, along))))
            other = cross(along, side)
            rows.append(
                [
                    add(
                        p,
                        add(mul(side, radii[i] * math.cos(a)), mul(other, radii[i] * math.sin(a))),
                    )
                    for a in (2 * math.pi * k / sides for k in range(sides))
                ]
            )
        if cap:
            rows = [[points[0]] * sides] + rows + [[points[-1]] * sides]
        self.grid(rows, colour, closed=True)

    def sweep(self, frames, outline, colour):
        """Flat-sided beam: frames (origin, right, up), a closed counter-clockwise outline of
        (right, up).
        """
        for (u0, v0), (u1, v1) in zip(outline, outline[1:] + outline[:1]):
            rows = [
                [add(o, add(mul(r, u), mul(t, v))) for u, v in ((u0, v0), (u1, v1))]
                for o, r, t in frames
            ]
            self.grid(rows, colour)

    def append(self, other, carry=None, tint=None):
        """Adds another mesh, moved by `carry` (a rigid or uniformly scaled map of points)."""
        base = len(self.positions)
        origin = carry((0, 0, 0)) if carry else None
        for p, n, c in zip(other.positions, other.normals, other.colours):
            self.positions.append(carry(p) if carry else p)
            self.normals.append(unit(sub(carry(n), origin)) if carry else n)
            self.colours.append(
                (c[0] * tint[0], c[1] * tint[1], c[2] * tint[2], c[3]) if tint else c
            )
        self.uvs += other.uvs
        self.indices += [base + i for i in other.indices]
        return self

    def seen_from(self, eyes):
        """Without the triangles that turn their back to all eyes (the corners of a box around every
        eye).
        """
        result, moved = Mesh(), {}
        for i in range(0, len(self.indices), 3):
            corner = self.indices[i : i + 3]
            a, b, c = (self.positions[k] for k in corner)
            normal = cross(sub(b, a), sub(c, a))
            if all(dot(normal, sub(eye, a)) <= 0 for eye in eyes):
                continue
            for k in corner:
                if k not in moved:
                    moved[k] = result.vertex(
                        self.positions[k],
                        self.normals[k],
                        self.colours[k],
                        self.uvs[k] if self.uvs else None,
                    )
                result.indices.append(moved[k])
        return result

    def mirrored(self, height):
        """The reflection in the horizontal plane y = height; colours stay."""
        result = Mesh()
        result.positions = [(x, 2 * height - y, z) for x, y, z in self.positions]
        result.normals = [(x, -y, z) for x, y, z in self.normals]
        result.colours, result.uvs = list(self.colours), list(self.uvs)
        for i in range(0, len(self.indices), 3):
            a, b, c = self.indices[i : i + 3]
            result.indices += (a, c, b)
        return result

    def bake(self, light):
        """colour = light(position, normal, colour) for every vertex; alpha stays."""
        self.colours = [
            (*light(p, n, c[:3]), c[3])
            for p, n, c in zip(self.positions, self.normals, self.colours)
        ]
        return self
