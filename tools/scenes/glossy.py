"""Scenes of glossy surfaces, in light that is mostly indirect."""

from .gltf import Gltf
from .hard import panel, room
from .pictures import linear_byte, png
from .shapes import arc, box, icosphere, lathe, quad, wall

STRIPS = (0.4, 0.55, 0.7, 0.85)  # roughness of the floor's strips
RAMP = (0.35, 0.75)  # and from where to where it grows where it is one


def strips(g):
    """A metal floor of four roughnesses."""
    for i, roughness in enumerate(STRIPS):
        metal = g.material("metal %.2f" % roughness, (0.75, 0.73, 0.7), metallic=1.0, roughness=roughness, specular=1)
        g.add("floor %.2f" % roughness, panel(1.5 * i, 1.5 * i + 1.5, 0, 6, 0, up=True), metal)


def ramp(g):
    """A metal floor whose roughness grows from left to right."""
    width = 256
    rough = png(width, 1, lambda x, y: (0, linear_byte(RAMP[0] + (RAMP[1] - RAMP[0]) * x / (width - 1)), 255))
    metal = g.material("metal", (0.75, 0.73, 0.7), metallic=1.0, specular=1, metallicRoughnessTexture={"index": g.texture("roughness", rough, "clamp")})
    g.add("floor", quad((0, 0, 6), (6, 0, 6), (6, 0, 0), (0, 0, 0)), metal)


def glossy_room(add_floor=strips):
    """A room lit from a cove against a red and a blue wall; its floor is metal, a screen hangs over it."""
    g = Gltf()
    white, red, blue = (g.material(n, c) for n, c in (("white", (0.75, 0.75, 0.72)), ("red", (0.65, 0.08, 0.05)),
                                                     ("blue", (0.08, 0.15, 0.6))))
    g.add("ceiling and back", room((0, 0, 0), (6, 3, 6), without=("-x", "+x", "-y")), white)
    g.add("left wall", wall((0, 0, 6), (0, 0, 0), (0, 3, 0), (0, 3, 6)), red)
    g.add("right wall", wall((6, 0, 0), (6, 0, 6), (6, 3, 6), (6, 3, 0)), blue)
    add_floor(g)
    # Lamps that shine at the red wall's upper part and at the back, hidden from the camera by their black backs.
    lamp = g.lamp("lamp", (60.0, 52.0, 40.0))
    black = g.material("back of lamps", (0.02, 0.02, 0.02))
    g.add("left lamp", wall((0.5, 2.2, 1), (0.5, 2.2, 4), (0.5, 2.6, 4), (0.5, 2.6, 1)), lamp)
    g.add("left back", wall((0.51, 2.2, 4), (0.51, 2.2, 1), (0.51, 2.6, 1), (0.51, 2.6, 4)), black)
    cool = g.lamp("cool lamp", (25.0, 30.0, 40.0))
    g.add("back lamp", wall((4.8, 2.3, 0.5), (2.8, 2.3, 0.5), (2.8, 2.6, 0.5), (4.8, 2.6, 0.5)), cool)
    g.add("back back", wall((2.8, 2.3, 0.51), (4.8, 2.3, 0.51), (4.8, 2.6, 0.51), (2.8, 2.6, 0.51)), black)
    # The occluder: its silhouette moves over the floor.
    g.add("screen", box((1.2, 0.35, 2.2), (4.2, 1.1, 2.25)), g.material("screen", (0.1, 0.1, 0.1)))
    brass = g.material("brass", (0.85, 0.6, 0.25), metallic=1.0, roughness=0.6, specular=1)
    copper = g.material("copper", (0.85, 0.45, 0.3), metallic=1.0, roughness=0.75, specular=1)
    varnish = g.material("varnish", (0.35, 0.2, 0.1), roughness=0.55, specular=1)
    g.add("ball", icosphere(0.5, 4), brass, at=(4.6, 0.5, 3.6))
    vase = [[(0, 0), (0.3, 0)], [(0.3, 0), (0.42, 0.2), (0.45, 0.4), (0.36, 0.65), (0.2, 0.85), (0.16, 1.0), (0.24, 1.15)]]
    g.add("vase", lathe(vase, 48), copper, at=(1.4, 0, 3.7))
    g.add("chest", box((2.5, 0, 3.4), (3.5, 0.5, 4.0)), varnish)
    g.camera("front", (3, 1.7, 5.9), (3, 0.7, 2), 60, 4 / 3)
    g.camera("floor", (0.8, 0.9, 5.6), (3.2, 0, 2.6), 50, 4 / 3)
    return g


def glossy_ramp():
    return glossy_room(ramp)


def glossy_ring():
    """A flat metal ring on a chequered floor, with posts that its face reflects."""
    g = Gltf()
    pale, dark = g.material("pale", (0.7, 0.68, 0.62)), g.material("dark", (0.15, 0.14, 0.16))
    g.add("room", room((-3, 0, -3), (3, 3, 3), without=("-y",)), pale)
    light_tiles, dark_tiles = None, None
    for i in range(8):
        for k in range(8):
            tile = panel(-3 + 0.75 * i, -2.25 + 0.75 * i, -3 + 0.75 * k, -2.25 + 0.75 * k, 0, up=True)
            if (i + k) % 2:
                dark_tiles = tile if dark_tiles is None else dark_tiles + tile
            else:
                light_tiles = tile if light_tiles is None else light_tiles + tile
    g.add("pale tiles", light_tiles, pale)
    g.add("dark tiles", dark_tiles, dark)
    metal = g.material("metal", (0.9, 0.75, 0.45), metallic=1.0, roughness=0.6, specular=1)
    ring = [[(1.5, 0), (1.5, 0.12)], [(1.5, 0.12), (0.7, 0.12)], [(0.7, 0.12), (0.7, 0)]]
    g.add("ring", lathe(ring, 96), metal)
    for color, at in (((0.7, 0.1, 0.08), (0, 0, 0)), ((0.1, 0.35, 0.7), (-1.7, 0, -1.2)), ((0.15, 0.6, 0.2), (1.6, 0, -1.3))):
        post = [[(0.14, 0), (0.14, 0.9)] + arc((0, 0.9), 0.14, 0, 90, 6)[1:]]
        g.add("post", lathe(post, 32), g.material("post %.2f" % color[0], color), at=at)
    g.add("lamp", panel(-2.6, -1.4, -2.6, 2.6, 2.2, up=True), g.lamp("lamp", (30.0, 28.0, 24.0)))
    g.add("shade", panel(-2.6, -1.4, -2.6, 2.6, 2.19), g.material("shade", (0.05, 0.05, 0.05)))
    g.camera("above", (0, 2.6, 2.9), (0, 0.1, -0.1), 50, 4 / 3)
    return g
