"""CPU to equal error against our own path tracer, as curves."""
from measure import ATRIUM, CORNELL, ROOT, Measured, percent, table
from plot import log_log

SAMPLES = 4
PATH_SAMPLES = (16, 64)
SEEDS = {"cornell-box": range(1, 9), "atrium": range(1, 4)}
# What is asked of `cached`; of it without its parts; and the thresholds and rays of `bounded`, along the lower envelope of its error over cost.
ERRORS = {"cornell-box": (0.1, 0.05, 0.03, 0.02, 0.01, 0.005), "atrium": (0.2, 0.1, 0.05, 0.03, 0.02)}
# Smaller footprints than the default's, for what an error near 1 % costs where the default's systematic part is larger than that.
FINER = {"cornell-box": (), "atrium": (("--error", 0.015, "--max-view", 0.01, "--min-pixels", 1),)}
PARTS_AT = {"cornell-box": (0.05, 0.02), "atrium": (0.1, 0.05)}
WITHOUT = {"cached, no regression": ("--regress", "off"), "cached, no cells": ("--secondary", "off"),
           "cached, neither": ("--regress", "off", "--secondary", "off")}
BOUNDED = {"cornell-box": ((0.4, 400), (0.3, 800), (0.2, 1600)), "atrium": ((0.4, 200), (0.4, 400))}


def path_points(view):
    """Path tracing, one seed, for its error is noise; beyond the last point it follows 1/sqrt(samples), being unbiased."""
    return [Measured(view, (11,), "--method", "path", "--spp", samples) for samples in PATH_SAMPLES]


def cached_points(view):
    """(method, what it was told, what came of it)"""
    flags = ("--spp", SAMPLES)
    points = [("cached", f"error {e}", Measured(view, SEEDS[view.name], "--error", e, *flags)) for e in ERRORS[view.name]]
    points += [("cached", " ".join(str(word).lstrip("-") for word in finer), Measured(view, SEEDS[view.name], *finer, *flags)) for finer in FINER[view.name]]
    points += [(name, f"error {e}", Measured(view, SEEDS[view.name], "--error", e, *without, *flags))
               for e in PARTS_AT[view.name] for name, without in WITHOUT.items()]
    points += [("bounded", f"a = {a}, {rays} rays", Measured(view, (12,), "--method", "bounded", "--a", a, "--rays", rays, *flags))
               for a, rays in BOUNDED[view.name]]
    return points


def gain(path, point, key):
    last = path[-1]
    return last.cpu * (getattr(last, key) / getattr(point, key)) ** 2 / point.cpu


def view_text(view, path, points):
    rows = []
    for method, told, p in points:
        systematic = ["" if value is None else percent(value) for value in (p.systematic_rmse, p.systematic_block)]
        rows.append([method, told, p.records, f"{p.cpu:.1f}", percent(p.rmse), systematic[0], f"{gain(path, p, 'rmse'):.0f}", percent(p.block),
                     systematic[1], f"{gain(path, p, 'block'):.1f}", f"{100 * p.bias:+.2f}"])
    series = {}
    for label, key in (("RMSE", "rmse"), ("block", "block")):
        last = path[-1]
        series[f"path, {label}"] = [(p.cpu, getattr(p, key)) for p in path] + [(last.cpu * 64, getattr(last, key) / 8)]
        for wanted in ("cached", "cached, neither", "bounded"):
            series[f"{wanted}, {label}"] = [(p.cpu, getattr(p, key)) for method, _, p in points if method == wanted]
    figure = f"equal-error-{view.name}.svg"
    log_log(ROOT / "docs" / "figures" / figure, f"{view.name}: error over CPU", "CPU seconds", "relative error", series)
    reference = "; ".join(f"{s} samples {p.cpu:.1f} s, RMSE {percent(p.rmse)}%, block {percent(p.block)}%" for s, p in zip(PATH_SAMPLES, path))
    seeds = len(SEEDS[view.name])
    return (f"### {view.name}, {view.size}\n\nPath tracing: {reference}. Cached, {SAMPLES} samples a pixel, {seeds} seeds (`bounded`: one):\n\n" +
            table(["method", "told", "records", "CPU s", "RMSE %", "systematic", "gain", "block %", "systematic", "gain", "bias %"], rows) +
            f"\n\n![error over CPU](figures/{figure})\n")


def section():
    parts = [view_text(view, path_points(view), cached_points(view)) for view in (CORNELL, ATRIUM)]
    return ("## CPU to equal error: `cached`, its parts, `bounded` and path tracing\n\n*gain* is the CPU that path tracing needs for the same error over "
            "the CPU of the cached render; the path tracer's line is continued from its last point by its 1/sqrt(samples). *systematic* is the part of "
            "the error before it that pictures of different seeds have in common.\n\n" + "\n".join(parts))
