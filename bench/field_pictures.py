"""Sections 0, 1 and 5 of docs/comparison.md."""
import json
import subprocess

import png
from equal_records import PROGRAM
from measure import View, cost, error, percent, render, table
from plot import linear, log_log

ESTIMATORS = ("ward-heckbert-exact", "surface-area-hessian", "triangulated-open", "triangulated", "swept-edges")
RAYS = (100, 1156, 4356)


def shown(results, path, text):
    return f"![{text}]({path.relative_to(results.page.parent)})"


def line(results):
    """Extrapolation along a line through a penumbra."""
    found = json.loads(subprocess.run([PROGRAM, "line"], check=True, capture_output=True, text=True).stdout)
    along, totals = found["line"], found["total"]
    values = [row[1] for row in along]
    names = ("irradiance", "first order", "second order")
    curves = {name: [(row[0], row[i + 1]) for row in along] for i, name in enumerate(names)}
    curves["the record"] = [(found["x"], found["value"])]
    first, second = results.figures / "line.svg", results.figures / "line-total-error.svg"
    linear(first, "through a penumbra", "x", "irradiance", curves, (0.5 * min(values), 1.3 * max(values)))
    names = ("first order", "second order", "|H| R^3 / 3")
    log_log(second, "total error over [-R, R]", "R", "integral of |error|",
            {name: [(row[0], row[i + 1]) for row in totals] for i, name in enumerate(names)})
    return ("## 0. Extrapolation along a line\n\nIrradiance of section 1's plane along y = 1.45, through the penumbra of the lower square, and what a "
            f"record at x = {found['x']} with the exact derivatives makes of it. To first order the total error follows |H| R³ / 3 until the "
            f"line's shape changes within reach: at most {found['allowed']:g} of it allows R = (3 eps / |H|)^(1/3) = {found['radius']:.3f}.\n\n"
            f"{shown(results, first, 'irradiance and its extrapolations')} {shown(results, second, 'total errors')}\n")


def derivatives(results):
    """Gradients and Hessians under two occluders."""
    folder = results.folder / "derivatives"
    printed = folder / "errors.jsonl"
    if not printed.exists():
        folder.mkdir(parents=True, exist_ok=True)
        out = subprocess.run([PROGRAM, "derivatives", folder], check=True, capture_output=True, text=True).stdout
        printed.write_text(out)
    errors = {(row["estimator"], row["rays"]): row for row in map(json.loads, printed.read_text().splitlines())}
    quantities = ("gradient", "greater", "lesser")
    cells = [[(f"exact {name}", png.read(folder / f"exact-{name}.png")) for name in quantities]]
    for estimator in ESTIMATORS:
        row = []
        for rays in RAYS:
            for name in quantities:
                path = folder / f"{estimator}-{rays}-{name}.png"
                label = f"{estimator} {rays}" if name == "gradient" else ""
                row.append((label, png.read(path)) if path.exists() else None)
        cells.append(row)
    path = results.figures / "derivatives.png"
    png.sheet(path, cells)

    def numbers(row, quantity):
        return " / ".join(f"{100 * row[quantity][key]:.0f}" for key in ("rms", "median")) if row[quantity] else "-"

    header = ["estimator"] + [f"{quantity}, {rays:,} rays" for quantity in ("gradient", "Hessian") for rays in RAYS]
    rows = [[name] + [numbers(errors[name, rays], quantity) for quantity in ("gradient", "hessian") for rays in RAYS] for name in ESTIMATORS]
    return ("## 1. Derivatives of irradiance under two occluders\n\nA plane of 4 x 4 under a bright square in a dim ceiling, 3 high; a black square at "
            "0.8 and one at 1.7 cast shadows that overlap. Length of the gradient (dark to bright), greater and lesser eigenvalue of the Hessian (blue "
            "below 0, red above, by the root of their size); exact above (polygons clipped by shadows, finite differences), then each estimator "
            f"at {', '.join(f'{r:,}' for r in RAYS)} rays a place.\n\n{shown(results, path, 'derivatives by each estimator')}\n\n"
            "Errors in %: root mean square over the plane, relative to the exact derivatives' own / median of the places' own relative errors. No "
            "Hessian made of hit points sees how the visible length of a shadow's edge changes where it crosses the edge of the emitter behind it: "
            "the dark frames of the exact pictures, which most of the root mean square is made of.\n\n" + table(header, rows) + "\n")


def against_path_tracing(results):
    """A picture of a million pixels."""
    side, samples, reference = (256, 16, 32) if results.trial else (1024, 128, 32)
    view = View("cornell-box", "cornell-box.glb", f"{side}x{side}", reference)
    kept = results.folder / f"million-{side}.json"
    if not kept.exists():
        # The threshold is found first, so that what is timed is one build.
        solved = render(view, "--method", "swept", "--records", 4000, "--no-check", "--spp", 16)
        rows = {}
        for name, flags in {"swept": ("--method", "swept", "--a", solved["parameters"]["a"], "--no-check", "--spp", 16),
                            "path": ("--method", "path", "--spp", samples)}.items():
            picture = results.folder / f"million-{name}.exr"
            stats = render(view, *flags, "-o", str(picture.with_suffix(".png")), "--exposure", 0, output=picture)
            rows[name] = {"cpu": cost(stats), "wall": stats["wall_seconds"]["build"] + stats["wall_seconds"]["final"], "records": stats["records"] if name == "swept" else None,
                          "colour": error(view, picture, ""), "irradiance": error(view, picture)}
        kept.write_text(json.dumps(rows))
    rows = json.loads(kept.read_text())
    names = {"swept": "`swept`, 16 samples a pixel", "path": f"path tracing, {samples} paths a pixel"}
    pictures = {name: png.read(results.folder / f"million-{name}.png") for name in names}
    part = side // 4
    cells = [[(names[name].strip("`").replace("`", ""), png.shrink(picture, max(1, side // 256)))] +
             [("", png.crop(picture, x, y, part // 2, part // 2, 512 // part)) for x, y in ((side // 8, side // 2), (side // 2, side * 5 // 8))]
             for name, picture in pictures.items()]
    path = results.figures / "million.png"
    png.sheet(path, cells)
    lines = [[names[name], rows[name]["records"] or "-", f"{rows[name]['cpu']:.0f}", f"{rows[name]['wall']:.0f}"] +
             [percent(rows[name][layer][key]) for layer in ("colour", "irradiance") for key in ("relative_rmse", "block_error")] for name in names]
    return (f"## 5. {side ** 2:,} pixels against path tracing\n\nCornell box, {side}x{side}, 800 rays a record.\n\n" +
            table(["", "records", "CPU s", "s", "RMSE %", "block %", "irradiance: RMSE %", "block %"], lines) +
            f"\n\n{shown(results, path, 'the pictures and parts of them')}\n")
