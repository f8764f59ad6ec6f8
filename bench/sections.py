"""The other sections of docs/benchmarks.md."""
import json
import statistics
import subprocess
import time

from measure import ATRIUM, BUILD, CORNELL, ROOT, View, cost, measured, percent, render, table
from plot import log_log

REPEATS = 5
SHADOW = View("contact-shadow", "contact-shadow.glb", "256x256", 0)
MODEST = ("--error", 0.1)  # where it is not the error that counts


def median(values):
    return statistics.median(values)


def records():
    """Error against records and against rays per record, by what gathers read."""
    by_records, by_rays, series = [], [], {}
    for secondary in ("records", "cells", "off"):
        curve = []
        for number in (500, 1000, 2000, 4000, 8000):
            stats, e = measured(CORNELL, "--secondary", secondary, "--records", number, "--spp", 16)
            by_records.append([secondary, stats["records"], f"{stats['parameters']['a']:.3f}", percent(e["relative_rmse"]),
                               percent(e["block_error"]), f"{100 * e['bias']:+.2f}"])
            curve.append((stats["records"], e["relative_rmse"]))
        series[f"secondary {secondary}"] = curve
        for rays in (200, 400, 800, 1600, 3200):
            stats, e = measured(CORNELL, "--secondary", secondary, "--a", 0.2, "--rays", rays, "--spp", 16)
            by_rays.append([secondary, rays, stats["records"], f"{cost(stats):.1f}", percent(e["relative_rmse"]),
                            percent(e["block_error"]), f"{100 * e['bias']:+.2f}"])
    log_log(ROOT / "docs" / "figures" / "error-records.svg", "cornell-box: RMSE over records", "records", "relative RMSE", series)
    return ("## Error against records and rays\n\nCornell box, method `cached`, 800 rays a record:\n\n" +
            table(["secondary", "records", "a", "RMSE %", "block %", "bias %"], by_records) +
            "\n\n![RMSE over records](figures/error-records.svg)\n\nThe same at a = 0.2, by rays per record:\n\n" +
            table(["secondary", "rays", "records", "CPU s", "RMSE %", "block %", "bias %"], by_rays))


def order():
    """Surplus records of the rounds over the lazy order."""
    rows = []
    for view in (CORNELL, ATRIUM):
        for method in ("ward1992", "cached"):
            flags = ("--method", method, "--a", 0.3, "--rays", 200, "--secondary", "off", "--no-check")
            rounds = render(view, *flags, "--spp", 16)
            # Ward's order covers what it renders: as many samples of each pixel as the rounds went through.
            lazy = render(view, *flags, "--spp", min(16, rounds["passes"]), "--order", "lazy")
            found = {"rounds": rounds["records"], "lazy": lazy["records"], "passes": rounds["passes"]}
            rows.append([view.name, method, found["passes"], found["rounds"], found["lazy"], f"{100 * (found['rounds'] / found['lazy'] - 1):+.1f}"])
    return ("## Surplus records of the rounds over Ward's order\n\na = 0.3, 200 rays; both cover the same samples of each pixel:\n\n" +
            table(["scene", "method", "samples", "rounds", "lazy", "surplus %"], rows))


def leaks():
    """What the leak test costs, and what is left of a leak where one cache serves both sides of a thin wall."""
    costs, biases = [], []
    for view, wanted in ((view, wanted) for view in (CORNELL, ATRIUM, SHADOW) for wanted in (0.1, 0.03)):
        growth = []
        for i in range(REPEATS):
            order = ("on", "off") if i % 2 else ("off", "on")
            # Without the test no records are fitted: with it they are not either, for it is the test that is measured.
            stats = {test: render(view, "--error", wanted, "--leak-test", test, "--regress", "off", "--no-check") for test in order}
            growth.append(cost(stats["on"]) / cost(stats["off"]) - 1)
        on, off = stats["on"], stats["off"]
        costs.append([view.name, wanted, f"{100 * median(growth):+.1f}", f"{100 * min(growth):+.1f} to {100 * max(growth):+.1f}", off["records"],
                      on["records"], f"{100 * on['rays']['verification'] / on['rays']['total']:.1f}"])
    bright, dark = (View(f"thin-wall-{side}", "thin-wall.glb", "256x192", 256, side) for side in ("bright", "dark"))
    records = BUILD / "bright.records"
    for test in ("off", "on"):
        flags = (*MODEST, "--leak-test", test, "--no-check")
        render(bright, *flags, "--save-cache", records)
        stats, e = measured(dark, *flags, "--load-cache", records)
        biases.append([test, stats["records"], f"{100 * e['bias']:+.1f}", percent(e["relative_rmse"]), percent(e["block_error"])])
    records.unlink()
    return (f"## Leaks\n\nCPU seconds of build and final pass with the leak test over those without, records not fitted, medians and ranges of {REPEATS} "
            "pairs, and the rays it casts as a share of all:\n\n" +
            table(["scene", "asked error", "growth %", "range %", "records without", "records with", "rays %"], costs) +
            "\n\nThe dark room of `scenes/thin-wall.glb`, 2 cm from one lit twenty times as brightly, rendered with the records of both:\n\n" +
            table(["leak test", "records", "bias %", "RMSE %", "block %"], biases))


