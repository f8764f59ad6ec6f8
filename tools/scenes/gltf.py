"""Writes glTF 2.0 binary files: meshes, materials, textures, cameras, lamps. The same calls give the same bytes."""

import json
import math
import struct

FLOAT, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5123, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


def float32(x):
    """The nearest 32-bit float, short enough in text to be read back as the same one."""
    x = struct.unpack("<f", struct.pack("<f", x))[0]
    return float("%.9g" % x) + 0.0


def look_at(eye, target):
    """The matrix (column by column) of a node whose camera looks along its -Z from `eye` to `target`."""
    def unit(v):
        length = math.sqrt(sum(x * x for x in v))
        return [x / length for x in v]

    back = unit([e - t for e, t in zip(eye, target)])
    up = (0, 1, 0) if abs(back[1]) < 0.999 else (0, 0, -1)
    right = unit([up[1] * back[2] - up[2] * back[1], up[2] * back[0] - up[0] * back[2], up[0] * back[1] - up[1] * back[0]])
    true_up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2],
               back[0] * right[1] - back[1] * right[0]]
    return [float32(x) for x in [*right, 0, *true_up, 0, *back, 0, *eye, 1]]


class Gltf:
    def __init__(self, scale=1.0):
        """`scale` multiplies every length, after rounding to 32 bits: exact where it is a power of two."""
        self.scale = scale
        self.binary = bytearray()
        self.views, self.accessors = [], []
        self.materials, self.textures, self.images, self.samplers = [], [], [], []
        self.meshes, self.nodes, self.cameras, self.lights = [], [], [], []
        self.extensions = set()
        self.triangles_of_mesh = []
        self.triangles = 0

    def _view(self, data, target=None):
        self.binary += bytes(-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.binary += data
        self.views.append(view)
        return len(self.views) - 1

    def _vectors(self, vectors, bounds=False):
        kind = {2: "VEC2", 3: "VEC3", 4: "VEC4"}[len(vectors[0])]
        data = struct.pack("<%df" % (len(vectors) * len(vectors[0])), *(x for v in vectors for x in v))
        accessor = {"bufferView": self._view(data, ARRAY_BUFFER), "componentType": FLOAT, "count": len(vectors), "type": kind}
        if bounds:
            accessor["min"] = [float32(min(axis)) for axis in zip(*vectors)]
            accessor["max"] = [float32(max(axis)) for axis in zip(*vectors)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def _indices(self, triangles, vertices):
        kind, code = (UNSIGNED_SHORT, "H") if vertices < 65536 else (UNSIGNED_INT, "I")
        data = struct.pack("<%d%s" % (3 * len(triangles), code), *(i for t in triangles for i in t))
        self.accessors.append({"bufferView": self._view(data, ELEMENT_ARRAY_BUFFER), "componentType": kind,
                               "count": 3 * len(triangles), "type": "SCALAR"})
        return len(self.accessors) - 1

    def _length(self, x):
        return float32(x) * self.scale

    def texture(self, name, png, wrap="repeat"):
        code = {"repeat": 10497, "clamp": 33071, "mirror": 33648}[wrap]
        sampler = {"magFilter": 9729, "minFilter": 9729, "wrapS": code, "wrapT": code}
        if sampler not in self.samplers:
            self.samplers.append(sampler)
        self.images.append({"name": name, "bufferView": self._view(png), "mimeType": "image/png"})
        self.textures.append({"source": len(self.images) - 1, "sampler": self.samplers.index(sampler)})
        return len(self.textures) - 1

    def material(self, name, color, *, metallic=0.0, roughness=1.0, specular=0.0, extensions=None, **properties):
        """`color` is linear. The defaults make a Lambert surface: no metal, no specular lobe.

        `properties` are glTF's own, those of pbrMetallicRoughness among them.
        """
        pbr = {"baseColorFactor": [*color, 1], "metallicFactor": metallic, "roughnessFactor": roughness}
        for key in ("baseColorTexture", "metallicRoughnessTexture"):
            if key in properties:
                pbr[key] = properties.pop(key)
        extensions = dict(extensions or {})
        if specular != 1:
            extensions["KHR_materials_specular"] = {"specularFactor": specular}
        self.extensions.update(extensions)
        material = {"name": name, "pbrMetallicRoughness": pbr, **properties}
        if extensions:
            material["extensions"] = extensions
        self.materials.append(material)
        return len(self.materials) - 1

    def lamp(self, name, radiance, color=(0, 0, 0), **properties):
        """A material that emits `radiance` (W/m2/sr) from its front, and from its back too where doubleSided is set."""
        strength = max(radiance)
        return self.material(name, color, emissiveFactor=[float32(x / strength) for x in radiance],
                             extensions={"KHR_materials_emissive_strength": {"emissiveStrength": strength}}, **properties)

    def mesh(self, name, *parts):
        """`parts` are pairs (shape, material)."""
        primitives = []
        for shape, material in parts:
            scaled = [tuple(self._length(x) for x in p) for p in shape.positions]
            attributes = {"POSITION": self._vectors(scaled, bounds=True)}
            for key, values in (("NORMAL", shape.normals), ("TEXCOORD_0", shape.uvs), ("COLOR_0", shape.colors)):
                if values:
                    attributes[key] = self._vectors(values)
            primitives.append({"attributes": attributes, "indices": self._indices(shape.triangles, len(shape.positions)),
                               "material": material})
        self.meshes.append({"name": name, "primitives": primitives})
        self.triangles_of_mesh.append(sum(len(shape.triangles) for shape, _ in parts))
        return len(self.meshes) - 1

    def node(self, mesh, at=(0, 0, 0), turn=0.0, scale=(1, 1, 1), name=None):
        """An instance of a mesh: scaled, turned about +Y by `turn` degrees, moved."""
        node = {"mesh": mesh}
        if name:
            node["name"] = name
        if any(at):
            node["translation"] = [self._length(x) for x in at]
        if turn:
            half = math.radians(turn) / 2
            node["rotation"] = [0, float32(math.sin(half)), 0, float32(math.cos(half))]
        if scale != (1, 1, 1):
            node["scale"] = [float32(x) for x in scale]
        self.nodes.append(node)
        self.triangles += self.triangles_of_mesh[mesh]

    def add(self, name, shape, material, **placement):
        """A mesh of one material that is there once."""
        self.node(self.mesh(name, (shape, material)), name=name, **placement)

    def camera(self, name, eye, target, fov_y, aspect):
        """`fov_y` is the vertical field of view in degrees."""
        self.cameras.append({"name": name, "type": "perspective",
                             "perspective": {"yfov": float32(math.radians(fov_y)), "aspectRatio": float32(aspect),
                                             "znear": 0.01 * self.scale}})
        matrix = look_at(eye, target)
        matrix[12:15] = [x * self.scale for x in matrix[12:15]]
        self.nodes.append({"name": name, "camera": len(self.cameras) - 1, "matrix": matrix})

    def spot(self, name, eye, target, color, intensity, inner, outer):
        """`intensity` in W/sr, the cone's half angles in degrees."""
        self._light({"name": name, "type": "spot", "color": color, "intensity": intensity,
                     "spot": {"innerConeAngle": float32(math.radians(inner)),
                              "outerConeAngle": float32(math.radians(outer))}}, look_at(eye, target))

    def sun(self, name, towards, color, irradiance):
        """Parallel light that travels along `towards`; `irradiance` in W/m2 on a surface that faces it."""
        self._light({"name": name, "type": "directional", "color": color, "intensity": irradiance},
                    look_at((0, 0, 0), towards))

    def _light(self, light, matrix):
        self.extensions.add("KHR_lights_punctual")
        self.lights.append(light)
        self.nodes.append({"name": light["name"], "matrix": matrix,
                           "extensions": {"KHR_lights_punctual": {"light": len(self.lights) - 1}}})

    def bytes(self):
        document = {"asset": {"version": "2.0", "generator": "isophote tools/make-scenes"}}
        if self.extensions:
            document["extensionsUsed"] = sorted(self.extensions)
        if self.lights:
            document["extensions"] = {"KHR_lights_punctual": {"lights": self.lights}}
        document.update(scene=0, scenes=[{"nodes": list(range(len(self.nodes)))}])
        parts = [("nodes", self.nodes), ("cameras", self.cameras), ("meshes", self.meshes), ("materials", self.materials),
                 ("textures", self.textures), ("images", self.images), ("samplers", self.samplers),
                 ("accessors", self.accessors), ("bufferViews", self.views)]
        document.update((key, value) for key, value in parts if value)
        binary = bytes(self.binary) + bytes(-len(self.binary) % 4)
        document["buffers"] = [{"byteLength": len(binary)}]
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        size = 12 + 8 + len(text) + 8 + len(binary)
        return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text +
                struct.pack("<I4s", len(binary), b"BIN\0") + binary)
