"""Glossy surfaces: radiance caching against paths and against rays that read irradiance alone; its gradients; its memory."""
import json
import math
import struct
import subprocess

import png
from measure import BUILD, PROGRAM, ROOT, Point, View, cost, percent, render, table
from plot import log_log

SCENE = ROOT / "scenes" / "glossy-room.glb"
ROUGHNESSES = (0.55, 0.65, 0.8)  # of all metal in the scene; GGX alpha is the square
SIZE, REFERENCE = "512x384", 256
SAMPLES = 64
ERRORS = ((0.1, 32), (0.05, 64), (0.03, 64), (0.02, 128))  # and the samples that go with them
SEEDS = (1, 2, 3)
ANGLES = ("0", "45", "75")
RAMP = ROOT / "scenes" / "glossy-ramp.glb"
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


class GlossyPoint(Point):
    @staticmethod
    def records_of(stats):
        return stats["glossy"]["records"] if stats.get("glossy") else None


HEADER = ("records of radiance", "CPU s", "RMSE %", "block %", "bias %")


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
    path = GlossyPoint(view, "--method", "path", "--spp", SAMPLES)
    rays = [GlossyPoint(view, "--glossy", "rays", "--spp", samples) for samples in (SAMPLES, 4 * SAMPLES)]
    rows = [[*p.row(roughness, name), "", ""]
            for name, p in ((f"path, {SAMPLES} samples", path), (f"rays, {SAMPLES} samples", rays[0]), (f"rays, {4 * SAMPLES} samples", rays[1]))]
    curve = []
    for asked, samples in ERRORS:
        p = GlossyPoint(view, "--glossy", "auto", "--error", asked, "--spp", samples, seeds=SEEDS)
        gain = path.cpu * (path.rmse / p.rmse) ** 2 / p.cpu
        over_rays = cost_of_rays(*rays, p.rmse) / p.cpu
        rows.append([*p.row(roughness, f"cached, error {asked}, {samples} samples"), f"{gain:.1f}",
                     f"{over_rays:.1f}" if math.isfinite(over_rays) else "out of reach"])
        curve.append((p.cpu, p.rmse))
    series[f"cached, {roughness}"] = curve
    series[f"rays, {roughness}"] = [(p.cpu, p.rmse) for p in rays]
    return rows


def shown(view, name, *flags):
    """A picture for a sheet."""
    picture = BUILD / f"glossy-{name}.png"
    render(view, *flags, "--exposure", -1, "--no-check", output=picture)
    return name, png.read(picture)


def gradients():
    view = view_of(0.65, "floor")
    rows, cells = [], []
    for name, estimator in GRADIENTS.items():
        flags = ("--method", "krivanek2005b", "--glossy-estimator", estimator, "--glossy-a", 0.5, "--rays", 3200, "--error", 0.03, "--spp", 16,
                 "--secondary", "records")
        rows.append(GlossyPoint(view, *flags).row(name))
        cells.append(shown(view, name, *flags))
    cells.append(shown(view, "paths", "--method", "path", "--spp", REFERENCE))
    png.sheet(ROOT / "docs" / "figures" / "glossy-gradients.png", [cells])
    return rows


def adaptive():
    """Radii that adapt, against as many records of smaller ones that do not."""
    view = view_of(0.65, "floor")
    flags = ("--method", "krivanek2006", "--rays", 3200, "--error", 0.03, "--spp", 16, "--secondary", "records")
    return [GlossyPoint(view, *flags, "--glossy-contrast", contrast, "--glossy-a", a).row(contrast, a) for contrast, a in ((0, 0.5), (0.1, 0.5), (0, 0.44))]


def windows():
    view = view_of(0.65, "floor")
    return [GlossyPoint(view, "--error", 0.03, "--spp", 32, "--glossy-window", window).row(window) for window in ("off", "on")]


def lobes():
    """What so many bands miss of a metal's lobe, and the rule."""
    rows = []
    for roughness, of in json.loads(subprocess.run([str(PROGRAM.parent / "bench_lobes")], check=True, capture_output=True, text=True).stdout).items():
        missed = [" / ".join(f"{100 * of[angle][bands]:.1f}" for angle in ANGLES) for bands in ("4", "6", "8", "10", "12")]
        rows.append([roughness, *missed, of["bands"] or "rays", " / ".join(f"{of[angle]['share']:.2f}" for angle in ANGLES)])
    return rows


def ramp():
    """From rays to records along a floor: the block error, and two pictures."""
    view = View("glossy-ramp", RAMP, SIZE, REFERENCE, "front")
    cells = [shown(view, "cached", "--error", 0.02, "--spp", REFERENCE), shown(view, "paths", "--method", "path", "--spp", 4 * REFERENCE)]
    png.sheet(ROOT / "docs" / "figures" / "glossy-ramp.png", [cells])
    return [GlossyPoint(view, "--error", 0.02, "--spp", SAMPLES, "--glossy", source).row(source) for source in ("rays", "auto", "cache")]


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
    parts = (
        f"`scenes/glossy-room.glb`, all its metal of one roughness, {SIZE}, whole pictures with direct light; `cached` in the mean over {len(SEEDS)} seeds, "
        "the others of one. *rays* is `cached --glossy rays`: glossy rays followed to where they read irradiance. *gain* is the CPU to equal RMSE of path "
        "tracing over that of radiance caching, and of *rays*, whose error is continued from its two points as a constant part and one that falls with the "
        "samples:", table(["roughness", "picture", *HEADER, "gain over paths", "over rays"], rows), "![error over CPU](figures/glossy.svg)",
        "Equal CPU time, roughness 0.65: " + pair() + ".", "![cached and paths](figures/glossy-equal-time.png)",
        "Gradients at equal records (method `krivanek2005b`, 3200 rays a record, roughness 0.65):", table(["gradient", *HEADER], gradients()),
        "![gradients](figures/glossy-gradients.png)",
        "Adaptive radii (method `krivanek2006`, 3200 rays a record, roughness 0.65), and about as many records of a smaller threshold without them. Block error falls by a tenth, RMSE, of which most is noise of samples, does not:",
        table(["contrast", "a", *HEADER], adaptive()),
        "Hanning's window (`--glossy-window`), roughness 0.65: the rule leaves little that rings, and the window takes more than that.",
        table(["window", *HEADER], windows()),
        "What so many bands of hemispherical harmonics miss of a metal's lobe, seen at 0 / 45 / 75 degrees from the normal, in % of its root mean square, and "
        "what `--glossy auto` makes of it: bands, and the share that records say:",
        table(["roughness", "4 bands", "6", "8", "10", "12", "auto: bands", "share"], lobes()),
        "From rays to records: the floor of `scenes/glossy-ramp.glb`, whose roughness grows from 0.35 at the left to 0.75 at the right (error 0.02):",
        table(["glossy lobes by", *HEADER], ramp()), "![cached and paths](figures/glossy-ramp.png)",
        "Records of radiance and their memory, method `cached`, 640x480:",
        table(["scene", "records", "bands in the mean", "rays in the mean", "kB a record", "MB"], memory()))
    return "## Glossy surfaces\n\n" + "\n\n".join(parts)