def scaling():
    """Threads and pixels."""
    rows = []
    for view in (CORNELL, ATRIUM):
        growth, speedup, serial = [], [], []
        for _ in range(REPEATS):
            one, two = (render(view, "--threads", n, *MODEST, "--no-check", "--spp", 16) for n in (1, 2))
            growth.append(cost(two) / cost(one) - 1)
            wall = [s["wall_seconds"]["build"] + s["wall_seconds"]["final"] for s in (one, two)]
            speedup.append(wall[0] / wall[1])
            serial.append(2 * wall[1] / wall[0] - 1)  # Amdahl's law for two threads
        rows.append([view.name, f"{100 * median(growth):+.1f}", f"{median(speedup):.2f}", f"{100 * median(serial):.1f}"])
    pixels = []
    for view in (CORNELL, ATRIUM):
        width, height = map(int, view.size.split("x"))
        small, large = (render(View(view.name, view.scene.name, f"{width * s}x{height * s}", 0), *MODEST, "--no-check")["records"]
                        for s in (1, 2))
        pixels.append([view.name, small, large, f"{large / small:.2f}"])
    return (f"## Threads and pixels\n\nCPU growth and wall ratio from 1 to 2 threads for an error of 0.1, medians of {REPEATS} pairs; the serial share is what "
            "Amdahl's law makes of the wall ratio, waiting for a busy machine included:\n\n" +
            table(["scene", "CPU growth %", "wall ratio", "serial share %"], rows) +
            "\n\nRecords of `cached` for an error of 0.1, 16 samples a pixel, by picture size:\n\n" +
            table(["scene", "records", "records at 4x the pixels", "ratio"], pixels))


ASKED = (0.1, 0.05, 0.02, 0.01, 0.005)
ASKED_SCENES = {"cornell-box": "cornell-box.glb", "contact-shadow": "contact-shadow.glb", "gallery": "gallery.glb", "sphere": "sphere.glb",
                "corner": "corner.glb", "plate": "plate.toml", "back-wall": "back-wall.glb", "thin-wall": "thin-wall.glb", "atrium": "atrium.glb"}
LEAST_ASKED = {"atrium": 0.02, "gallery": 0.01, "contact-shadow": 0.01}  # below, a render takes many minutes here


def asked():
    """Asked and measured error over the project's scenes."""
    rows, series, within, cells = [], {}, 0, 0
    for name, scene in ASKED_SCENES.items():
        view, curve = View(name, scene, "192x192" if name != "atrium" else "192x120", 0), []
        for wanted in ASKED:
            if wanted < LEAST_ASKED.get(name, 0):
                continue
            stats = render(view, "--error", wanted, "--spp", 4)
            e = stats["error"]
            curve.append((wanted, e["mean"]))
            cells += 1
            within += 1 / 1.5 <= e["mean"] / wanted <= 1.5
            rows.append([name, wanted, f"{e['mean']:.4f}", f"{e['mean'] / wanted:.2f}", f"{e['median']:.4f}", f"{e['p95']:.3f}", f"{e['noise']:.4f}",
                         e["points"], stats["records"], round(stats["parameters"]["rays_in_the_mean"]), f"{cost(stats):.1f}"])
        series[name] = curve
    series["asked"] = [(x, x) for x in (ASKED[-1], ASKED[0])]
    log_log(ROOT / "docs" / "figures" / "asked-measured.svg", "measured over asked error", "asked", "measured mean", series)
    return ("## Asked and measured error\n\nMethod `cached`, 192 pixels wide: `--error` is what is asked, *mean* what the run measures at random visible "
            "points, *noise* the measurement's own, which the mean contains. "
            f"{within} of {cells} means are within a factor 1.5 of what was asked.\n\n" +
            table(["scene", "asked", "mean", "mean / asked", "median", "95th percentile", "noise", "points", "records", "rays a record", "CPU s"], rows) +
            "\n\n![measured over asked error](figures/asked-measured.svg)")


