"""The radiosity of POV-Ray beside `cached`: the same scenes, the indirect part of the picture alone.

A scene's lamp is an area of one radiance. POV-Ray gets 16 spotlights in a 4 x 4 grid on it, of a quarter of its length and width each, which shine with
the cosine of a diffuse emitter. What they light directly, a picture without radiosity, is taken from the picture with it. POV-Ray's colours are radiance, a
light's is pi times less than its intensity."""
import array
import json
import math
import os
import shutil
import struct
import subprocess

from measure import ATRIUM, BUILD, CORNELL, ROOT, cost, error, percent, render, table
import png

QUALITIES = {"medium": "count 200 nearest_count 5 error_bound 0.5 recursion_limit 4 low_error_factor 0.5 minimum_reuse 0.015",
             "high": "count 800 nearest_count 8 error_bound 0.25 recursion_limit 6 low_error_factor 0.5 minimum_reuse 0.005"}
QUALITIES_OF = {"cornell-box": ("medium", "high"), "atrium": ("medium",)}  # high had not ended there after eight minutes on two cores
BRIGHTEST = {"cornell-box": 4, "atrium": 16}  # radiance that 16 bits of a picture's channel hold
EXPOSURE = {"cornell-box": 1, "atrium": 0.74}  # of the pictures shown
FADE = 1e-4  # of the scene; POV-Ray's inverse square begins here


class Glb:
    """As much of a glTF file as the project's own scenes have."""

    def __init__(self, path):
        data = path.read_bytes()
        length, = struct.unpack_from("<I", data, 12)
        self.json, self.binary = json.loads(data[20:20 + length]), data[28 + length:]

    def accessor(self, index):
        a = self.json["accessors"][index]
        view = self.json["bufferViews"][a["bufferView"]]
        count = {"SCALAR": 1, "VEC3": 3}[a["type"]]
        code, size = {5126: ("f", 4), 5125: ("I", 4), 5123: ("H", 2)}[a["componentType"]]
        start, stride = view.get("byteOffset", 0) + a.get("byteOffset", 0), view.get("byteStride", count * size)
        return [struct.unpack_from(f"<{count}{code}", self.binary, start + i * stride) for i in range(a["count"])]

    def instances(self):
        """(node, matrix by columns) of all nodes."""
        children = {c for node in self.json["nodes"] for c in node.get("children", [])}
        stack = [(i, None) for i in range(len(self.json["nodes"])) if i not in children]
        while stack:
            index, parent = stack.pop()
            node = self.json["nodes"][index]
            matrix = multiplied(parent, local_matrix(node))
            yield node, matrix
            stack += [(c, matrix) for c in node.get("children", [])]


def local_matrix(node):
    if "matrix" in node:
        m = node["matrix"]
        return [m[0:3], m[4:7], m[8:11], m[12:15]]
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    s = node.get("scale", (1, 1, 1))
    turned = [(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)), (2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)),
              (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))]
    return [[c * s[i] for c in turned[i]] for i in range(3)] + [list(node.get("translation", (0, 0, 0)))]


def turned(m, v):
    return [sum(m[k][i] * v[k] for k in range(3)) for i in range(3)]


def moved(m, p):
    return [a + b for a, b in zip(turned(m, p), m[3])]


def multiplied(a, b):
    return b if a is None else [turned(a, b[k]) for k in range(3)] + [moved(a, b[3])]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def length(v):
    return math.sqrt(sum(c * c for c in v))


def vector(v):
    return f"<{v[0]:.9g},{v[1]:.9g},{v[2]:.9g}>"


def listed(name, vectors):
    return f"{name}{{{len(vectors)},{','.join(vectors)}}}"


