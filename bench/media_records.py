"""Light in media: methods at equal numbers of records, and gradients of irradiance on a floor that know of a medium or do not."""
import hashlib
import json
import subprocess

import png
from measure import BUILD, ROOT, percent, table

PROGRAM = ROOT / "build" / "release" / "bench_media"
FIGURES = ROOT / "docs" / "figures"
SCENES = ("sun-window", "cornell-fog")
SIZE = "192x144"
COUNTS, SHOWN = (100, 300), 100
SEEDS = (1, 2, 3)
GATHERS, RAYS = 4, 800  # of a record
POINTS, PATHS, PICTURE_PATHS = 1000, 4000, 128
VARIANTS = {"values": "values alone, relative change", "unaware": "gradients unaware of occlusion, relative change [Jarosz 2008a]",
            "walls": "gradients by moving walls, relative change", "balls": "second order, balls [Marco 2018]",
            "ellipsoids": "second order, ellipsoids [Marco 2018]", "balls-absolute": "the same balls, one total error",
            "ellipsoids-absolute": "the same ellipsoids, one total error"}


def ran(*arguments):
    """What the program prints, by lines of JSON."""
    out = subprocess.run([PROGRAM, *map(str, arguments)], check=True, capture_output=True, text=True).stdout
    return [json.loads(line) for line in out.splitlines()]


def kept(name, scene, verb, *numbers):
    """What paths make of a scene, once: delete build/bench after a change to the path tracer."""
    BUILD.mkdir(parents=True, exist_ok=True)
    content = hashlib.sha256(scene.read_bytes()).hexdigest()[:12]
    path = BUILD / f"{name}-{SIZE}-{'-'.join(map(str, numbers))}-{content}.{'exr' if verb == 'paths' else 'txt'}"
    if not path.exists():
        ran(verb, scene, SIZE, *numbers, path)
    return path


def records_of(name):
    """Rows of all seeds; the pictures of the first one's."""
    scene = ROOT / "scenes" / f"{name}.toml"
    truths, paths = kept(name, scene, "truths", POINTS, PATHS), kept(name, scene, "paths", PICTURE_PATHS)
    pictures = BUILD / f"media-records-{name}"
    pictures.mkdir(parents=True, exist_ok=True)
    rows = []
    for seed in SEEDS:
        shown = [pictures, paths] if seed == SEEDS[0] else []
        rows += ran("records", scene, SIZE, seed, GATHERS, RAYS, truths, ",".join(map(str, COUNTS)), *shown)
    return rows, pictures


def spread(values):
    return f"{percent(sum(values) / len(values))} ± {percent((max(values) - min(values)) / 2)}"


def records_table(rows):
    cells = []
    for variant, text in VARIANTS.items():
        cells.append([text])
        for count in COUNTS:
            mine = [row for row in rows if (row["variant"], row["wanted"]) == (variant, count)]
            mean = {part: sum(row[part] for row in mine) / len(mine) for part in ("surfaces", "media")}
            cells[-1] += [f"{mean['surfaces']:.0f} + {mean['media']:.0f}", spread([row["rmse"] for row in mine]), spread([row["mean"] for row in mine])]
    own = next(row for row in rows if row["variant"] == "none")
    cells.append(["a record at every point", *(["", percent(own["rmse"]), percent(own["mean"])] * len(COUNTS))])
    return table(["records", *(f"{count}: {of}" for count in COUNTS for of in ("surfaces + media", "RMSE %", "mean %"))], cells)


def sheet_of_records(name, pictures):
    rows = []
    names = list(VARIANTS)
    for some in (names[:4], names[4:]):
        rows.append([(variant, png.read(pictures / f"{variant}-{SHOWN}.png")) for variant in some])
        rows.append([("", png.read(pictures / f"{variant}-{SHOWN}-error.png")) for variant in some])
    rows[2].append(("paths", png.read(pictures / "paths.png")))
    png.sheet(FIGURES / f"media-records-{name}.png", rows)
    return f"![light in {name} by records](figures/media-records-{name}.png)"


def records():
    """Methods for light in media at equal numbers of records."""
    parts = []
    for name in SCENES:
        rows, pictures = records_of(name)
        noise = next(row["noise"] for row in rows if row["wanted"])
        worst = min(row["points"] for row in rows if row["wanted"])
        parts.append(f"**{name}.** Noise of the references {percent(noise)} %, out of *RMSE* and in *mean*; at least {worst} of {POINTS} points covered:\n\n"
                     f"{records_table(rows)}\n\n{sheet_of_records(name, pictures)}")
    return ("## Records in media at equal numbers\n\nLight that media scatter towards the eye, but for that of lamps and the sun scattered once: what records hold. "
            f"Error of its luminance at {POINTS} points chosen as renders choose theirs, over its mean there, as root mean square (*RMSE*) and of absolute values (*mean*), against "
            f"{2 * PATHS:,} paths a point; means over {len(SEEDS)} seeds ± half their range. Records of both parts together are as many as the column says, by bisection of the threshold. "
            "They lie where random camera rays look, each where none serves when its turn comes; "
            f"what a place sees, by {GATHERS} gathers of {RAYS} rays that follow paths, is the same for all methods. The last row is what is left of noise in records themselves. "
            "*Relative change* places those of the first two rows alike, and all three are interpolated in logarithms; the others linearly. *One total error*: `volume-error` with a "
            "survey of 64 places, by which it allows the same integral everywhere, as `marco2018` renders; without one it allows each record its own value's share.\n\n"
            "`fog-spot.toml` is not here.\n\n" +
            "\n\n".join(parts) + f"\n\nPictures: that light by {SHOWN} records, and its error over the picture's mean, squares of 4 x 4 pixels, from -30 % (blue) to 30 % (red). Dots are"
            " where no record serves and a path is followed.")


