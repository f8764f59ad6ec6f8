"""Small scenes, each hard on caches in one way."""

import math

from .gltf import Gltf
from .pictures import exr
from .shapes import Shape, box, cross, icosphere, subtract, unit, wall

WHITE, GREY, BLACK = (0.75, 0.75, 0.75), (0.5, 0.5, 0.5), (0.0, 0.0, 0.0)
WARM, COOL = (0.7, 0.45, 0.3), (0.3, 0.45, 0.7)


def room(lower, upper, without=()):
    return box(lower, upper, inward=True, without=without)


def panel(x0, x1, z0, z1, y, up=False):
    """A horizontal rectangle facing down, or `up`."""
    shape = wall((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))
    return shape.flipped() if up else shape


def contact_shadow():
    """The room of docs/theory.md (its z is up, here y) with the tilted rectangle 0.25 above the floor."""
    g = Gltf()

    def at(x, y, z):
        return (x, z, -y)

    floor, ceiling = g.material("floor", GREY), g.material("ceiling", (0.8, 0.8, 0.8))
    g.add("floor", wall(at(0, 0, 0), at(4, 0, 0), at(4, 3, 0), at(0, 3, 0)), floor)
    g.add("ceiling", wall(at(0, 3, 2.5), at(4, 3, 2.5), at(4, 0, 2.5), at(0, 0, 2.5)), ceiling)
    # Reflectances in the ratio of the emissions there, so that each wall is as bright beside the ceiling as it is there.
    for name, reflectance, a, b in (("x = 0", 0.25, (0, 3), (0, 0)), ("x = 4", 0.075, (4, 0), (4, 3)),
                                    ("y = 0", 0.15, (0, 0), (4, 0)), ("y = 3", 0.0375, (4, 3), (0, 3))):
        shape = wall(at(*b, 0), at(*a, 0), at(*a, 2.5), at(*b, 2.5))
        g.add("wall " + name, shape, g.material("wall " + name, (reflectance,) * 3))
    # A cove: strips along the walls that shine upwards, so that the ceiling lights the room.
    strips = Shape()
    for x0, x1, y0, y1 in ((0.05, 0.1, 0.1, 2.9), (3.9, 3.95, 0.1, 2.9), (0.1, 3.9, 0.05, 0.1), (0.1, 3.9, 2.9, 2.95)):
        strips += wall(at(x0, y0, 2.2), at(x1, y0, 2.2), at(x1, y1, 2.2), at(x0, y1, 2.2))
    g.add("cove", strips, g.lamp("cove", (30.0, 30.0, 30.0)))
    u = unit((1, 0, 0.15))
    along = unit((-0.05, 1, 0.1))
    v = unit(subtract(along, tuple(x * sum(a * b for a, b in zip(along, u)) for x in u)))
    o = (1.4, 1.0, 0.25)
    corners = [at(*(o[i] + s * u[i] + 0.9 * t * v[i] for i in range(3))) for s, t in ((0, 0), (1, 0), (1, 1), (0, 1))]
    g.add("rectangle", wall(*corners), g.material("rectangle", (0.04, 0.04, 0.04), doubleSided=True))
    g.camera("corner", at(0.2, 0.2, 1.7), at(2.1, 1.6, 0), 55, 4 / 3)
    g.camera("low", at(0.6, 0.5, 0.5), at(1.9, 1.4, 0.1), 45, 4 / 3)
    return g


def closed_box():
    """A lit room; beside it a closet that shares a wall without thickness; in it a closed crate without thickness."""
    g = Gltf()
    white, warm = g.material("white", WHITE), g.material("warm", WARM)
    g.add("room", room((0, 0, 0), (4, 2.5, 4)), white)
    g.add("closet", room((4, 0, 0), (6, 2.5, 4), without=("-x",)), white)
    g.add("crate", box((2.2, 0.05, 1), (3.4, 1.25, 2.2)), warm)
    g.add("lamp", panel(1.5, 2.5, 1.5, 2.5, 2.49), g.lamp("lamp", (12.0, 12.0, 12.0)))
    g.camera("room", (0.3, 1.5, 3.7), (2.6, 0.8, 1.4), 60, 4 / 3)
    g.camera("closet", (5.7, 1.5, 3.7), (4.4, 0.9, 1.0), 60, 4 / 3)
    g.camera("crate", (3.2, 1.0, 2.0), (2.5, 0.4, 1.3), 70, 4 / 3)
    return g


