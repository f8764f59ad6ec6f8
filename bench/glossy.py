"""Glossy surfaces: radiance caching against paths and against rays that read irradiance alone; its gradients; its memory."""
import json
import math
import struct

import png
from measure import BUILD, ROOT, View, cost, error, percent, render, table
from plot import log_log

SCENE = ROOT / "scenes" / "glossy-room.glb"
ROUGHNESSES = (0.55, 0.65, 0.8)  # of all metal in the scene; GGX alpha is the square
SIZE, REFERENCE = "512x384", 256
SAMPLES = 64
ERRORS = (0.1, 0.05, 0.03)
GRADIENTS = {"none": "radiance", "unaware": "radiance-surface-area", "aware": "radiance-stratified"}


def with_roughness(roughness):
    """The scene with all its metal of one roughness, as a file."""
    data = SCENE.read_bytes()
    size = struct.unpack("<I", data[12:16])[0]
    document = json.loads(data[20:20 + size])
    for material in document["materials"]:
        if material["pbrMetallicRoughness"]["metallicFactor"] == 1:
            material["pbrMetallicRoughness"]["roughnessFactor"] = roughness
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    BUILD.mkdir(parents=True, exist_ok=True)
    path = BUILD / f"glossy-room-{roughness}.glb"
    rest = data[20 + size:]
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)) + struct.pack("<I4s", len(text), b"JSON") + text + rest)
    return path


def view_of(roughness, camera="front"):
    return View(f"glossy-room-{roughness}-{camera}", with_roughness(roughness), SIZE, REFERENCE, camera)


class Point:
    """One picture: statistics, CPU seconds, and the error of its colours."""

    def __init__(self, view, *flags):
        picture = BUILD / "glossy.exr"
        self.stats = render(view, *flags, "--no-check", output=picture)
        e = error(view, picture, "")
        self.cpu, self.final = cost(self.stats), self.stats["cpu_seconds"]["final"]
        self.rmse, self.block, self.bias = e["relative_rmse"], e["block_error"], e["bias"]
        picture.unlink()


def cost_of_rays(few, many, rmse):
    """CPU seconds until rays that read irradiance come to an error: what samples do not lessen stays; infinite where that is more."""
    a, b = few.stats["samples"], many.stats["samples"]
    variance = (few.rmse ** 2 - many.rmse ** 2) / (1 / a - 1 / b)
    floor = many.rmse ** 2 - variance / b
    if not rmse ** 2 > floor:
        return math.inf
    return many.cpu - many.final + many.final / b * variance / (rmse ** 2 - floor)


def roughness_rows(roughness, series):
    view = view_of(roughness)
    path = Point(view, "--method", "path", "--spp", SAMPLES)
    rays = [Point(view, "--glossy", "rays", "--spp", samples) for samples in (SAMPLES, 4 * SAMPLES)]
    rows = [[roughness, name, "", f"{p.cpu:.1f}", percent(p.rmse), percent(p.block), f"{100 * p.bias:+.2f}", "", ""]
            for name, p in ((f"path, {SAMPLES} samples", path), (f"rays, {SAMPLES} samples", rays[0]), (f"rays, {4 * SAMPLES} samples", rays[1]))]
    curve = []
    for asked in ERRORS:
        p = Point(view, "--glossy", "auto", "--error", asked, "--spp", SAMPLES)
        gain = path.cpu * (path.rmse / p.rmse) ** 2 / p.cpu
        over_rays = cost_of_rays(*rays, p.rmse) / p.cpu
        rows.append([roughness, f"cached, error {asked}", p.stats["glossy"]["records"], f"{p.cpu:.1f}", percent(p.rmse), percent(p.block),
                     f"{100 * p.bias:+.2f}", f"{gain:.1f}", f"{over_rays:.1f}" if math.isfinite(over_rays) else "out of reach"])
        curve.append((p.cpu, p.rmse))
    series[f"cached, {roughness}"] = curve
    series[f"rays, {roughness}"] = [(p.cpu, p.rmse) for p in rays]
    return rows


