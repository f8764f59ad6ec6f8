"""CPU to equal error against our own path tracer, as curves."""
from measure import ATRIUM, CORNELL, ROOT, cost, measured, percent, table
from plot import log_log

SAMPLES = 16
PATH_SAMPLES = (16, 64)
# Thresholds and gather rays of the cached renders: a walk along the lower envelope of error over cost.
SETTINGS = {"cornell-box": ((0.4, 200), (0.3, 400), (0.3, 800), (0.2, 800), (0.2, 1600), (0.2, 3200), (0.14, 3200)),
            "atrium": ((0.4, 200), (0.3, 200), (0.2, 200), (0.2, 400), (0.15, 400), (0.15, 800))}
MEASURES = (("RMSE", "relative_rmse"), ("block", "block_error"))


def path_points(view, layer):
    """(CPU, error by measure) of path tracing; beyond the last it follows 1/sqrt(samples), being unbiased."""
    points = []
    for samples in PATH_SAMPLES:
        stats, errors = measured(view, "--method", "path", "--spp", samples, "--seed", 11, layers=(layer,))
        points.append((cost(stats), errors[layer]))
    return points


def gain(path, cpu, measure, value):
    path_cpu, path_error = path[-1]
    return path_cpu * (path_error[measure] / value) ** 2 / cpu


def view_text(view, layer):
    path = path_points(view, layer)
    rows, curves = [], {label: [] for label, _ in MEASURES}
    for a, rays in SETTINGS[view.name]:
        stats, errors = measured(view, "--method", "cached", "--a", a, "--rays", rays, "--spp", SAMPLES, "--seed", 12, layers=(layer,))
        e, cpu = errors[layer], cost(stats)
        rows.append([a, rays, stats["records"], f"{cpu:.1f}"] +
                    [cell for _, key in MEASURES for cell in (percent(e[key]), f"{gain(path, cpu, key, e[key]):.1f}")] +
                    [f"{100 * e['bias']:+.2f}"])
        for label, key in MEASURES:
            curves[label].append((cpu, e[key]))
    series = {}
    for label, key in MEASURES:
        series[f"path, {label}"] = [(c, e[key]) for c, e in path] + [(path[-1][0] * 64, path[-1][1][key] / 8)]
        series[f"cached, {label}"] = curves[label]
    figure = f"equal-error-{view.name}-{layer}.svg"
    log_log(ROOT / "docs" / "figures" / figure, f"{view.name}, {layer}: error over CPU", "CPU seconds", "relative error", series)
    path_rows = [f"{s} samples: {c:.1f} s, RMSE {percent(e['relative_rmse'])}%, block {percent(e['block_error'])}%"
                 for s, (c, e) in zip(PATH_SAMPLES, path)]
    best = {label: max(float(row[5 + 2 * i]) for row in rows) for i, (label, _) in enumerate(MEASURES)}
    return (f"### {view.name}, `{layer}` layer, {view.size}\n\nPath tracing: {'; '.join(path_rows)}. Cached, {SAMPLES} samples a pixel:\n\n" +
            table(["a", "rays", "records", "CPU s", "RMSE %", "gain", "block %", "gain", "bias %"], rows) +
            f"\n\nLargest gain: {best['RMSE']:.0f} times at equal RMSE, {best['block']:.1f} times at equal block error.\n\n"
            f"![error over CPU](figures/{figure})\n")


def section():
    parts = [view_text(view, layer) for view in (CORNELL, ATRIUM) for layer in ("irradiance", "indirect")]
    return ("## CPU to equal error, against path tracing\n\n*gain* is the CPU that path tracing needs for the same error over the CPU of the "
            "cached render.\n\n" + "\n".join(parts))