def thin_wall():
    """Two closed rooms, 2 cm apart; the lamp of the one is twenty times that of the other."""
    g = Gltf()
    white = g.material("white", WHITE)
    g.add("bright room", room((0, 0, 0), (3, 2.5, 3)), white)
    g.add("dark room", room((3.02, 0, 0), (6.02, 2.5, 3)), white)
    # Both shine upwards: the rooms are lit by their ceilings.
    g.add("bright lamp", panel(1, 2, 1, 2, 2.2, up=True), g.lamp("bright lamp", (10.0, 10.0, 10.0)))
    g.add("dim lamp", panel(4.02, 5.02, 1, 2, 2.2, up=True), g.lamp("dim lamp", (0.5, 0.5, 0.5)))
    g.camera("bright", (0.4, 1.4, 2.8), (2.9, 0.9, 0.8), 60, 4 / 3)
    g.camera("dark", (5.62, 1.4, 2.8), (3.12, 0.9, 0.8), 60, 4 / 3)
    return g


def plate():
    """A large plate 0.1 m above the ground, under an open sky (plate.toml, plate-sun.toml)."""
    g = Gltf()
    g.add("ground", panel(-20, 20, -20, 20, 0, up=True), g.material("ground", GREY))
    g.add("plate", box((-2, 0.1, -2), (2, 0.13, 2)), g.material("plate", WARM))
    g.camera("above", (4.5, 1.6, 4.5), (0, 0, 0), 45, 4 / 3)
    g.camera("under", (1.2, 0.06, 0.9), (-0.6, 0.02, -0.4), 60, 4 / 3)
    return g


def sky(sun):
    """Blue overhead, bright at the horizon and towards +X; dark earth below; with a `sun`, four texels of 2.8 degrees."""
    width, height = 128, 64

    def pixel(x, y):
        elevation = math.pi * (0.5 - (y + 0.5) / height)
        # The middle column looks to -Z, the one three quarters across to +X.
        towards_x = math.sin(2 * math.pi * ((x + 0.5) / width - 0.5)) * math.cos(elevation)
        if sun and x in (88, 89) and y in (18, 19):
            return (900.0, 800.0, 650.0)
        if elevation < 0:
            return (0.06, 0.05, 0.04)
        haze = (1 - math.sin(elevation)) ** 2
        glow = 1 + 0.5 * towards_x
        return tuple(glow * (zenith + haze * (horizon - zenith))
                     for zenith, horizon in zip((0.25, 0.45, 0.95), (1.0, 1.0, 0.95)))

    return exr(width, height, pixel)


def corner():
    """Three planes that meet, lit only by what a board returns of a lamp turned away from them."""
    g = Gltf()
    g.add("floor", panel(0, 3, 0, 3, 0, up=True), g.material("floor", WHITE))
    g.add("x wall", wall((0, 0, 3), (0, 0, 0), (0, 3, 0), (0, 3, 3)), g.material("x wall", WARM))
    g.add("z wall", wall((0, 0, 0), (3, 0, 0), (3, 3, 0), (0, 3, 0)), g.material("z wall", COOL))
    middle, side = unit((1, 1, 1)), unit((1, 0, -1))
    up = cross(middle, side)

    def square(distance, half):
        """About the corner's diagonal, facing away from the corner."""
        points = [tuple(distance * m + half * (s * a + t * b) for m, a, b in zip(middle, side, up))
                  for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        return wall(*points)

    g.add("lamp", square(4.6, 0.25), g.lamp("lamp", (150.0, 150.0, 150.0)))
    g.add("board", square(5.8, 1.5).flipped(), g.material("board", WHITE))
    g.camera("corner", (3.4, 2.0, 2.4), (0.5, 0.6, 0.4), 50, 4 / 3)
    return g


def sphere():
    """A smooth sphere that touches the floor of a closed room."""
    g = Gltf()
    g.add("room", room((-2, 0, -2), (2, 2.6, 2)), g.material("white", WHITE))
    g.add("sphere", icosphere(0.5, 4), g.material("sphere", WARM), at=(0.3, 0.5, -0.2))
    g.add("lamp", panel(-1.6, -0.8, -0.4, 0.4, 2.59), g.lamp("lamp", (14.0, 14.0, 14.0)))
    g.camera("front", (1.2, 1.1, 1.8), (0.2, 0.45, -0.2), 50, 4 / 3)
    return g


def back_wall():
    """One quad, two-sided, between a bright warm and a dim cool half of a room; its front looks to the bright one."""
    g = Gltf()
    g.add("room", room((0, 0, 0), (6, 3, 4)), g.material("white", WHITE))
    g.add("wall", wall((3, 0, 4), (3, 0, 0), (3, 2.3, 0), (3, 2.3, 4)).flipped(),
          g.material("wall", (0.6, 0.6, 0.6), doubleSided=True))
    g.add("bright lamp", panel(1, 2, 1.5, 2.5, 2.98), g.lamp("bright lamp", (16.0, 13.0, 9.0)))
    g.add("dim lamp", panel(4, 5, 1.5, 2.5, 2.98), g.lamp("dim lamp", (0.8, 1.2, 2.0)))
    g.camera("front", (0.4, 1.6, 3.6), (2.9, 1.0, 1.4), 60, 4 / 3)
    g.camera("back", (5.6, 1.6, 3.6), (3.1, 1.0, 1.4), 60, 4 / 3)
    return g
