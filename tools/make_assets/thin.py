"""Takes away the triangles that no eye would miss: edge collapse by quadric error (Garland and
Heckbert 1998) over position and colour together, weighed as the viewer sees it.

A vertex only ever moves onto a neighbour, so what stays keeps its exact place, normal and colour.
Faces of different colour that meet at an edge stay joined: their vertices move together or not at
all.
"""

import heapq
import math
from operator import add as plus
from operator import mul as times

from mesh import Mesh, add, cross, dot, mul, sub, unit

BORDER = 3.0  # weight of open edges, which are often silhouettes
PATCH = 1e-3  # steradians: `tolerance` is meant for a patch of this size
SLIGHT = 4.0  # what is smaller than the patch may deviate by the root of this times `tolerance`
STEEPEST = 0.25  # least cosine between a face's old and new normal


def seen_colour(n, c):
    """What the eye tells apart: about the screen's levels, 0 to 1, and opacity."""
    return (*(math.sqrt(max(0.0, min(1.0, v))) for v in c[:3]), c[3])


def thinned(mesh, tolerance, apparent, look=seen_colour, look_weight=0.05):
    """The mesh without what changes a patch of the picture by less than about `tolerance` radians.

    apparent(point): radians per metre there; look(normal, colour): the rest of the appearance,
    whose unit counts as `look_weight` radians.
    """
    return _Thinning(mesh, apparent, look, look_weight).run(tolerance**2)


