"""CPU to equal error against our own path tracer, as curves."""
from measure import ATRIUM, CORNELL, ROOT, cost, measured, percent, table
from plot import log_log

SAMPLES = 16
PATH_SAMPLES = (16, 64)
# What is asked of `cached`, and the thresholds and rays of `bounded`, along the lower envelope of its error over cost.
ERRORS = {"cornell-box": (0.1, 0.05, 0.03, 0.02, 0.01), "atrium": (0.2, 0.1, 0.05, 0.03)}
BOUNDED = {"cornell-box": ((0.4, 400), (0.3, 800), (0.2, 1600), (0.2, 3200)), "atrium": ((0.4, 200), (0.4, 400), (0.3, 800))}
MEASURES = (("RMSE", "relative_rmse"), ("block", "block_error"))
LAYERS = ("irradiance", "indirect")


def path_points(view):
    """(CPU, errors by layer) of path tracing; beyond the last it follows 1/sqrt(samples), being unbiased."""
    points = []
    for samples in PATH_SAMPLES:
        stats, errors = measured(view, "--method", "path", "--spp", samples, "--seed", 11, layers=LAYERS)
        points.append((cost(stats), errors))
    return points


def cached_points(view):
    """(method, what it was told, statistics, errors by layer) of the cached renders."""
    settings = [("cached", f"error {e}", ("--error", e)) for e in ERRORS[view.name]]
    settings += [("bounded", f"a = {a}, {rays} rays", ("--a", a, "--rays", rays)) for a, rays in BOUNDED[view.name]]
    return [(method, told, *measured(view, "--method", method, *flags, "--spp", SAMPLES, "--seed", 12, layers=LAYERS))
            for method, told, flags in settings]


def gain(path, layer, cpu, key, value):
    path_cpu, errors = path[-1]
    return path_cpu * (errors[layer][key] / value) ** 2 / cpu


def layer_text(view, layer, path, cached):
    rows, best = [], {label: 0 for label, _ in MEASURES}
    for method, told, stats, errors in cached:
        e, cpu, cells = errors[layer], cost(stats), []
        for label, key in MEASURES:
            times = gain(path, layer, cpu, key, e[key])
            if method == "cached":
                best[label] = max(best[label], times)
            cells += [percent(e[key]), f"{times:.1f}"]
        rows.append([method, told, stats["records"], f"{cpu:.1f}", *cells, f"{100 * e['bias']:+.2f}"])
    series = {}
    for label, key in MEASURES:
        last_cpu, last = path[-1]
        series[f"path, {label}"] = [(c, e[layer][key]) for c, e in path] + [(last_cpu * 64, last[layer][key] / 8)]
        for wanted in ("cached", "bounded"):
            series[f"{wanted}, {label}"] = [(cost(stats), errors[layer][key]) for method, _, stats, errors in cached if method == wanted]
    figure = f"equal-error-{view.name}-{layer}.svg"
    log_log(ROOT / "docs" / "figures" / figure, f"{view.name}, {layer}: error over CPU", "CPU seconds", "relative error", series)
    reference = "; ".join(f"{s} samples {c:.1f} s, RMSE {percent(e[layer]['relative_rmse'])}%, block {percent(e[layer]['block_error'])}%"
                          for s, (c, e) in zip(PATH_SAMPLES, path))
    return (f"### {view.name}, `{layer}` layer, {view.size}\n\nPath tracing: {reference}. Cached, {SAMPLES} samples a pixel:\n\n" +
            table(["method", "told", "records", "CPU s", "RMSE %", "gain", "block %", "gain", "bias %"], rows) +
            f"\n\nLargest gain of `cached`: {best['RMSE']:.0f} times at equal RMSE, {best['block']:.1f} times at equal block error.\n\n"
            f"![error over CPU](figures/{figure})\n")


def section():
    parts = []
    for view in (CORNELL, ATRIUM):
        path, cached = path_points(view), cached_points(view)
        parts += [layer_text(view, layer, path, cached) for layer in LAYERS]
    return ("## CPU to equal error: `cached`, `bounded` and path tracing\n\n*gain* is the CPU that path tracing needs for the same error over the CPU of the "
            "cached render; the path tracer's line is continued from its last point by its 1/sqrt(samples).\n\n" + "\n".join(parts))
