"""A two-storey hall, lit by a lamp far above its skylight: the sun, as it were. Most of it is lit indirectly.

The hall runs along z (24 m); the nave is 8 m wide, with an aisle of 3 m and a gallery above it on either side.
"""

import math

from .gltf import Gltf
from .shapes import Shape, arc, box, frame, lathe, sheet, wall

HALF_LENGTH, NAVE, HALF_WIDTH = 12.0, 4.0, 7.0
GALLERY_UNDER, GALLERY, ROOF = 4.5, 4.8, 9.2
BAY, COLUMN = 4.0, 2.6
SKYLIGHT = (1.3, 4.5)  # half its width (x) and length (z)
COLORS = {"stone": (0.78, 0.73, 0.64), "plaster": (0.8, 0.68, 0.5), "floor": (0.62, 0.57, 0.5), "marble": (0.84, 0.83, 0.81),
          "wood": (0.4, 0.25, 0.13), "terracotta": (0.6, 0.26, 0.15), "leaf": (0.14, 0.36, 0.08), "red": (0.55, 0.07, 0.05),
          "blue": (0.08, 0.14, 0.42)}


class Detail:
    """How finely round things are cut: 1 is the committed scene."""

    def __init__(self, factor):
        self.factor = factor

    def __call__(self, count, least=3):
        return max(least, round(count * self.factor))


def column(n):
    """A column, COLUMN high, of base, swelling shaft and capital, between square slabs."""
    steps, around = n(8), n(28, 6)
    shaft = [(0.27 - 0.05 * (i / (2 * steps)) ** 2, 0.42 + 1.7 * i / (2 * steps)) for i in range(2 * steps + 1)]
    shape = lathe([arc((0.3, 0.25), 0.09, -90, 90, steps), [(0.3, 0.34), (0.29, 0.38), (0.27, 0.42)], shaft,
                   arc((0.22, 2.16), 0.04, -90, 90, n(4)), arc((0.42, 2.2), 0.2, 180, 90, steps)], around)
    return shape, box((-0.4, 0, -0.4), (0.4, 0.16, 0.4)) + box((-0.42, 2.4, -0.42), (0.42, COLUMN, 0.42))


def arch(n, height):
    """A wall across one bay (along z, 0.5 thick) above the capitals, with a round arch of 1.65 m radius."""
    steps, radius, half = n(20, 6), 1.65, BAY / 2
    curve = arc((0, 0), radius, 0, 180, steps)
    front = Shape()
    for (z0, y0), (z1, y1) in zip(curve, curve[1:]):
        front += wall((0.25, y1, z1), (0.25, height, z1), (0.25, height, z0), (0.25, y0, z0))
    for z0, z1 in ((radius, half), (-half, -radius)):
        front += wall((0.25, 0, z1), (0.25, 0, z0), (0.25, height, z0), (0.25, height, z1))
    back = Shape([(-x, y, z) for x, y, z in front.positions], front.triangles).flipped()
    under = Shape()
    for z0, z1 in ((radius, half), (-half, -radius)):
        under += wall((-0.25, 0, z0), (0.25, 0, z0), (0.25, 0, z1), (-0.25, 0, z1))

    def soffit(s, t):
        angle = math.pi * t
        return (0.25 - 0.5 * s, radius * math.sin(angle), radius * math.cos(angle))

    return front + back + under, sheet(soffit, 1, steps)


def baluster(n):
    outline = [(0.05, 0.0), (0.05, 0.06), (0.035, 0.1)]
    belly = [(0.03 + 0.035 * math.sin(math.pi * (i / n(8)) ** 0.7) ** 2, 0.1 + 0.55 * i / n(8)) for i in range(n(8) + 1)]
    return lathe([outline, belly, [(0.03, 0.65), (0.05, 0.7), (0.05, 0.78)]], n(10, 4))


def vase(n):
    steps = n(14, 4)
    outside = [(0.16 + 0.2 * math.sin(math.pi * (0.12 + 0.8 * i / steps)) ** 1.5 + 0.02 * i / steps, 0.75 * i / steps)
               for i in range(steps + 1)]
    inside = [(r - 0.03, y) for r, y in reversed(outside[2:])]
    return lathe([[(0.0, 0.0), outside[0]], outside, [outside[-1], inside[0]], inside + [(0.0, inside[-1][1])]], n(24, 6))


def plant(n):
    """Blades that rise and bend over."""
    leaves = Shape()
    for k in range(14):
        turn, reach, height = 2.4 * k, 0.35 + 0.05 * (k % 5), 0.5 + 0.09 * (k % 4)

        def point(s, t):
            out = 0.04 + reach * t * t
            side = 0.06 * (s - 0.5) * math.sin(math.pi * (0.08 + 0.9 * t))
            rise = height * math.sin(0.5 * math.pi * min(1.0, 1.35 * t)) - 0.25 * t ** 3
            return (out * math.cos(turn) - side * math.sin(turn), rise, out * math.sin(turn) + side * math.cos(turn))

        leaves += sheet(point, n(2, 1), n(8, 2))
    return leaves


