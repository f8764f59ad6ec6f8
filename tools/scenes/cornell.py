"""The Cornell box from its published measurements, a hundredth of the millimetres being metres: a room 5.5 m wide."""

import math

from .gltf import Gltf
from .shapes import frame, wall

# The measured spectra as linear RGB, the values in common use for them.
WHITE, RED, GREEN = (0.725, 0.71, 0.68), (0.63, 0.065, 0.05), (0.14, 0.45, 0.091)
LAMP_RADIANCE, LAMP_REFLECTANCE = (17.0, 12.0, 4.0), (0.78, 0.78, 0.78)

# The tops of the blocks as published, clockwise from above.
SHORT_BLOCK, SHORT_HEIGHT = [(130, 65), (82, 225), (240, 272), (290, 114)], 165
TALL_BLOCK, TALL_HEIGHT = [(423, 247), (265, 296), (314, 456), (472, 406)], 330


def metres(points):
    return [tuple(x / 100 for x in p) for p in points]


def block(ring, height):
    """A block without its underside: it stands on the floor."""
    top = metres((x, height, z) for x, z in ring)
    shape = wall(*top)
    for (ax, az), (bx, bz) in zip(ring, ring[1:] + ring[:1]):
        shape += wall(*metres([(ax, 0, az), (bx, 0, bz), (bx, height, bz), (ax, height, az)]))
    return shape


def cornell_box(scale=1.0):
    """`scale` multiplies lengths only: radiance does not change with size."""
    g = Gltf(scale)
    white, red, green = (g.material(n, c) for n, c in (("white", WHITE), ("red", RED), ("green", GREEN)))
    lamp = g.lamp("lamp", LAMP_RADIANCE, LAMP_REFLECTANCE)
    opening = [(213, 548.8, 227), (343, 548.8, 227), (343, 548.8, 332), (213, 548.8, 332)]
    floor = wall(*metres([(0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2), (552.8, 0, 0)]))
    ceiling = frame(metres([(0, 548.8, 0), (556, 548.8, 0), (556, 548.8, 559.2), (0, 548.8, 559.2)]), metres(opening))
    back = wall(*metres([(549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556, 548.8, 559.2)]))
    right = wall(*metres([(0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2)]))
    left = wall(*metres([(552.8, 0, 0), (549.6, 0, 559.2), (549.6, 548.8, 559.2), (556, 548.8, 0)]))
    g.add("floor", floor, white)
    g.add("ceiling", ceiling, white)
    g.add("back wall", back, white)
    g.add("right wall", right, green)
    g.add("left wall", left, red)
    g.add("short block", block(SHORT_BLOCK, SHORT_HEIGHT), white)
    g.add("tall block", block(TALL_BLOCK, TALL_HEIGHT), white)
    g.add("lamp", wall(*metres(opening)), lamp)
    # Published: at (278, 273, -800), focal length 0.035, film 0.025 square.
    g.camera("published", (2.78, 2.73, -8), (2.78, 2.73, 0), math.degrees(2 * math.atan(0.0125 / 0.035)), 1)
    return g