def spotlights(points, radiance, scale):
    """A 4 x 4 grid on the parallelogram of the points 0, 1 and their neighbour across."""
    a, b, c = points[0], points[1], points[-1]
    along, across = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    n = cross(along, across)
    area = length(n)
    n = [c / area for c in n]
    color = [channel * area / 16 / math.pi / (2 * (FADE * scale) ** 2) for channel in radiance]
    text = ""
    for i in range(16):
        u, v = (i % 4 + 0.5) / 4, (i // 4 + 0.5) / 4
        at = [p + u * s + v * t + 1e-4 * scale * m for p, s, t, m in zip(a, along, across, n)]
        text += (f"light_source{{{vector(at)} color rgb {vector(color)} spotlight radius 90 falloff 90 tightness 1 "
                 f"point_at {vector([p + m for p, m in zip(at, n)])} fade_distance {FADE * scale:.9g} fade_power 2}}\n")
    return text


def scene_text(view, radiosity):
    glb, meshes, lights, camera = Glb(view.scene), "", "", ""
    corners = [p for node, m in glb.instances() if "mesh" in node for primitive in glb.json["meshes"][node["mesh"]]["primitives"]
               for p in (moved(m, q) for q in glb.accessor(primitive["attributes"]["POSITION"]))]
    scale = length([max(p[i] for p in corners) - min(p[i] for p in corners) for i in range(3)])
    for node, m in glb.instances():
        if node.get("camera") == 0:
            aspect, tangent = eval(view.size.replace("x", "/")), math.tan(glb.json["cameras"][node["camera"]]["perspective"]["yfov"] / 2)
            right, up, back = (turned(m, axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))
            camera = (f"camera{{location {vector(m[3])} direction {vector([-c for c in back])} up {vector([2 * tangent * c for c in up])} "
                      f"right {vector([2 * tangent * aspect * c for c in right])}}}\n")
        for primitive in glb.json["meshes"][node["mesh"]]["primitives"] if "mesh" in node else ():
            material = glb.json["materials"][primitive["material"]]
            points = [moved(m, p) for p in glb.accessor(primitive["attributes"]["POSITION"])]
            faces = [i for i, in glb.accessor(primitive["indices"])]
            parts = [listed("vertex_vectors", [vector(p) for p in points])]
            if "NORMAL" in primitive["attributes"]:
                parts.append(listed("normal_vectors", [vector(turned(m, n)) for n in glb.accessor(primitive["attributes"]["NORMAL"])]))
            parts.append(listed("face_indices", [vector(faces[i:i + 3]) for i in range(0, len(faces), 3)]))
            color = material["pbrMetallicRoughness"]["baseColorFactor"][:3]
            meshes += f"mesh2{{{' '.join(parts)} pigment{{rgb {vector(color)}}} finish{{ambient 0 diffuse 1}}}}\n"
            emitted = material.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1)
            radiance = [emitted * c for c in material.get("emissiveFactor", (0, 0, 0))]
            if any(radiance):
                lights += spotlights([points[faces[0]], points[faces[1]], next(points[i] for i in faces[3:] if i not in faces[:3])], radiance, scale)
    settings = f"radiosity{{{radiosity} pretrace_start 0.08 pretrace_end {2 / 512:.6f} brightness 1 gray_threshold 0 always_sample off}}" if radiosity else ""
    whole = f"#version 3.7;\nglobal_settings{{assumed_gamma 1 max_trace_level 12 {settings}}}\n{camera}{lights}{meshes}"
    # As large as a channel of the picture holds.
    return whole.replace("color rgb <", f"color rgb {1 / BRIGHTEST[view.name]:.6g}*<")


def traced(view, name, radiosity):
    """(pixels in radiance, row by row from the top, CPU seconds)"""
    stem = BUILD / f"povray-{view.name}-{name}"
    stem.with_suffix(".pov").write_text(scene_text(view, radiosity))
    width, height = view.size.split("x")
    before = os.times()
    subprocess.run(["povray", f"+I{stem}.pov", f"+O{stem}.ppm", "+FP16", f"+W{width}", f"+H{height}", "-D", "-V", "+WT2", "+A0.0", "+AM1", "+R2", "-J",
                    "File_Gamma=1.0"], check=True, capture_output=True)
    after = os.times()
    data = stem.with_suffix(".ppm").read_bytes()
    body = data[len(data) - 6 * int(width) * int(height):]
    values = array.array("H", body)
    values.byteswap()
    return [BRIGHTEST[view.name] * v / 65535 for v in values], after.children_user + after.children_system - before.children_user - before.children_system