def banner(n):
    """Cloth in folds, 1.2 m by 2.4 m, hung at its top."""
    def point(s, t):
        depth = 0.03 + 0.1 * t
        return (depth * math.sin(9 * s + 1.5 * t), -2.4 * t - 0.12 * math.sin(math.pi * s), 1.2 * (0.5 - s))

    return sheet(point, n(14, 4), n(18, 4))


def torus_knot(n):
    """The knot of three turns about the ring and two through it."""
    def center(t):
        a = 2 * math.pi * t
        r = 0.55 + 0.2 * math.cos(3 * a)
        return (r * math.cos(2 * a), 0.85 + 0.3 * math.sin(3 * a), r * math.sin(2 * a))

    def point(s, t):
        p, q = center(t), center(t + 1e-4)
        d = [b - a for a, b in zip(p, q)]
        length = math.sqrt(sum(x * x for x in d))
        d = [x / length for x in d]
        out = (p[0], 0.0, p[2])
        dot = sum(a * b for a, b in zip(out, d))
        u = [a - dot * b for a, b in zip(out, d)]
        length = math.sqrt(sum(x * x for x in u))
        u = [x / length for x in u]
        v = (d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2], d[0] * u[1] - d[1] * u[0])
        c, s_ = 0.1 * math.cos(2 * math.pi * s), 0.1 * math.sin(2 * math.pi * s)
        return tuple(p[i] + c * u[i] + s_ * v[i] for i in range(3))

    return sheet(point, n(16, 4), n(120, 24), wrap=(True, True))


def crate():
    shape = box((-0.37, 0.03, -0.37), (0.37, 0.77, 0.37))
    for side in (-0.4, 0.3):
        for low in (0.0, 0.7):
            shape += box((-0.4, low, side), (0.4, low + 0.1, side + 0.1))
            shape += box((side, low, -0.3), (side + 0.1, low + 0.1, 0.3))
        for other in (-0.4, 0.3):
            shape += box((side, 0.1, other), (side + 0.1, 0.7, other + 0.1))
    return shape


def bench():
    shape = box((-0.25, 0.4, -0.9), (0.25, 0.47, 0.9))
    for z in (-0.75, 0.65):
        shape += box((-0.2, 0, z), (0.2, 0.4, z + 0.1))
    return shape


def shell(g, material):
    """Floor, walls, galleries, beams and a roof that is open at the skylight, with a low kerb around it."""
    x, z, (sx, sz) = HALF_WIDTH, HALF_LENGTH, SKYLIGHT
    g.add("floor", wall((-x, 0, z), (x, 0, z), (x, 0, -z), (-x, 0, -z)), material["floor"])
    g.add("walls", box((-x, 0, -z), (x, ROOF, z), inward=True, without=("-y", "+y")), material["plaster"])
    opening = [(-sx, ROOF, -sz), (sx, ROOF, -sz), (sx, ROOF, sz), (-sx, ROOF, sz)]
    g.add("roof", frame([(-x, ROOF, -z), (x, ROOF, -z), (x, ROOF, z), (-x, ROOF, z)], opening), material["plaster"])
    g.add("kerb", box((-sx, ROOF, -sz), (sx, ROOF + 0.6, sz), inward=True, without=("-y", "+y")), material["plaster"])
    slab = g.mesh("gallery", (box((NAVE - 0.45, GALLERY_UNDER, -z), (x, GALLERY, z), without=("+x", "-z", "+z")), material["stone"]))
    g.node(slab)
    g.node(slab, turn=180)
    beam = g.mesh("aisle beam", (box((NAVE + 0.25, 4.2, -0.15), (x, GALLERY_UNDER, 0.15), without=("+x", "+y")), material["wood"]))
    rafter = g.mesh("rafter", (box((-x, 8.8, -0.12), (x, ROOF, 0.12), without=("-x", "+x", "+y")), material["wood"]))
    for k in range(-2, 3):
        g.node(beam, at=(0, 0, BAY * k))
        g.node(beam, at=(0, 0, BAY * k), turn=180)
        if abs(k) == 2:
            g.node(rafter, at=(0, 0, BAY * k))
    door = g.mesh("niche", (box((-0.8, 0, 0), (0.8, 2.4, 0.06), without=("-y", "-z")), material["wood"]))
    g.node(door, at=(0, 0, -z))
    g.node(door, at=(0, 0, z), turn=180)