def refine():
    """What refinements do where the measured error is above the asked one."""
    rows = []
    for name, wanted in (("back-wall", 0.02), ("gallery", 0.02), ("atrium", 0.1)):
        view = View(name, ASKED_SCENES[name], "192x192" if name != "atrium" else "192x120", 0)
        for times in (0, 1, 2):
            stats = render(view, "--error", wanted, "--spp", 4, "--refine", times)
            e = stats["error"]
            rows.append([name, wanted, times, stats["refinements"], f"{e['mean']:.4f}", f"{e['noise']:.4f}", stats["records"], f"{cost(stats):.1f}"])
    return ("## Refinement\n\nWith `--refine N`, as above. A refinement is made only where the measured mean, less the measurement's own noise, is above what "
            "was asked, and is measured at other points:\n\n" +
            table(["scene", "asked", "N", "refinements made", "mean", "noise", "records", "CPU s"], rows))


def rays():
    """What rays, lookups and records cost beside the bare Embree loop."""
    rows = []
    for view in (CORNELL, ATRIUM):
        out = subprocess.run([str(ROOT / "build" / "release" / "bench_rays"), str(view.scene)], check=True, capture_output=True, text=True)
        for name, value in json.loads(out.stdout).items():
            number = value["millions_per_second"]
            rows.append([view.name, name, f"{number:.2f}" if number > 0.1 else f"{number:.5f}", f"{1 / number:.2f}", f"{1 / value['of_bare']:.2f}"])
    return ("## Cost of rays, lookups and records beside bare Embree\n\nOne thread. *bare* casts camera rays and three cosine bounces, each with a "
            "shadow ray, and does nothing else. *path*, the gathers and *final* are per ray, of whatever kind, with all that is done for it: "
            "*gather_records* reads records and cells where it hits, *gather_cells* cells, *gather_paths* follows paths; *final* is the last pass. "
            "*lookup* is one interpolation in the finished cache, without rays of the leak test, for each pixel in turn or in random "
            "order; *record* is one of method `cached`, its gather and all, where the cache is nearly finished. Medians of 7 rounds; the last column is paired within each round:\n\n" +
            table(["scene", "part", "millions a CPU second", "CPU microseconds each", "times a bare ray"], rows))


def estimators():
    """What each estimator costs beside its gather."""
    rows = []
    for view in (CORNELL, ATRIUM):
        for number in (800, 3200):
            out = subprocess.run([str(ROOT / "build" / "release" / "bench_estimators"), str(view.scene), str(number)], check=True, capture_output=True,
                                 text=True)
            for name, value in json.loads(out.stdout).items():
                share = f"{100 * value['of_gather']:.1f}" if "of_gather" in value else ""
                rows.append([view.name, number, name, f"{value['microseconds']:.0f}", share])
    return ("## Cost of a record by estimator\n\nOne thread, 64 random places, medians of 7 rounds; the gather follows paths, and the share is paired "
            "within each round:\n\n" + table(["scene", "rays", "part", "CPU microseconds a record", "% of the gather"], rows))


def demo():
    """What scripts/demo takes once it is built."""
    before = time.monotonic()
    subprocess.run([str(ROOT / "scripts" / "demo")], check=True, stdout=subprocess.DEVNULL)
    wall = time.monotonic() - before
    stats = json.loads((ROOT / "out" / "demo.json").read_text())
    return ("## The demo\n\n`scripts/demo` after its build, path tracing for the comparison included:\n\n" +
            table(["wall s", "of which the cached render", "MB", "asked error", "measured error"],
                  [[f"{wall:.0f}", f"{stats['wall_seconds']['total']:.0f}", round(stats["peak_memory_bytes"] / 1e6), stats["error"]["asked"],
                    f"{stats['error']['mean']:.3f}"]]))


def memory():
    """Peak memory."""
    rows = []
    large = BUILD / "two-million" / "atrium.glb"
    if not large.exists():
        subprocess.run([str(ROOT / "tools" / "make-scenes"), "atrium", "--triangles", "2000000", "--output", str(large.parent)], check=True)
    for name, scene, size in (("cornell-box", CORNELL.scene, "512x512"), ("atrium", ATRIUM.scene, "512x320"),
                              ("atrium, 2 million triangles", large, "512x320")):
        stats = render(View(name, scene, size, 0), "--no-check", "--spp", 1, "--a", 0.4, "--rays", 200)
        rows.append([name, stats["triangles"], stats["records"], f"{stats['peak_memory_bytes'] / 1e6:.0f}",
                     f"{stats['cpu_seconds']['load']:.1f}"])
    return ("## Peak memory\n\nMethod `cached`, a = 0.4, 200 rays:\n\n" +
            table(["scene", "triangles", "records", "MB", "loading, CPU s"], rows))