def gradients():
    view = view_of(0.65, "floor")
    rows, cells = [], []
    for name, estimator in GRADIENTS.items():
        flags = ("--method", "krivanek2005b", "--glossy-estimator", estimator, "--glossy-a", 0.5, "--rays", 3200, "--error", 0.03, "--spp", 16,
                 "--secondary", "records")
        picture = BUILD / f"glossy-{name}.png"
        p = Point(view, *flags)
        render(view, *flags, "--exposure", -1, "--no-check", output=picture)
        rows.append([name, p.stats["glossy"]["records"], percent(p.rmse), percent(p.block), f"{100 * p.bias:+.2f}"])
        cells.append((name, png.read(picture)))
    picture = BUILD / "glossy-paths.png"
    render(view, "--method", "path", "--spp", REFERENCE, "--exposure", -1, output=picture)
    cells.append(("paths", png.read(picture)))
    png.sheet(ROOT / "docs" / "figures" / "glossy-gradients.png", [cells])
    return rows


def memory():
    rows = []
    for name, scene in (("glossy-room", SCENE), ("glossy-ring", ROOT / "scenes" / "glossy-ring.glb")):
        g = render(View(name, scene, "640x480", 0), "--no-check", "--spp", 1)["glossy"]
        rows.append([name, g["records"], f"{g['bands_in_the_mean']:.1f}", f"{g['rays_in_the_mean']:.0f}", f"{g['bytes'] / g['records'] / 1000:.2f}",
                     f"{g['bytes'] / 1e6:.1f}"])
    return rows


def pair():
    """Two pictures of about equal CPU time."""
    view = view_of(0.65, "floor")
    cached, paths = BUILD / "glossy-cached.png", BUILD / "glossy-path.png"
    stats = render(view, "--error", 0.05, "--spp", 16, "--exposure", -1, "--no-check", output=cached)
    one = cost(render(view, "--method", "path", "--spp", 4, output=paths)) / 4
    samples = max(1, round(cost(stats) / one))
    render(view, "--method", "path", "--spp", samples, "--exposure", -1, output=paths)
    png.sheet(ROOT / "docs" / "figures" / "glossy-equal-time.png",
              [[(f"cached, {cost(stats):.0f} s", png.read(cached)), (f"paths, {samples} samples", png.read(paths))]])
    return f"{cost(stats):.1f} CPU seconds each, {samples} samples a pixel by paths, 16 by `cached`"


def section():
    series = {}
    rows = [row for roughness in ROUGHNESSES for row in roughness_rows(roughness, series)]
    log_log(ROOT / "docs" / "figures" / "glossy.svg", "glossy room: error over CPU", "CPU seconds", "relative RMSE of the colours", series)
    return (f"## Glossy surfaces\n\n`scenes/glossy-room.glb`, all its metal of one roughness, {SIZE}, whole pictures with direct light. *rays* is `cached --glossy rays`: "
            "glossy rays followed to where they read irradiance. *gain* is the CPU to equal RMSE of path tracing over that of radiance caching, and of "
            "*rays*, whose error is continued from its two points as a constant part and one that falls with the samples:\n\n" +
            table(["roughness", "picture", "records of radiance", "CPU s", "RMSE %", "block %", "bias %", "gain over paths", "over rays"], rows) +
            "\n\n![error over CPU](figures/glossy.svg)\n\nEqual CPU time, roughness 0.65: " + pair() + ".\n\n![cached and paths](figures/glossy-equal-time.png)\n\n"
            "Gradients at equal records (method `krivanek2005b`, 3200 rays a record, roughness 0.65):\n\n" +
            table(["gradient", "records of radiance", "RMSE %", "block %", "bias %"], gradients()) +
            "\n\n![gradients](figures/glossy-gradients.png)\n\nRecords of radiance and their memory, method `cached`, 640x480:\n\n" +
            table(["scene", "records", "bands in the mean", "rays in the mean", "kB a record", "MB"], memory()))
