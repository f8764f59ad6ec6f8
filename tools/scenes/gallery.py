"""A room with textured, glossy, mirror and glass things: most of what the loader understands, in one picture."""

import math

from .gltf import Gltf
from .pictures import linear_byte, png, srgb_byte
from .shapes import Shape, box, icosphere, plain, quad, sheet, sphere, wall

SIZE = 128


def parquet():
    """Blocks of four planks, lying and standing in turn."""
    def pixel(x, y):
        across, along = (x, y) if (x // 64 + y // 64) % 2 else (y, x)
        plank = across // 16
        tone = 0.75 + 0.25 * math.sin(12.9 * plank + 4.1 * (along // 64)) + 0.1 * math.sin(0.9 * across + 0.07 * along)
        seam = 0.35 if across % 16 == 0 or along % 64 == 0 else 1
        return tuple(srgb_byte(seam * tone * c) for c in (0.42, 0.23, 0.11))

    return png(SIZE, SIZE, pixel)


def painting():
    """Rings of colour."""
    def pixel(x, y):
        u, v = x / SIZE - 0.4, y / SIZE - 0.55
        r, angle = math.hypot(u, v), math.atan2(v, u)
        return tuple(srgb_byte(0.45 + 0.4 * math.sin(28 * r + k * angle + 2.1 * k)) for k in range(3))

    return png(SIZE, SIZE, pixel)


def lattice():
    """Opaque bars around round holes."""
    def pixel(x, y):
        u, v = (x % 32) / 32 - 0.484375, (y % 32) / 32 - 0.484375
        return (*(srgb_byte(c) for c in (0.3, 0.18, 0.08)), linear_byte((math.hypot(u, v) - 0.28) * 12 + 0.5))

    return png(64, 64, pixel)


def studs():
    """Normals of a grid of round bumps, Y up as glTF."""
    def pixel(x, y):
        u, v = (x % 32 - 15.5) / 13, (y % 32 - 15.5) / 13
        inside = max(0.0, 1 - u * u - v * v)
        nx, ny = (1.2 * u * inside, -1.2 * v * inside)
        length = math.sqrt(nx * nx + ny * ny + 1)
        return tuple(linear_byte(0.5 + 0.5 * c / length) for c in (nx, ny, 1))

    return png(SIZE, SIZE, pixel)


def brushed():
    """Roughness (green) and metal (blue) in squares."""
    def pixel(x, y):
        light = (x // 16 + y // 16) % 2
        return (0, linear_byte(0.25 if light else 0.7), linear_byte(1 if light else 0))

    return png(64, 64, pixel)


def sign():
    """A glowing wave on black."""
    def pixel(x, y):
        near = math.exp(-((y / 32 - 0.5 - 0.3 * math.sin(x / 10)) * 7) ** 2)
        return tuple(srgb_byte(near * c) for c in (1.0, 0.45, 0.15))

    return png(64, 32, pixel)


def uv_box(lower, upper):
    """A box each of whose sides has the whole texture."""
    solid = box(lower, upper)
    shape = Shape()
    for (a, b, c), (_, _, d) in zip(solid.triangles[::2], solid.triangles[1::2]):
        shape += quad(*(solid.positions[i] for i in (a, b, c, d)))
    return shape


def knot():
    """A torus, coloured along its ring through its vertices."""
    def point(s, t):
        ring, tube = 2 * math.pi * s, 2 * math.pi * t
        r = 0.26 + 0.1 * math.cos(tube)
        return (r * math.cos(ring), 0.1 * math.sin(tube), -r * math.sin(ring))

    shape = sheet(point, 48, 24, wrap=(True, True))
    for x, y, z in shape.positions:
        angle = math.atan2(z, x)
        shape.colors.append(tuple(0.5 + 0.4 * math.cos(angle + 2.1 * k) for k in range(3)) + (1.0,))
    return shape


def furnish(g, white):
    pedestal = g.mesh("pedestal", (box((-0.3, 0, -0.3), (0.3, 0.8, 0.3)), white))
    for x, z in ((-2, -1), (-0.7, -1.3), (0.7, -1.3), (2, -1), (0, 0.4)):
        g.node(pedestal, at=(x, 0, z))
    ball = sphere(0.3, 64)
    g.add("glossy ball", ball, g.material("lacquer", (0.5, 0.04, 0.03), roughness=0.3, specular=1), at=(-2, 1.1, -1))
    g.add("metal ball", ball, g.material("brass", (0.9, 0.65, 0.3), metallic=1.0, roughness=0.25, specular=1), at=(-0.7, 1.1, -1.3))
    glass = g.material("glass", (1, 1, 1), roughness=0.0, specular=1, extensions={
        "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.5},
        "KHR_materials_volume": {"thicknessFactor": 0.6, "attenuationColor": [0.55, 0.85, 0.7], "attenuationDistance": 0.5}})
    g.add("glass ball", icosphere(0.3, 4), glass, at=(0.7, 1.1, -1.3))
    chequer = g.material("chequer", (0.8, 0.8, 0.85), metallic=1.0, roughness=1.0, specular=1,
                         metallicRoughnessTexture={"index": g.texture("brushed", brushed())})
    g.add("chequered box", uv_box((-0.25, 0, -0.25), (0.25, 0.5, 0.25)), chequer, at=(2, 0.8, -1), turn=30)
    g.add("ring", knot(), g.material("painted", (1, 1, 1)), at=(0, 0.92, 0.4))
    pane = g.material("pane", (0.9, 1.0, 0.95), roughness=0.0, specular=1,
                      extensions={"KHR_materials_transmission": {"transmissionFactor": 1}})
    g.add("thin pane", wall((1.2, 0.02, 0.9), (2.2, 0.02, 0.4), (2.2, 1.4, 0.4), (1.2, 1.4, 0.9)), pane)


def hang(g, white):
    """What is on the walls: pictures, a mirror, studs, a lattice before the right wall, a sign."""
    art = g.material("painting", (1, 1, 1), baseColorTexture={"index": g.texture("painting", painting(), "clamp")})
    g.add("painting", quad((-2.4, 1.1, -1.98), (-1, 1.1, -1.98), (-1, 2.2, -1.98), (-2.4, 2.2, -1.98)), art)
    silver = g.material("mirror", (0.92, 0.92, 0.9), metallic=1.0, roughness=0.0, specular=1)
    g.add("mirror", wall((0.2, 0.9, -1.98), (1.4, 0.9, -1.98), (1.4, 2.5, -1.98), (0.2, 2.5, -1.98)), silver)
    g.add("mirror's frame", box((0.12, 0.82, -2), (1.48, 2.58, -1.985)), white)
    studded = g.material("studs", (0.25, 0.4, 0.6), roughness=0.5, specular=1,
                         normalTexture={"index": g.texture("studs", studs()), "scale": 1})
    g.add("studs", quad((-2.98, 0.7, 1.2), (-2.98, 0.7, -1.2), (-2.98, 2.2, -1.2), (-2.98, 2.2, 1.2)), studded)
    bars = g.material("lattice", (1, 1, 1), doubleSided=True, alphaMode="MASK", alphaCutoff=0.5, baseColorTexture={
        "index": g.texture("lattice", lattice()), "extensions": {"KHR_texture_transform": {"scale": [4, 4]}}})
    g.extensions.add("KHR_texture_transform")
    g.add("lattice", quad((2.6, 0.1, -0.9), (2.6, 0.1, 1.5), (2.6, 2.2, 1.5), (2.6, 2.2, -0.9)).flipped(), bars)
    glow = g.lamp("sign", (6.0, 6.0, 6.0), emissiveTexture={"index": g.texture("sign", sign(), "clamp")})
    g.add("sign", quad((1.7, 1.6, -1.98), (2.7, 1.6, -1.98), (2.7, 2.1, -1.98), (1.7, 2.1, -1.98)), glow)


def gallery():
    g = Gltf()
    white, warm = g.material("white", (0.78, 0.77, 0.74)), g.material("warm", (0.62, 0.5, 0.36))
    planks = g.material("parquet", (1, 1, 1), roughness=0.35, specular=1, baseColorTexture={
        "index": g.texture("parquet", parquet()), "extensions": {"KHR_texture_transform": {"scale": [3, 2]}}})
    g.add("floor", quad((-3, 0, 2), (3, 0, 2), (3, 0, -2), (-3, 0, -2)), planks)
    g.add("walls", box((-3, 0, -2), (3, 3, 2), inward=True, without=("-y", "-x")), white)
    g.add("left wall", wall((-3, 0, 2), (-3, 0, -2), (-3, 3, -2), (-3, 3, 2)), warm)
    hang(g, white)
    furnish(g, white)
    lamp = g.mesh("lamp", (plain(quad((-0.5, 0, -0.2), (0.5, 0, -0.2), (0.5, 0, 0.2), (-0.5, 0, 0.2))),
                           g.lamp("lamp", (14.0, 13.0, 11.0))))
    for x in (-1.6, 1.6):
        g.node(lamp, at=(x, 2.98, 0.3))
    g.spot("spot", (0, 2.9, 1.6), (0, 0.9, 0.4), [1.0, 0.9, 0.75], 4.0, 8, 14)
    g.camera("front", (0.4, 1.6, 1.9), (0.1, 1.1, -1), 70, 4 / 3)
    g.camera("left", (2.4, 1.6, 1.8), (-2.6, 1.2, -1.6), 55, 4 / 3)
    g.camera("right", (-2.6, 1.6, 1.8), (2.4, 1.0, -1.4), 55, 4 / 3)
    g.camera("mirror", (-0.6, 1.5, 0.9), (0.8, 1.5, -2), 50, 4 / 3)
    return g