class _Thinning:
    """Vertices are welded by position; a wedge is one appearance of a vertex."""

    def __init__(self, mesh, apparent, look, look_weight):
        self.mesh = mesh
        self.vertex_of, self.place, self.wedge_of = [], [], []
        vertices, wedges, self.rows, self.products = {}, {}, [], []
        for k, (p, n, c) in enumerate(zip(mesh.positions, mesh.normals, mesh.colours)):
            key = tuple(round(v, 5) for v in p)
            v = vertices.setdefault(key, len(vertices))
            if v == len(self.place):
                self.place.append(p)
            seen = tuple(look_weight * x for x in look(n, c))
            w = wedges.setdefault((v, *(round(x, 5) for x in seen)), k)
            self.vertex_of.append(v)
            self.wedge_of.append(w)
            row = (*p, *seen, 1.0)
            self.rows.append(row)
            self.products.append(
                [row[i] * row[j] for i in range(len(row)) for j in range(i, len(row))] + [0.0]
            )
        self._connect()
        self._measure(apparent)

    def _connect(self):
        indices = self.mesh.indices
        self.faces, self.around = [], [set() for _ in self.place]
        for i in range(0, len(indices), 3):
            corner = tuple(self.wedge_of[k] for k in indices[i : i + 3])
            ends = {self.vertex_of[w] for w in corner}
            if len(ends) < 3:
                continue
            for v in ends:
                self.around[v].add(len(self.faces))
            self.faces.append(corner)

    def _measure(self, apparent):
        """A quadric for each wedge: apparent area times squared deviation, and open edges; its
        last number is that area.
        """
        zero = [0.0] * len(self.products[0])
        self.quadric = {w: zero for face in self.faces for w in face}
        for f, face in enumerate(self.faces):
            a, b, c = (self.place[self.vertex_of[w]] for w in face)
            scale = apparent(mul(add(add(a, b), c), 1 / 3))
            area = math.sqrt(dot(*[cross(sub(b, a), sub(c, a))] * 2)) * 0.5 * scale * scale
            if area <= 0:
                continue
            rows = [(*(v * scale for v in self.rows[w][:3]), *self.rows[w][3:-1]) for w in face]
            plane = _flat_quadric(rows, area / 3, scale) + [area / 3]
            for w in face:
                self.quadric[w] = list(map(plus, self.quadric[w], plane))
            for k in range(3):
                u, w = face[k], face[(k + 1) % 3]
                if len(self.around[self.vertex_of[u]] & self.around[self.vertex_of[w]]) > 1:
                    continue
                fence = self._fence(u, w, f, scale)
                for end in (u, w):
                    self.quadric[end] = list(map(plus, self.quadric[end], fence))

    def _fence(self, u, w, face, scale):
        """Keeps an open edge on its line: the plane through it, upright on the face."""
        p, q = self.place[self.vertex_of[u]], self.place[self.vertex_of[w]]
        a, b, c = (self.place[self.vertex_of[k]] for k in self.faces[face])
        edge = sub(q, p)
        normal = unit(cross(edge, cross(sub(b, a), sub(c, a))))
        row = [*normal] + [0.0] * (len(self.rows[u]) - 4) + [-dot(normal, p)]
        weight = BORDER * dot(edge, edge) * scale**4 / 3
        return _packed([[x * y * weight for y in row] for x in row]) + [0.0]

    def run(self, limit):
        self.version = [0] * len(self.place)
        self.heap = []
        for v in range(len(self.place)):
            self._offer(v)
        while self.heap:
            cost, u, v, seen_u, seen_v = heapq.heappop(self.heap)
            if cost > limit * PATCH:
                break
            if (seen_u, seen_v) == (self.version[u], self.version[v]) and self._allowed(u, v):
                self._collapse(u, v)
        return self._result()

    def _neighbours(self, v):
        return {self.vertex_of[w] for f in self.around[v] for w in self.faces[f]} - {v}

    def _offer(self, u, both=False):
        for v in sorted(self._neighbours(u)):
            for a, b in ((u, v), (v, u)) if both else ((u, v),):
                cost = self._cost(a, b)
                if cost is not None:
                    heapq.heappush(self.heap, (cost, a, b, self.version[a], self.version[b]))

    def _moves(self, u, v):
        """Which wedge of v each wedge of u becomes; None where one has no counterpart."""
        found = {}
        for f in self.around[u] & self.around[v]:
            pair = {self.vertex_of[w]: w for w in self.faces[f]}
            if found.setdefault(pair[u], pair[v]) != pair[v]:
                return None
        for f in self.around[u]:
            for w in self.faces[f]:
                if self.vertex_of[w] == u and w not in found:
                    return None
        return found

    def _cost(self, u, v):
        moves = self._moves(u, v)
        if moves is None:
            return None
        total = area = 0.0
        for w, into in moves.items():
            together = list(map(plus, self.quadric[w], self.quadric[into]))
            total += sum(map(times, together, self.products[into]))
            area += together[-1]
        return total * max(1.0, PATCH / (SLIGHT * area + 1e-12))

    def _allowed(self, u, v):
        shared = self.around[u] & self.around[v]
        if not shared or len(shared) > 2:
            return False
        opposite = {self.vertex_of[w] for f in shared for w in self.faces[f]} - {u, v}
        if self._neighbours(u) & self._neighbours(v) != opposite:
            return False
        for f in self.around[u] - shared:
            old = [self.place[self.vertex_of[w]] for w in self.faces[f]]
            new = [
                self.place[v if self.vertex_of[w] == u else self.vertex_of[w]]
                for w in self.faces[f]
            ]
            before = cross(sub(old[1], old[0]), sub(old[2], old[0]))
            after = cross(sub(new[1], new[0]), sub(new[2], new[0]))
            size = math.sqrt(dot(before, before) * dot(after, after))
            if size <= 0 or dot(before, after) < STEEPEST * size:
                return False
        return True

    def _collapse(self, u, v):
        moves = self._moves(u, v)
        for w, into in moves.items():
            self.quadric[into] = list(map(plus, self.quadric[w], self.quadric[into]))
        for f in self.around[u] & self.around[v]:
            for w in self.faces[f]:
                self.around[self.vertex_of[w]].discard(f)
            self.faces[f] = None
        for f in self.around[u]:
            self.faces[f] = tuple(moves.get(w, w) for w in self.faces[f])
            self.around[v].add(f)
        self.around[u] = set()
        self.version[u] += 1
        self.version[v] += 1
        self._offer(v, True)

    def _result(self):
        result, moved, source = Mesh(), {}, self.mesh
        for face in self.faces:
            for w in face or ():
                if w not in moved:
                    moved[w] = result.vertex(
                        source.positions[w],
                        source.normals[w],
                        source.colours[w],
                        source.uvs[w] if source.uvs else None,
                    )
                result.indices.append(moved[w])
        return result


def _flat_quadric(rows, weight, scale):
    """Squared distance from the plane of three points in the space of place and look."""
    origin, size = rows[0], len(rows[0])
    first = [x - y for x, y in zip(rows[1], origin)]
    second = [x - y for x, y in zip(rows[2], origin)]
    length = math.sqrt(sum(x * x for x in first)) or 1.0
    e = [x / length for x in first]
    along = sum(map(times, e, second))
    second = [x - along * y for x, y in zip(second, e)]
    length = math.sqrt(sum(x * x for x in second)) or 1.0
    g = [x / length for x in second]
    inner = [[(i == j) - e[i] * e[j] - g[i] * g[j] for j in range(size)] for i in range(size)]
    shift = [-sum(map(times, row, origin)) for row in inner]
    rest = -sum(map(times, shift, origin))
    units = [scale] * 3 + [1.0] * (size - 3)
    whole = [
        [weight * v * units[i] * units[j] for j, v in enumerate(inner[i])]
        + [weight * shift[i] * units[i]]
        for i in range(size)
    ]
    return _packed(whole + [[0.0] * size + [weight * rest]])


def _packed(matrix):
    """The upper half of a symmetric matrix; what is off the diagonal counts twice."""
    return [
        matrix[i][j] * (1 if i == j else 2)
        for i in range(len(matrix))
        for j in range(i, len(matrix))
    ]
