"""Runs the program and reads what it measured."""
import hashlib
import json
import os
import pathlib
import statistics
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "bench"
PROGRAM = ROOT / "build" / "release" / "isophote"


class View:
    """A scene at a size, with its path-traced reference in two halves."""

    def __init__(self, name, scene, size, reference_samples, camera=None):
        self.name, self.scene, self.size, self.reference_samples = name, ROOT / "scenes" / scene, size, reference_samples
        self.camera = camera  # its name; none: the scene's first

    def arguments(self):
        return [str(self.scene), "--size", self.size, *(("--camera", self.camera) if self.camera else ())]

    def references(self):
        # References outlive builds: delete build/bench after a change to the path tracer.
        content = hashlib.sha256(self.scene.read_bytes()).hexdigest()[:12]
        paths = [BUILD / f"{self.name}-{self.size}-{self.reference_samples}-{content}-{half}.exr" for half in (1, 2)]
        for half, path in enumerate(paths, 1):
            if not path.exists():
                render(self, "--method", "path", "--spp", self.reference_samples, "--seed", 7000 + half, output=path)
        return paths


CORNELL = View("cornell-box", "cornell-box.glb", "512x512", 256)
ATRIUM = View("atrium", "atrium.glb", "512x320", 256)


def render(view, *flags, output=None):
    """Statistics of one render, as the program writes them; the picture, if `output` is given."""
    BUILD.mkdir(parents=True, exist_ok=True)
    stats = BUILD / f"stats-{os.getpid()}.json"
    command = [str(PROGRAM), "render", *view.arguments(), "--progress", "none", "--stats", str(stats), *map(str, flags)]
    if output:
        command += ["-o", str(output)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    result = json.loads(stats.read_text())
    stats.unlink()
    return result


def error(view, picture, layer="irradiance", other=None):
    """Errors of a picture; those that it has in common with `other`, of another seed, if that is given."""
    first, second = view.references()
    command = [str(PROGRAM), "compare", str(picture), str(first), "--second", str(second), "--json"]
    if layer:
        command += ["--layer", layer]
    if other:
        command += ["--other", str(other)]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def measured(view, *flags):
    """One render and its errors."""
    picture = BUILD / f"picture-{os.getpid()}.exr"
    stats = render(view, *flags, "--no-check", output=picture)
    errors = error(view, picture)
    picture.unlink()
    return stats, errors


def root_mean_square(values):
    return (sum(v * v for v in values) / len(values)) ** 0.5


class Measured:
    """Renders of several seeds: CPU seconds and records in the mean, errors by root mean square, and their systematic part, which pairs of seeds
    have in common (none of a single seed)."""

    def __init__(self, view, seeds, *flags):
        pictures = [BUILD / f"picture-{os.getpid()}-{seed}.exr" for seed in seeds]
        stats = [render(view, *flags, "--seed", seed, "--no-check", output=picture) for seed, picture in zip(seeds, pictures)]
        errors = [error(view, picture) for picture in pictures]
        shared = [error(view, a, other=b) for a, b in zip(pictures, pictures[1:] + pictures[:1])] if len(pictures) > 1 else []
        for picture in pictures:
            picture.unlink()
        self.stats = stats[0]
        self.cpu = sum(map(cost, stats)) / len(stats)
        self.records = round(sum(s["records"] for s in stats) / len(stats))
        self.bias = sum(e["bias"] for e in errors) / len(errors)
        self.rmse, self.block = (root_mean_square([e[key] for e in errors]) for key in ("relative_rmse", "block_error"))
        self.systematic_rmse, self.systematic_block = (root_mean_square([e[key] for e in shared]) if shared else None
                                                       for key in ("relative_rmse", "block_error"))


class Point:
    """Pictures of some seeds: CPU seconds and records in the mean, errors of the colours by root mean square, and bias in the mean."""

    def __init__(self, view, *flags, seeds=(1,)):
        each = [self._one(view, *flags, "--seed", seed) for seed in seeds]
        self.stats = each[0][0]
        records = [self.records_of(s) for s, _ in each]
        self.records = "" if None in records else round(statistics.mean(records))
        self.cpu, self.final = statistics.mean(cost(s) for s, _ in each), statistics.mean(s["cpu_seconds"]["final"] for s, _ in each)
        self.rmse, self.block = (root_mean_square([e[key] for _, e in each]) for key in ("relative_rmse", "block_error"))
        self.bias = statistics.mean(e["bias"] for _, e in each)

    @staticmethod
    def records_of(stats):
        return stats["records"]

    @staticmethod
    def _one(view, *flags):
        picture = BUILD / f"point-{os.getpid()}.exr"
        stats = render(view, *flags, "--no-check", output=picture)
        errors = error(view, picture, "")
        picture.unlink()
        return stats, errors

    def row(self, *names):
        return [*names, self.records, f"{self.cpu:.1f}", percent(self.rmse), percent(self.block), f"{100 * self.bias:+.2f}"]


def cost(stats):
    """CPU seconds of the picture: build and final pass."""
    return stats["cpu_seconds"]["build"] + stats["cpu_seconds"]["final"]


def percent(x):
    return f"{100 * x:.2f}"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])