def write_exr(path, width, height, pixels):
    """The pixels as layer `indirect` of an uncompressed file."""
    def attribute(name, kind, value):
        return f"{name}\0{kind}\0".encode() + struct.pack("<i", len(value)) + value

    channels = b"".join(f"indirect.{c}\0".encode() + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1) for c in "BGR") + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = (b"\x76\x2f\x31\x01\x02\0\0\0" + attribute("channels", "chlist", channels) + attribute("compression", "compression", b"\0") +
              attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", b"\0") +
              attribute("pixelAspectRatio", "float", struct.pack("<f", 1)) + attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)) +
              attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0")
    row = 12 * width
    offsets = [len(header) + 8 * height + y * (row + 8) for y in range(height)]
    with open(path, "wb") as out:
        out.write(header + struct.pack(f"<{height}Q", *offsets))
        for y in range(height):
            line = pixels[3 * width * y:3 * width * (y + 1)]
            out.write(struct.pack("<2i", y, row) + b"".join(array.array("f", line[c::3]).tobytes() for c in (2, 1, 0)))


def display(pixels, width, height, scale):
    """Rows of bytes, by gamma 2.2."""
    shown = bytes(round(255 * min(1, max(0, c * scale)) ** (1 / 2.2)) for c in pixels)
    return [shown[3 * width * y:3 * width * (y + 1)] for y in range(height)]


def view_rows(view):
    width, height = map(int, view.size.split("x"))
    rows = []
    direct, without = traced(view, "direct", "")
    for quality in QUALITIES_OF[view.name]:
        settings = QUALITIES[quality]
        whole, cpu = traced(view, quality, settings)
        picture = BUILD / f"povray-{view.name}-{quality}.exr"
        write_exr(picture, width, height, [max(0, a - b) for a, b in zip(whole, direct)])
        rows.append((f"POV-Ray, {quality}", cpu, error(view, picture, "indirect")))
        png.write(ROOT / "docs" / "figures" / f"povray-{view.name}-{quality}.png", width, display(whole, width, height, EXPOSURE[view.name]))
    for asked in (0.1, 0.05, 0.03):
        picture = BUILD / f"povray-{view.name}-cached.exr"
        stats = render(view, "--error", asked, "--spp", 4, "--seed", 1, "--no-check", output=picture)
        rows.append((f"cached, error {asked}", cost(stats), error(view, picture, "indirect")))
    return [[view.name, name, f"{cpu:.1f}", percent(e["relative_rmse"]), percent(e["block_error"]), f"{100 * e['bias']:+.2f}"] for name, cpu, e in rows]


def section():
    if not shutil.which("povray"):
        raise SystemExit("this section needs povray: apt-get install povray")
    rows = [row for view in (CORNELL, ATRIUM) for row in view_rows(view)]
    return ("## POV-Ray's radiosity\n\nThe indirect part of the picture (what is left without the direct light), 4 samples a pixel each. "
            "The lamp is 16 spotlights to POV-Ray 3.7, 2 threads; " + "; ".join(f"*{q}* is `{s}`" for q, s in QUALITIES.items()) + " (not ended on the atrium within eight minutes):\n\n" +
            table(["scene", "picture", "CPU s", "RMSE %", "block %", "bias %"], rows) + "\n\n" +
            "\n".join(f"![POV-Ray, {v.name}, {q}](figures/povray-{v.name}-{q}.png)" for v in (CORNELL, ATRIUM) for q in QUALITIES_OF[v.name]))