def arcades(g, n, material):
    round_part, slabs = column(n)
    pillar = g.mesh("column", (round_part, material["marble"]), (slabs, material["stone"]))
    walls, soffit = arch(n, GALLERY_UNDER - COLUMN)
    lower = g.mesh("arch", (walls, material["stone"]), (soffit, material["stone"]))
    upper_column = (ROOF - GALLERY - (GALLERY_UNDER - COLUMN)) / COLUMN
    rail = box((-0.12, 0, -1.7), (0.12, 0.08, 1.7)) + box((-0.1, 0.86, -1.7), (0.1, 0.95, 1.7))
    rails = g.mesh("rail", (rail, material["stone"]))
    post = g.mesh("baluster", (baluster(n), material["marble"]))
    for side in (-1, 1):
        x = side * NAVE
        for k in range(-2, 3):
            g.node(pillar, at=(x, 0, BAY * k))
            g.node(pillar, at=(x, GALLERY, BAY * k), scale=(0.9, upper_column, 0.9))
        for k in range(6):
            z = BAY * (k - 2.5)
            g.node(lower, at=(x, COLUMN, z))
            g.node(lower, at=(x, ROOF - (GALLERY_UNDER - COLUMN), z))
            g.node(rails, at=(x, GALLERY, z))
            for i in range(-4, 5):
                g.node(post, at=(x, GALLERY + 0.08, z + 0.36 * i))


def clutter(g, n, material):
    jar, leaves = g.mesh("vase", (vase(n), material["terracotta"])), g.mesh("plant", (plant(n), material["leaf"]))
    for k, (x, z) in enumerate(((-6.3, -10), (-6.3, 2), (6.3, -6), (6.3, 6), (-3.2, -8), (3.2, 8), (-3.2, 4), (3.2, -4), (6.3, 11), (-6.3, 11))):
        size = 0.9 + 0.15 * (k % 3)
        g.node(jar, at=(x, 0, z), turn=37 * k, scale=(size, size, size))
        if k % 3 < 2:
            g.node(leaves, at=(x, 0.55 * size, z), turn=61 * k, scale=(size, size, size))
    seat = g.mesh("bench", (bench(), material["wood"]))
    for x, z, turn in ((-2.6, -2, 0), (2.6, 2, 0), (-6.2, -4, 0), (6.2, 0, 0), (0, 9, 90), (-6.2, 7, 4)):
        g.node(seat, at=(x, 0, z), turn=turn)
    chest = g.mesh("crate", (crate(), material["wood"]))
    for x, y, z, turn in ((5.6, 0, -10.8, 8), (6.4, 0, -9.9, -20), (5.9, 0.8, -10.5, 25), (5.2, 0, -9.7, 40), (-5.3, 0, 10.4, 12),
                          (-5.4, 0.8, 10.3, -9), (-6.2, GALLERY, -9, 15), (6.1, GALLERY, 3, -30), (6.3, GALLERY, 4, 10)):
        g.node(chest, at=(x, y, z), turn=turn)
    for name, color, at in (("banner", "red", ((-3.4, -4), (3.4, 4), (3.4, -8))), ("blue banner", "blue", ((-3.4, 0), (3.4, -4), (-3.4, 8)))):
        cloth = g.mesh(name, (banner(n), material[color]))
        for x, z in at:
            g.node(cloth, at=(x, 4.7, z), turn=0 if x < 0 else 180)
    g.add("carpet", box((-1, 0, -7.5), (1, 0.015, 7.5), without=("-y",)), material["red"])
    stand = g.mesh("pedestal", (box((-0.5, 0, -0.5), (0.5, 0.9, 0.5), without=("-y",)), material["marble"]))
    g.node(stand, at=(0, 0.015, -1))
    g.add("knot", torus_knot(n), material["marble"], at=(0, 0.75, -1))
    ball = g.mesh("ball", (lathe([arc((0, 0.35), 0.35, -90, 90, n(16, 4))], n(32, 6)), material["marble"]))
    for x, z in ((-5.5, -8), (6.2, 2.5)):
        g.node(stand, at=(x, 0, z))
        g.node(ball, at=(x, 0.9, z))


def build(factor):
    g, n = Gltf(), Detail(factor)
    material = {name: g.material(name, color, doubleSided=name in ("leaf", "red", "blue")) for name, color in COLORS.items()}
    shell(g, material)
    arcades(g, n, material)
    clutter(g, n, material)
    # 1.6 m square, 14 m above the roof, turned down: through the skylight it lights one side of the nave.
    g.add("sun", wall((-6.8, 23, 2.2), (-5.2, 23, 2.2), (-5.2, 23, 3.8), (-6.8, 23, 3.8)), g.lamp("sun", (3000.0, 2700.0, 2200.0)))
    g.camera("nave", (0.9, 1.7, 10.8), (-0.3, 3.0, -4), 60, 4 / 3)
    g.camera("gallery", (-6.0, 6.5, 7.6), (3.5, 3.0, 0.4), 60, 4 / 3)
    g.camera("aisle", (5.8, 1.6, 9.2), (4.6, 1.5, -6), 60, 4 / 3)
    return g


def atrium(triangles):
    """About `triangles` of them: their number grows nearly as the square of the detail."""
    factor = 1.0
    for _ in range(4):
        factor *= math.sqrt(triangles / build(factor).triangles)
    return build(factor)
