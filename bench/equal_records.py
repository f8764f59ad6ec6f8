"""Methods at equal numbers of records: sections 2, 3 and 4 of docs/comparison.md."""
import hashlib
import json
import subprocess
import sys

import png
from measure import BUILD, ROOT, table

PROGRAM = ROOT / "build" / "release" / "bench_figures"
SEEDS = (1, 2, 3)
COUNTS = (500, 1000, 2000, 4000)
PRESETS = ("ward1988", "ward1992", "bounded", "jarosz2012", "schwarzhaupt2012", "swept", "uniform", "cached")
# `swept` with one part after another taken out or changed, and the control with as many orders.
PARTS = ("swept+order=1", "swept+neighbours=0.5", "swept+aspect=1", "swept+aspect=1+order=1", "uniform+order=2")
# The split sphere's records, extrapolated by nothing, by the surface-area form's gradients, by stratified ones and by swept edges'.
GRADIENTS = ("ward1988", "ward1988+estimator=surface-area+order=1", "ward1988+estimator=ward-heckbert-exact+order=1",
             "ward1988+estimator=swept-edges+order=1")


SOURCES = "-".join(name[:8] for name in subprocess.run(["git", "rev-parse", "HEAD:src", "HEAD:bench/comparison"], cwd=ROOT, capture_output=True,
                                                       text=True, check=True).stdout.split())


class Scene:
    def __init__(self, name, size):
        self.name, self.path, self.size = name, ROOT / "scenes" / f"{name}.glb", size
        self.content = hashlib.sha256(self.path.read_bytes()).hexdigest()[:12]


def require_commit():
    if subprocess.run(["git", "diff", "--quiet", "HEAD", "--", "src", "bench/comparison"], cwd=ROOT).returncode:
        sys.exit("src or bench/comparison is changed: results say which sources they are of, so commit first")


class Results:
    """What has been computed, kept from run to run: the rows of tables in the repository, each file with the sources that it is of;
    all else in the build folder, by sources."""

    def __init__(self, trial):
        self.trial = trial
        self.folder = BUILD / "comparison" / SOURCES / ("trial" if trial else "")
        self.folder.mkdir(parents=True, exist_ok=True)
        self.parts = BUILD / "comparison" / ("trial-parts" if trial else "parts")
        self.figures = self.folder if trial else ROOT / "docs" / "figures" / "comparison"
        self.data = self.folder if trial else self.figures / "data"
        self.data.mkdir(parents=True, exist_ok=True)
        self.page = self.folder / "comparison.md" if trial else ROOT / "docs" / "comparison.md"
        self.seeds, self.counts = (SEEDS[:1], (250, 500)) if trial else (SEEDS, COUNTS)
        self.points, self.point_rays, self.exact_rays = (300, 2000, 2000) if trial else (2000, 16384, 16384)
        square, wide = ("128x128", "160x100") if trial else ("256x256", "320x200")
        self.scenes = [Scene("cornell-box", square), Scene("contact-shadow", square), Scene("atrium", wide)]
        self.cornell = self.scenes[0]

    def light(self, rays):
        """Near-exact gathers read one fine cache where they hit, so that their own noise is small; others follow paths."""
        return "fixed" if rays == self.exact_rays else "paths"

    def rays_of_points(self, rays):
        """Of each half of a reference: what its noise adds to a difference cancels, and need not be below that of a few rays."""
        return self.point_rays if rays == self.exact_rays else self.point_rays // 4

    def fixed_points(self, scene, light, rays):
        path = self.folder / f"points-{scene.name}-{scene.content}-{scene.size}-{light}-{self.points}-{rays}.txt"
        if not path.exists():
            subprocess.run([PROGRAM, "points", scene.path, scene.size, light, str(self.points), str(rays), path], check=True)
        return path

    def measured(self, scene, rays, seed, variants, counts, pictures=None):
        """The rows that `bench_figures equal` prints, from an earlier run if there was one."""
        light = self.light(rays)
        asked = [scene.size, str(seed), str(rays), ",".join(variants), ",".join(map(str, counts)), str(self.points), str(self.rays_of_points(rays))]
        key = hashlib.sha256(" ".join(asked).encode()).hexdigest()[:8]
        path = (self.folder if pictures else self.data) / f"{scene.name}-{rays}-{seed}-{scene.content}-{key}.jsonl"
        if not path.exists():
            require_commit()
            points = self.fixed_points(scene, light, self.rays_of_points(rays))
            command = [PROGRAM, "equal", scene.path, scene.size, light, str(seed), str(rays), points, asked[3], asked[4]]
            if pictures:
                pictures.mkdir(parents=True, exist_ok=True)
                command.append(pictures)
            out = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            path.write_text(json.dumps({"sources": SOURCES}) + "\n" + out)
        sources, *rows = map(json.loads, path.read_text().splitlines())
        return [row | sources for row in rows]

    def errors(self, scene, rays):
        """By variant and number of records: mean RMSE in % over seeds, half the range over seeds, records, the references' noise. One run
        computes all variants, for they share what places see."""
        variants = PRESETS + (PARTS[:1] if rays == self.exact_rays else PARTS) + GRADIENTS[1:]
        rows = [row for seed in self.seeds for row in self.measured(scene, rays, seed, variants, self.counts)]
        result = {}
        for variant in variants:
            for count in self.counts:
                mine = [row for row in rows if row["variant"] == variant and row["wanted"] == count]
                rmse = [100 * row["rmse"] for row in mine]
                result[variant, count] = {"rmse": sum(rmse) / len(rmse), "spread": (max(rmse) - min(rmse)) / 2,
                                          "records": sum(row["records"] for row in mine) / len(mine), "noise": 100 * mine[0]["noise"],
                                          "sources": sorted({row["sources"] for row in mine})}
        return result


