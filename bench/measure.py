"""Runs the program and reads what it measured."""
import hashlib
import json
import os
import pathlib
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


def error(view, picture, layer="irradiance"):
    first, second = view.references()
    command = [str(PROGRAM), "compare", str(picture), str(first), "--second", str(second), "--layer", layer, "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def measured(view, *flags, layers=("irradiance",)):
    """One render and its errors, by layer."""
    picture = BUILD / f"picture-{os.getpid()}.exr"
    stats = render(view, *flags, "--no-check", output=picture)
    errors = {layer: error(view, picture, layer) for layer in layers}
    picture.unlink()
    return stats, errors


def cost(stats):
    """CPU seconds of the picture: build and final pass."""
    return stats["cpu_seconds"]["build"] + stats["cpu_seconds"]["final"]


def percent(x):
    return f"{100 * x:.2f}"


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])
