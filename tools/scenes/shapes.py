"""Triangle shapes. Fronts are counter-clockwise. Flat shapes have no normals; round ones have smooth normals."""

import math
from dataclasses import dataclass, field


@dataclass
class Shape:
    positions: list = field(default_factory=list)
    triangles: list = field(default_factory=list)
    normals: list = field(default_factory=list)
    uvs: list = field(default_factory=list)
    colors: list = field(default_factory=list)

    def __add__(self, other):
        shift = len(self.positions)
        moved = [tuple(i + shift for i in t) for t in other.triangles]
        return Shape(self.positions + other.positions, self.triangles + moved, self.normals + other.normals,
                     self.uvs + other.uvs, self.colors + other.colors)

    def flipped(self):
        return Shape(self.positions, [(a, c, b) for a, b, c in self.triangles],
                     [tuple(-x for x in n) for n in self.normals], self.uvs, self.colors)

    def moved(self, by):
        return Shape([tuple(x + d for x, d in zip(p, by)) for p in self.positions], self.triangles, self.normals,
                     self.uvs, self.colors)


def subtract(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def smooth(shape):
    """Gives each vertex the mean normal of its triangles, weighted by area."""
    sums = [(0.0, 0.0, 0.0)] * len(shape.positions)
    for t in shape.triangles:
        a, b, c = (shape.positions[i] for i in t)
        n = cross(subtract(b, a), subtract(c, a))
        for i in t:
            sums[i] = tuple(x + y for x, y in zip(sums[i], n))
    return Shape(shape.positions, shape.triangles, [unit(n) for n in sums], shape.uvs, shape.colors)


def quad(a, b, c, d):
    """A flat quadrilateral, a to d counter-clockwise seen from its front; texture coordinates from a (0, 1) to c (1, 0)."""
    return Shape([a, b, c, d], [(0, 1, 2), (0, 2, 3)], uvs=[(0, 1), (1, 1), (1, 0), (0, 0)])


def plain(shape):
    """Without texture coordinates."""
    return Shape(shape.positions, shape.triangles, shape.normals)


def wall(a, b, c, d):
    return plain(quad(a, b, c, d))


def frame(outer, inner):
    """A flat polygon with a hole: the corners of both rings in the same order, counter-clockwise from the front."""
    n = len(outer)
    triangles = []
    for i in range(n):
        j = (i + 1) % n
        triangles += [(i, j, n + j), (i, n + j, n + i)]
    return Shape(list(outer) + list(inner), triangles)


def box(lower, upper, inward=False, without=()):
    """A box facing outwards or `inward`, but for the sides named in `without` ("-x", "+y", ...)."""
    (x0, y0, z0), (x1, y1, z1) = lower, upper
    corners = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
    sides = {"-x": (0, 1, 3, 2), "+x": (4, 6, 7, 5), "-y": (0, 4, 5, 1), "+y": (2, 3, 7, 6), "-z": (0, 2, 6, 4), "+z": (1, 5, 7, 3)}
    triangles = []
    for name, (a, b, c, d) in sides.items():
        if name not in without:
            triangles += [(a, b, c), (a, c, d)]
    shape = Shape(corners, triangles)
    return shape.flipped() if inward else shape


def lathe(pieces, around):
    """Turns polylines of (radius, height) about the y axis; each polyline is smooth, between two there is an edge.

    The front is on the right of the way along a polyline, seen with the radius to the right: outside on the way up.
    """
    whole = Shape()
    for piece in pieces:
        positions, rings = [], []
        for radius, height in piece:
            count = around if radius > 0 else 1
            rings.append([len(positions) + i for i in range(count)])
            for i in range(count):
                angle = 2 * math.pi * i / around
                positions.append((radius * math.cos(angle), height, radius * math.sin(angle)))
        triangles = []
        for low, high in zip(rings, rings[1:]):
            for i in range(around):
                a, b = low[i % len(low)], low[(i + 1) % len(low)]
                d, c = high[i % len(high)], high[(i + 1) % len(high)]
                triangles += [t for t in ((a, d, c), (a, c, b)) if len(set(t)) == 3]
        whole += smooth(Shape(positions, triangles))
    return whole


def arc(center, radius, start, end, steps):
    """Points (radius, height) of a circle's arc, angles in degrees, counter-clockwise from the radius axis."""
    angles = [math.radians(start + (end - start) * i / steps) for i in range(steps + 1)]
    points = [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a)) for a in angles]
    return [(0.0 if abs(r) < 1e-9 else r, h) for r, h in points]


def sphere(radius, around):
    """About the origin, with exact normals; texture coordinates are not given."""
    shape = lathe([arc((0, 0), radius, -90, 90, around // 2)], around)
    shape.normals = [unit(p) for p in shape.positions]
    return shape


def icosphere(radius, subdivisions):
    """20 * 4^subdivisions nearly equal triangles, exact normals, a vertex at either pole."""
    height, ring = 1 / math.sqrt(5), 2 / math.sqrt(5)
    points = [(0, -1, 0)]
    for k in range(10):
        points.append((ring * math.cos(math.pi * k / 5), height if k % 2 else -height, ring * math.sin(math.pi * k / 5)))
    points.append((0, 1, 0))
    low, high = [1, 3, 5, 7, 9], [2, 4, 6, 8, 10]
    triangles = []
    for k in range(5):
        n = (k + 1) % 5
        triangles += [(0, low[k], low[n]), (low[k], high[k], low[n]), (low[n], high[k], high[n]), (11, high[n], high[k])]
    for _ in range(subdivisions):
        middle = {}

        def between(i, j):
            key = (min(i, j), max(i, j))
            if key not in middle:
                middle[key] = len(points)
                points.append(unit(tuple(x + y for x, y in zip(points[i], points[j]))))
            return middle[key]

        finer = []
        for a, b, c in triangles:
            ab, bc, ca = between(a, b), between(b, c), between(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    return Shape([tuple(radius * x for x in p) for p in points], triangles, [unit(p) for p in points])


def sheet(point, across, along, wrap=(False, False)):
    """The surface point(s, t), s and t in [0, 1], as a smooth grid; `wrap` closes it in s or t."""
    columns, rows = across + (not wrap[0]), along + (not wrap[1])
    positions = [point(i / across, j / along) for j in range(rows) for i in range(columns)]
    triangles = []
    for j in range(along):
        for i in range(across):
            a, b = j * columns + i, j * columns + (i + 1) % columns
            d, c = (j + 1) % rows * columns + i, (j + 1) % rows * columns + (i + 1) % columns
            triangles += [(a, b, c), (a, c, d)]
    return smooth(Shape(positions, triangles))
