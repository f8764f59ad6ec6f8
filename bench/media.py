"""Participating media: cached pictures against paths on four scenes, what they take, and threads."""
import png
from measure import BUILD, ROOT, Point, View, cost, percent, render, table
from plot import log_log

SIZE = "512x384"
SCENES = ("fog-spot", "sun-window", "plume", "cornell-fog")
REFERENCE = 192  # samples of each half
SAMPLES = 64  # of the paths that are compared
ERRORS = ((0.1, 16), (0.05, 32), (0.03, 64))  # and the samples that go with them
PAIRS = 3


class MediaPoint(Point):
    @staticmethod
    def records_of(stats):
        return sum(stats["media"]["records"].values()) if "media" in stats else None


def view_of(scene, size=SIZE):
    return View(scene, f"{scene}.toml", size, REFERENCE)


def equal_error(scene, series):
    view = view_of(scene)
    path = MediaPoint(view, "--method", "path", "--spp", SAMPLES)
    rows = [[*path.row(scene, f"path, {SAMPLES} samples"), ""]]
    curve, points = [], []
    for asked, samples in ERRORS:
        p = MediaPoint(view, "--error", asked, "--spp", samples)
        rows.append([*p.row(scene, f"cached, error {asked}, {samples} samples"), f"{path.cpu * (path.rmse / p.rmse) ** 2 / p.cpu:.1f}"])
        curve.append((p.cpu, p.rmse))
        points.append(p)
    series[f"{scene}, cached"] = curve
    series[f"{scene}, paths"] = [(path.cpu * s, path.rmse / s ** 0.5) for s in (0.25, 1, 4, 16)]
    return rows, points


def shown(view, name, *flags):
    picture = BUILD / "media.png"
    stats = render(view, *flags, "--no-check", output=picture)
    return cost(stats), png.read(picture)


def pair(scene):
    """Two pictures of about equal CPU time."""
    view = view_of(scene)
    seconds, cached = shown(view, "cached", "--error", 0.05, "--spp", 16)
    one = cost(render(view, "--method", "path", "--spp", 4, output=BUILD / "media.png")) / 4
    samples = max(1, round(seconds / one))
    _, paths = shown(view, "paths", "--method", "path", "--spp", samples)
    return [(f"{scene}, cached, {seconds:.0f} s", cached), (f"paths, {samples} samples", paths)]


def phases(scene, point):
    stats = point.stats
    rays, media, seconds = stats["rays"], stats["media"], stats["cpu_seconds"]
    kinds = [f"{rays[kind] / 1e6:.1f}" for kind in ("camera", "path", "gather", "shadow", "verification")]
    return [scene, f"{seconds['build']:.1f}", f"{seconds['final']:.1f}", stats["records"], media["records"]["surfaces"], media["records"]["media"],
            f"{media['bytes'] / 1e6:.2f}", f"{stats['peak_memory_bytes'] / 1e6:.0f}", *kinds]


def growth(scene):
    """Of summed CPU time from one thread to two, in percent: the median and the range of pairs."""
    found = []
    for _ in range(PAIRS):
        one, two = (render(view_of(scene, "192x144"), "--error", 0.1, "--spp", 16, "--no-check", "--threads", n) for n in (1, 2))
        found.append(100 * (cost(two) / cost(one) - 1))
    found.sort()
    return [scene, f"{found[PAIRS // 2]:+.1f}", f"{found[0]:+.1f} to {found[-1]:+.1f}"]


def section():
    series, rows, sheet, phase_rows = {}, [], [], []
    for scene in SCENES:
        some, points = equal_error(scene, series)
        rows += some
        phase_rows.append(phases(scene, points[1]))
        sheet.append(pair(scene))
    log_log(ROOT / "docs" / "figures" / "media.svg", "media: error over CPU", "CPU seconds", "relative RMSE of the colours", series)
    png.sheet(ROOT / "docs" / "figures" / "media-equal-time.png", sheet)
    asked, samples = ERRORS[1]
    parts = (
        f"Four scenes, {SIZE}, whole pictures with direct light and single scattering. *gain* is the CPU to equal RMSE of path tracing over that of "
        "`cached`:",
        table(["scene", "picture", "records in media", "CPU s", "RMSE %", "block %", "bias %", "gain"], rows),
        "![error over CPU](figures/media.svg)", "About equal CPU time (error 0.05, 16 samples); the figure has 256 colours for all, which draws contours in smooth parts:", "![cached and paths](figures/media-equal-time.png)",
        f"What `cached` takes at error {asked} and {samples} samples; rays in millions:",
        table(["scene", "build, CPU s", "final, CPU s", "records of surfaces", "of their light in media", "of media's light", "MB of the latter two",
               "MB in all", "camera", "path", "gather", "shadow", "verification"], phase_rows),
        f"CPU growth from 1 to 2 threads at 192x144, medians and ranges of {PAIRS} pairs:",
        table(["scene", "growth %", "range %"], [growth(scene) for scene in SCENES]))
    return "## Participating media\n\n" + "\n\n".join(parts)
