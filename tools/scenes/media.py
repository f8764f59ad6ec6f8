"""Scenes in participating media. What fills the air stands in the TOML files."""

from .gltf import Gltf
from .hard import GREY, WARM, WHITE, room
from .shapes import Shape, box, frame, sphere, wall


def fog_spot():
    """A closed room with a spot in its ceiling; a slatted board and a ball cut its cone into shafts."""
    g = Gltf()
    g.add("room", room((0, 0, 0), (5, 3, 4)), g.material("grey", GREY))
    slats = Shape()
    for k in range(4):
        slats += box((2.0 + 0.26 * k, 2.2, 1.5), (2.13 + 0.26 * k, 2.23, 2.5))
    g.add("slats", slats, g.material("wood", WARM))
    g.add("ball", sphere(0.35, 48), g.material("white", WHITE), at=(2.7, 0.9, 2.1))
    g.spot("spot", (2.5, 2.95, 2.0), (2.5, 0.0, 2.0), (1, 0.93, 0.8), 60.0, 20, 28)
    g.camera("front", (0.3, 1.4, 3.8), (2.6, 1.45, 1.9), 60, 4 / 3)
    return g


def opening_in_x(x, y, z, hole_y, hole_z):
    """A wall in the plane of `x`, facing -x, with a rectangular hole; y, z, hole_y, hole_z are spans."""
    def ring(ys, zs):
        return [(x, ys[0], zs[1]), (x, ys[1], zs[1]), (x, ys[1], zs[0]), (x, ys[0], zs[0])]

    return frame(ring(y, z), ring(hole_y, hole_z))


def sun_window():
    """A room of 4 x 3 x 5 m whose window, two panes in a wall 0.2 m thick, lets the sun onto the floor."""
    g = Gltf()
    plaster, wood, cloth = (g.material(n, c) for n, c in (("plaster", (0.5, 0.48, 0.45)), ("wood", (0.35, 0.22, 0.14)), ("cloth", (0.5, 0.12, 0.1))))
    hole_y, hole_z = (0.9, 2.4), (1.6, 3.4)
    g.add("walls", room((0, 0, 0), (4, 3, 5), without=("+x", "-y")), plaster)
    g.add("floor", wall((0, 0, 5), (4, 0, 5), (4, 0, 0), (0, 0, 0)), wood)
    outside = opening_in_x(4.2, (0, 3), (0, 5), hole_y, hole_z).flipped()
    g.add("window wall", opening_in_x(4, (0, 3), (0, 5), hole_y, hole_z) + outside, plaster)
    reveal = box((4, hole_y[0], hole_z[0]), (4.2, hole_y[1], hole_z[1]), inward=True, without=("-x", "+x"))
    g.add("reveal", reveal, plaster)
    g.add("bars", box((4.08, hole_y[0], 2.46), (4.12, hole_y[1], 2.54)) + box((4.08, 1.62, 1.6), (4.12, 1.68, 3.4)), wood)
    table = box((1.1, 0.68, 2.0), (2.0, 0.73, 3.4))
    for x in (1.15, 1.9):
        for z in (2.05, 3.3):
            table += box((x, 0, z), (x + 0.05, 0.68, z + 0.05))
    g.add("table", table, wood)
    g.add("ball", sphere(0.2, 48), cloth, at=(1.5, 0.93, 2.6))
    g.sun("sun", (-1.0, -0.85, -0.25), (1, 0.9, 0.75), 90.0)
    g.camera("door", (0.5, 1.5, 4.8), (2.5, 1.2, 1.9), 60, 4 / 3)
    return g


def plume():
    """Dark ground under a plume of smoke that a lamp lights from the side."""
    g = Gltf()
    dark = g.material("dark", (0.08, 0.08, 0.09))
    g.add("ground", wall((-6, 0, 6), (6, 0, 6), (6, 0, -6), (-6, 0, -6)), dark)
    g.add("vent", box((-0.25, 0, -0.25), (0.25, 0.02, 0.25), without=("-y",)), g.material("vent", (0.3, 0.3, 0.3)))
    g.add("lamp", wall((3, 0.8, 1.2), (3, 2.4, 1.2), (3, 2.4, -0.4), (3, 0.8, -0.4)), g.lamp("lamp", (40.0, 36.0, 30.0)))
    g.camera("front", (0.6, 1.5, 5.2), (0, 1.45, 0), 36, 3 / 4)
    g.camera("low", (-2.4, 0.5, 3.0), (0, 1.4, 0), 44, 3 / 4)
    return g


TOML = {
    "fog-spot.toml": """\
# A spot in a room full of fog.
[scene]
file = "fog-spot.glb"

[[media]]
name = "fog"
sigma_s = 0.25
sigma_a = 0.01
g = 0.4
""",
    "sun-window.toml": """\
# The sun in dusty air. Outside it is clear.
[scene]
file = "sun-window.glb"

[environment]
file = "plate-sky.exr"

[[media]]
name = "dust"
density = 0.2
albedo = [0.98, 0.96, 0.92]
g = 0.4
box = [[0, 0, 0], [4, 3, 5]]
""",
    "plume.toml": """\
# Smoke, lit from the side.
[scene]
file = "plume.glb"

[[media]]
name = "smoke"
density = 30
albedo = [0.95, 0.94, 0.92]
g = 0.3
grid = { file = "plume.vdb", name = "density" }
""",
    "cornell-fog.toml": """\
# The Cornell box in coloured air: red is absorbed most, blue is scattered most.
[scene]
file = "cornell-box.glb"

[[media]]
name = "air"
sigma_s = [0.04, 0.07, 0.12]
sigma_a = [0.03, 0.015, 0.005]
box = [[0, 0, 0], [5.56, 5.488, 5.592]]
""",
}