FLOOR_RAYS, FLOOR_COUNTS, FLOOR_POINTS, FLOOR_POINT_RAYS = 800, (500, 1000), 1000, 6400
AWARENESS = {"unaware": "jarosz2008b+estimator=ward-heckbert-exact", "aware": "jarosz2008b"}
ESTIMATORS = {"unaware": "unaware of the medium [Ward, Heckbert 1992]", "aware-nearer": "aware, walls at the nearer depth [Jarosz 2008b]",
              "aware": "aware, walls refined"}


def enlarged(path):
    picture = png.read(path)
    return png.crop(picture, 0, 0, *picture[:2], 3)


def room_floor():
    """The analytic room's floor: two tables and a sheet."""
    folder = BUILD / "media-floor"
    folder.mkdir(parents=True, exist_ok=True)
    light, *rows = ran("floor", folder)
    gradients = {(row["estimator"], row["rays"]): row for row in rows if "rays" in row}
    by_records = {(row["estimator"], row["records"]): row["rmse"] for row in rows if "records" in row}
    rays, counts = sorted({r for _, r in gradients}), sorted({n for _, n in by_records})

    def cell(name, path):
        return name, enlarged(folder / f"{path}.png")

    estimators = list(ESTIMATORS)
    png.sheet(FIGURES / "media-floor.png", [
        [cell("irradiance, no medium", "clear"), cell("in the medium", "medium"), cell("gradient by differences", "exact")],
        [cell(f"gradient, {name}", f"{name}-{rays[0]}") for name in estimators],
        [cell("off by", f"{name}-{rays[0]}-off") for name in estimators],
        [cell(f"{counts[1]} records, {name}", f"{name}-by-{counts[1]}-records") for name in ("values", "unaware", "aware")]])
    gradient_table = table(["gradient"] + [f"{r:,} rays: {what}" for r in rays for what in ("RMS %", "off the rim", "median")],
                           [[text] + [f"{100 * gradients[name, r][of]:.1f}" for r in rays for of in ("rms", "off_rim", "median")] for name, text in ESTIMATORS.items()])
    record_table = table(["RMSE % of irradiance, by records"] + [str(n) for n in counts],
                         [[text] + [percent(by_records[name, n]) for n in counts]
                          for name, text in (("values", "values alone"), *((name, ESTIMATORS[name]) for name in ("unaware", "aware")))])
    return light, gradient_table, record_table, rays, counts


def window_floor():
    """The same on a scene: all that is seen of it, records placed by their method."""
    program, scene, size = PROGRAM.parent / "bench_figures", ROOT / "scenes" / "sun-window.toml", "256x192"
    content = hashlib.sha256(scene.read_bytes()).hexdigest()[:12]
    points = BUILD / f"media-floor-points-{FLOOR_POINTS}-{FLOOR_POINT_RAYS}-{content}.txt"
    if not points.exists():
        subprocess.run([program, "points", scene, size, "paths", str(FLOOR_POINTS), str(FLOOR_POINT_RAYS), points], check=True)
    rows = []
    for seed in SEEDS:
        command = [program, "equal", scene, size, "paths", str(seed), str(FLOOR_RAYS), points, ",".join(AWARENESS.values()), ",".join(map(str, FLOOR_COUNTS))]
        rows += map(json.loads, subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines())
    cells = []
    for name, variant in AWARENESS.items():
        cells.append([ESTIMATORS[name]])
        for count in FLOOR_COUNTS:
            mine = [row for row in rows if (row["variant"], row["wanted"]) == (variant, count)]
            cells[-1] += [f"{sum(row['records'] for row in mine) / len(mine):.0f}", spread([row["rmse"] for row in mine]), spread([row["mean"] for row in mine])]
    return table(["gradient", *(f"{count}: {of}" for count in FLOOR_COUNTS for of in ("records", "RMSE %", "mean %"))], cells), rows[0]["noise"]


def floor():
    """Gradients of irradiance that know of media, and those that do not."""
    light, gradients, by_records, rays, counts = room_floor()
    window, noise = window_floor()
    return ("## Gradients of irradiance in media\n\nThe floor of an analytic room, a box of walls that emit, in a homogeneous medium (0.5/m, albedo 0.8) through which the sun's shaft "
            f"falls from a window past a plate; indirect irradiance, the light that the shaft scatters made 20 times as strong. Its mean is {light['clear']:.2f} without the medium, "
            f"{light['medium']:.2f} in it. Error of the gradient over the floor against differences of fine quadratures, relative to the true gradient's root mean square; *off the rim* "
            "without places from which differences reach across the rim of the shaft, where irradiance has a kink; *median* of places' own relative errors:\n\n"
            f"{gradients}\n\nRecords of one radius on that floor, at the same places in all rows, {rays[1]:,} rays each:\n\n{by_records}\n\n"
            "![irradiance of a floor and its gradients](figures/media-floor.png)\n\n"
            f"False colours, lengths of gradients and errors by their roots; estimates by {rays[0]} rays, {counts[1]} records.\n\n"
            "**sun-window.** All that is seen of the scene, records by the method `jarosz2008b` with its own gradients and with those that do not know of media, which also place them; "
            f"equal numbers by bisection, {FLOOR_RAYS} rays a record, paths where they hit. Errors of indirect irradiance at {FLOOR_POINTS} visible points against two gathers of "
            f"{FLOOR_POINT_RAYS:,} rays each, whose noise is {percent(noise)} %, out of *RMSE* and in *mean*; means over {len(SEEDS)} seeds ± half their range:\n\n" + window)