def cell(entry, count):
    text = f"{entry['rmse']:.2f} ± {entry['spread']:.2f}"
    # No threshold gives as many, or as few.
    return text if abs(entry["records"] / count - 1) < 0.025 else f"{text} ({entry['records']:.0f})"


def comparison(results, scene, rays, variants):
    errors = results.errors(scene, rays)
    rows = [[variant] + [cell(errors[variant, count], count) for count in results.counts] for variant in variants]
    any_entry = errors[variants[0], results.counts[0]]
    noise = any_entry["noise"]
    strata = noise * (2 * results.rays_of_points(rays) / rays) ** 0.5
    return (f"### {scene.name}, {scene.size}, {rays:,} rays a record\n\n" + table(["RMSE %, by records"] + [f"{count:,}" for count in results.counts], rows) +
            f"\n\nNoise: of the references {noise:.2f} % (taken out), of a record's own value about {strata:.2f} % (in all numbers, less where "
            f"several records overlap). Seeds: {len(results.seeds)}; sources {', '.join(any_entry['sources'])}.\n")


def methods(results):
    """Every preset on three scenes, with near-exact records and with the default number of rays; most parts of `swept` with the latter alone."""
    parts = ["## 2. All methods at equal numbers of records\n"]
    for scene in results.scenes:
        parts.append(comparison(results, scene, results.exact_rays, PRESETS + PARTS[:1]))
        parts.append(comparison(results, scene, 800, PRESETS + PARTS))
    for scene in results.scenes:
        parts.append(sheet_of_records(results, scene, PRESETS, results.counts[1], 4))
    return "\n".join(parts)


def sheet_of_records(results, scene, variants, count, columns):
    folder = results.folder / f"records-{scene.name}-{scene.size}"
    rows = results.measured(scene, 800, results.seeds[0], variants, [count], folder)
    cells = [(f"{row['variant']}: {100 * row['rmse']:.2f} %", png.read(folder / f"{row['variant']}-{count}.png")) for row in rows]
    path = results.figures / f"records-{scene.name}-{count}.png"
    png.sheet(path, [cells[i:i + columns] for i in range(0, len(cells), columns)])
    return (f"{count:,} records in {scene.name}, 800 rays each; a dot where a record lies, the rim of its footprint coloured by radius; above it the RMSE:\n\n"
            f"![records of each method]({path.relative_to(results.page.parent)})\n")


def gradients(results):
    """The split sphere's records with and without gradients."""
    parts = ["## 3. Gradients\n\nThe same records, placed by the split sphere: extrapolated by nothing (`ward1988`), by gradients in surface-area "
             "form, by stratified gradients, and by swept edges; `uniform` lies otherwise.\n"]
    for scene in results.scenes:
        for rays in (results.exact_rays, 800):
            parts.append(comparison(results, scene, rays, GRADIENTS + ("uniform",)))
    return "\n".join(parts)


def record_pictures(results):
    count, size = (500, "128x128") if results.trial else (1700, "384x384")
    scene = Scene("cornell-box", size)
    text = sheet_of_records(results, scene, ("ward1992", "bounded", "uniform", "jarosz2012", "schwarzhaupt2012", "swept"), count, 3)
    return f"## 4. Where {count:,} records go: split sphere against Hessian\n\n" + text
