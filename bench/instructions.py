"""Where instructions go, by callgrind (Debian package valgrind), which counts the same on a busy machine as on a quiet one."""
import collections
import re
import shutil
import subprocess

from measure import ATRIUM, BUILD, CORNELL, PROGRAM, table

# What a function belongs to, the first match; functions of loading and writing are left out of the whole.
GROUPS = (
    ("ray casting (Embree)", r"libembree"),
    ("left out", r"libz|libOpenEXR|libpng|libtbb|ld-linux|libc\.so|libstdc|libtinygltf|Reader|gltf|Json|json|toml|Exr|exr|png|read_|CLI|checksum"),
    ("hit points, materials, textures", r"surface_point|Bsdf|bsdf|ggx|fetch|frame|Corners|opacity|emission\("),
    ("light sampling", r"Emitters|light_transmittance|shadow_ray|through_sheets|PunctualLights|Environment|NearGrid|AliasTable|Distribution|sample_light|FewChoice|lamp|solid_angle|spherical_triangle"),
    ("reading the cache", r"RecordCache|interpolate|footprint|Octree|visit|serving_error|standing|open_between"),
    ("gradients and radii", r"ward_heckbert|swept|Gradient|split_sphere|settle|limit_extrapolation|NeighbourIndex|obstacles|standard_error"),
    ("paths: lobes, sampling, weights", r"scatter|follow|first_point|direct_light|glossy|shade|sample_diffuse|Sampler|trace_on|gather"),
)


def profile(view, *flags):
    out = BUILD / "callgrind.out"
    subprocess.run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={out}", str(PROGRAM), "render", str(view.scene), "--size", "64x48",
                    "--threads", "1", "--no-check", *map(str, flags), "-o", str(BUILD / "profile.exr")], check=True, capture_output=True)
    text = subprocess.run(["callgrind_annotate", "--threshold=100", str(out)], check=True, capture_output=True, text=True).stdout
    counts = collections.Counter()
    for line in text.splitlines():
        found = re.match(r"\s*([\d,]+) \(\s*[\d.]+%\)\s+(.*)", line)
        if found and "PROGRAM TOTALS" not in line:
            group = next((name for name, pattern in GROUPS if re.search(pattern, found[2])), "the rest")
            counts[group] += int(found[1].replace(",", ""))
    del counts["left out"]
    total = sum(counts.values())
    return {name: 100 * count / total for name, count in counts.items()}


def section():
    if not shutil.which("valgrind"):
        return "## Where the instructions go\n\nNot measured: needs the Debian package valgrind."
    columns = {}
    for view in (CORNELL, ATRIUM):
        columns[f"{view.name}, path"] = profile(view, "--method", "path", "--spp", 16)
        columns[f"{view.name}, build"] = profile(view, "--method", "cached", "--spp", 1, "--a", 0.3, "--rays", 400)
        columns[f"{view.name}, final"] = profile(view, "--method", "cached", "--spp", 256, "--a", 0.6, "--rays", 100)
    names = [name for name, _ in GROUPS if name != "left out"] + ["the rest"]
    return ("## Where the instructions go\n\nShares in % of the instructions of rendering, by callgrind; inlined code counts for its caller. "
            "*build* is a cached render at one sample a pixel, *final* one at 256 with few and cheap records:\n\n" +
            table(["part", *columns], [[name, *(f"{columns[c].get(name, 0):.0f}" for c in columns)] for name in names]))
