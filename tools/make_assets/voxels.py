"""A coarse solid model of a room: which 5 cm cells are filled, and how much light gets past them.
"""

import math

from mesh import add, cross, mul, unit

CELL = 0.05


class Voxels:
    def __init__(self, low, high):
        self.low = low
        self.size = [int(math.ceil((h - l) / CELL)) for l, h in zip(low, high)]
        self.cells = bytearray(self.size[0] * self.size[1] * self.size[2])

    def fill(self, low, high):
        spans = []
        for axis in range(3):
            a = int(math.floor((low[axis] - self.low[axis]) / CELL + 0.35))
            b = int(math.ceil((high[axis] - self.low[axis]) / CELL - 0.35))
            spans.append((max(0, a), min(self.size[axis], max(b, a + 1))))
        for x in range(*spans[0]):
            for y in range(*spans[1]):
                row = (x * self.size[1] + y) * self.size[2]
                for z in range(*spans[2]):
                    self.cells[row + z] = 1

    def blocked(self, start, direction, length):
        """Does the ray meet a filled cell? Marches in steps of 0.8 cells."""
        step = CELL * 0.8
        lx, ly, lz = self.low
        sx, sy, sz = self.size
        x, y, z = ((s - l) / CELL for s, l in zip(start, self.low))
        dx, dy, dz = (d * step / CELL for d in direction)
        for _ in range(int(length / step)):
            x += dx
            y += dy
            z += dz
            if not (0 <= x < sx and 0 <= y < sy and 0 <= z < sz):
                return False
            if self.cells[(int(x) * sy + int(y)) * sz + int(z)]:
                return True
        return False

    def openness(self, point, normal, rays, reach):
        """Share of the hemisphere that is free within `reach` metres, cosine-weighted; rays in
        tangent space.
        """
        side = unit(cross(normal, (0.31, 0.87, 0.38)))
        other = cross(normal, side)
        start = add(point, mul(normal, CELL * 1.1))
        free = 0
        for u, v, w in rays:
            direction = add(add(mul(side, u), mul(other, v)), mul(normal, w))
            free += not self.blocked(start, direction, reach)
        return free / len(rays)


def hemisphere(count):
    """Cosine-weighted directions on a spiral (tangent space, w along the normal)."""
    result = []
    for k in range(count):
        r = math.sqrt((k + 0.5) / count)
        a = k * 2.399963
        result.append((r * math.cos(a), r * math.sin(a), math.sqrt(1 - r * r)))
    return result
