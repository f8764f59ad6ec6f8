import json
import os
import struct
from pathlib import Path

from program import BOX, SCENES, ProgramTest, quick

METHODS = ("path", "ward1988", "ward1992", "bounded", "krivanek2005a", "krivanek2005b", "krivanek2006", "jarosz2008a", "marco2018", "jarosz2012", "schwarzhaupt2012", "swept", "uniform", "cached")


class BadUsage(ProgramTest):
    def refused_render(self, flags, *mentions):
        self.refused(2, ("render", BOX, *quick("-o", "out.exr", *flags)), *mentions)

    def test_verbs_and_flags(self):
        self.refused(2, (), "render, explain, compare, methods")
        for arguments in (("rendr",), ("rendr", "x"), ("rendr", "--help"), ("",)):
            self.refused(2, arguments, f"unknown command '{arguments[0]}'; there are: render, explain, compare, methods\n")
        self.refused(2, ("--nonsense",), "--nonsense", "(see isophote --help)")
        self.refused(2, ("render", "x", "--nonsense"), "--nonsense", "(see isophote render --help)")
        self.refused(2, ("compare", "a.exr"), "(see isophote compare --help)")
        self.refused(2, ("render",))
        self.refused(2, ("render", BOX))
        self.refused(2, ("methods", "extra"))
        self.refused_render(("--nonsense", "1"), "--nonsense")
        self.refused_render(("--spp",), "--spp")
        self.refused(2, ("render", BOX, "-o", "a.png", "b.png"), "b.png")

    def test_unknown_names_are_answered_with_the_known_ones(self):
        self.refused_render(("--method", "ward2000"), "ward2000", *METHODS)
        self.refused_render(("--estimator", "guess"), "guess", "irradiance", "ward-heckbert", "ward-heckbert-exact")
        self.refused_render(("--metric", "guess"), "guess", "split-sphere", "bounded-split-sphere", "uniform")
        self.refused_render(("--camera", "nowhere"), "nowhere", "published")

    def test_combinations_that_do_not_exist(self):
        self.refused_render(("--method", "bounded", "--estimator", "irradiance"), "irradiance", "gradient")
        self.refused_render(("--metric", "split-sphere", "--min-pixels", "2"), "split-sphere", "bounded-split-sphere")
        self.refused_render(("--method", "ward1992", "--metric", "total-error"), "total-error", "ward-heckbert", "Hessian")
        self.refused_render(("--method", "ward1992", "--extrapolate", "2"), "--extrapolate 2", "ward-heckbert")
        for flags in (("--metric", "uniform"), ("--estimator", "irradiance"), ("--records", "100"), ("--order", "lazy"),
                      ("--save-cache", "c"), ("--load-cache", "c"), ("--show-records", "r.png"), ("--show-error", "e.png")):
            self.refused_render(("--method", "path", *flags), "path")
        self.refused_render(("--secondary", "records", "--max-depth", "3"), "--max-depth")
        self.refused_render(("--records", "100", "--order", "lazy"), "--records")
        self.refused_render(("--regress", "on", "--order", "lazy"), "--regress")
        self.refused_render(("--glossy-contrast", "0.1", "--order", "lazy"), "--glossy-contrast")
        self.refused_render(("--regress", "on", "--method", "cached", "--estimator", "ward-heckbert", "--metric", "split-sphere"), "--regress", "gradients")
        self.refused_render(("--regress", "on", "--method", "cached", "--estimator", "triangulated"), "--regress", "errors", "triangulated")
        self.refused_render(("--regress", "on", "--leak-test", "off"), "--regress", "--leak-test")
        self.refused_render(("--regress", "on", "--method", "swept"), "--regress", "--leak-test")
        self.refused_render(("--records", "100", "--load-cache", "c"), "--records")
        self.refused_render(("--glossy", "mirror"), "--glossy", "cache, rays or auto")
        self.refused_render(("--method", "ward1992", "--glossy-a", "0.2"), "--glossy-", "--glossy cache or auto")
        self.refused_render(("--glossy-metric", "total-error"), "--glossy-metric", "irradiance alone")
        self.refused_render(("--glossy-estimator", "swept-edges"), "--glossy-estimator", "radiance-stratified")
        self.refused_render(("--method", "path", "--glossy", "cache"), "path")
        for flags in (("--error", "0.1", "--a", "0.3"), ("--a", "0.3", "--records", "9"), ("--records", "9", "--error", "0.1")):
            self.refused(2, ("render", BOX, *flags, "-o", "out.exr"), flags[0], flags[2], "give one")
        self.refused_render(("--min-pixels", "9", "--max-pixels", "8"), "--min-pixels 9", "--max-pixels 8")
        self.refused_render(("--method", "bounded", "--min-pixels", "30"), "--min-pixels 30", "--max-pixels 20")
        self.refused_render(("--min-radius", "2", "--max-radius", "1"), "--min-radius 2", "--max-radius 1")

    def test_values(self):
        for flag, values in {
            "--size": ("10", "0x5", "5x0", "axb", "-4x4", "4x4x4", "99999x4", "4 x 4", ""),
            "--spp": ("0", "-1", "1.5", "many", "1e99", ""),
            "--error": ("0", "-1", "nan", "inf", "2%", ""),
            "--a": ("0", "-1", "nan"),
            "--rays": ("0", "1e12"),
            "--records": ("0", "-5"),
            "--max-depth": ("0", "-1"),
            "--threads": ("-1", "x", "100000"),
            "--seed": ("-1", "x", "0.5"),
            "--secondary": ("maybe", "on", ""),
            "--regress": ("maybe", ""),
            "--leak-test": ("maybe", ""),
            "--refine": ("-1", "x", "100"),
            "--bound-neighbours": ("on", "-1"),
            "--weight": ("box",),
            "--order": ("random",),
            "--progress": ("loud",),
            "--exposure": ("bright",),
            "--camera": ("1,2;3,4,5;40", "1,2,3;4,5,6", "1,2,3;1,2,3;40", "0,0,0;0,0,1;180", "9"),
            "-o": ("out.jpg", "out", ""),
            "--preview": ("p.exr",),
            "--show-records": ("p.exr",),
            "--show-error": ("p.exr",),
            "--show-density": ("p.exr",),
            "--slice": ("1,2,3", "1,2,3;0,0,1;5", "1,2;0,0,1", "1,2,x;0,0,1", "1,2,3;0,0,0", "1,2,3;", ";0,0,1", ""),
        }.items():
            for value in values:
                with self.subTest(flag=flag, value=value):
                    self.refused_render((flag, value), flag)

    def test_a_picture_that_does_not_fit_in_memory(self):
        if os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") > 100e9:
            self.skipTest("it would fit")
        self.refused(1, ("render", BOX, "--size", "32768x32768", "-o", "out.exr"), "32768", "memory")


class BadInput(ProgramTest):
    def refused_scene(self, name, *mentions):
        self.refused(1, ("render", name, *quick("-o", "out.exr", "--stats", "stats.json")), *mentions)

    def test_files_that_are_not_scenes(self):
        self.refused_scene("missing.glb", "missing.glb")
        self.refused_scene("missing.toml", "missing.toml")
        for name in ("empty.glb", "empty.gltf", "empty.toml", "scene.txt"):
            self.write(name, "")
            self.refused_scene(name, name)
        (self.folder / "folder.glb").mkdir()
        self.refused_scene("folder.glb", "folder.glb")

    def test_broken_gltf(self):
        whole = Path(BOX).read_bytes()
        for size in (4, 12, 20, 100, len(whole) // 2, len(whole) - 1):
            with self.subTest(size=size):
                self.write("cut.glb", whole[:size])
                self.refused_scene("cut.glb", "cut.glb")
        self.assertIn(b'"version":"2.0"', whole)
        self.write("harmed.glb", whole.replace(b'"version":"2.0"', b'"version":"9.0"'))
        self.refused_scene("harmed.glb", "harmed.glb")

    def test_scene_files(self):
        scene = f'[scene]\nfile = "{BOX}"\n'
        for text, line, mention in (
            (scene + "[film]\nsizes = [4, 4]\n", 4, "sizes"),
            (scene + "[film]\nsize = [4]\n", 4, "size"),
            (scene + "[method]\nmethod = 'ward2000'\n", 4, "ward2000"),
            (scene + "[method]\nsecondary = 7\n", 4, "secondary"),
            (scene + "[method]\nsize = [4, 4]\n", 4, "size"),
            (scene + "[method]\na = 0.3\nerror = 0.1\n", 5, "both decide"),
            (scene + "[films]\n", 3, "films"),
            (scene + "[film\n", 3, ""),
            ('[scene]\nfile = "nowhere.glb"\n', 2, "nowhere.glb"),
            ('[film]\nspp = 1\n', 1, "scene"),
        ):
            with self.subTest(text=text):
                self.write("bad.toml", text)
                self.refused_scene("bad.toml", f"bad.toml:{line}: ", mention)

    def test_record_files(self):
        self.done("render", BOX, *quick("--save-cache", "records", "--stats", "s.json"))
        for flags, mention in ((("--error", "0.04"), "a="), (("--rays", "60"), "gather="), (("--secondary", "off"), "secondary="),
                               (("--leak-test", "off"), "leak-test="),
                               (("--method", "ward1992"), "estimator="), (("--max-radius", "1"), "max-radius=")):
            with self.subTest(flags=flags):
                self.refused(1, ("render", BOX, *quick(*flags, "--load-cache", "records", "-o", "o.exr")), "records: ", mention)
        self.refused(1, ("render", str(SCENES / "sphere.glb"), *quick("--load-cache", "records", "-o", "o.exr")),
                     "records: ", "scene")
        whole = (self.folder / "records").read_bytes()
        harmed = bytearray(whole)
        harmed[len(whole) // 2] ^= 1
        for name, content in (("cut", whole[:-100]), ("harmed", bytes(harmed)), ("none", b"")):
            self.write(name, content)
            self.refused(1, ("render", BOX, *quick("--load-cache", name, "-o", "o.exr")), name + ": ")
        self.refused(1, ("render", BOX, *quick("--load-cache", "missing", "-o", "o.exr")), "missing: ")

    def test_the_older_picture_stays(self):
        self.write("out.exr", "older")
        self.write("cut.glb", Path(BOX).read_bytes()[:1000])
        self.refused_scene("cut.glb", "cut.glb")
        self.assertEqual((self.folder / "out.exr").read_bytes(), b"older")


class OneFileForTwo(ProgramTest):
    """An output never replaces what is read, nor another output."""

    def setUp(self):
        super().setUp()
        self.glb = self.write("mine.glb", Path(BOX).read_bytes())
        self.toml = self.write("mine.toml", "[scene]\nfile = 'mine.glb'\n")

    def refused(self, code, arguments, *mentions):
        before = {path: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}
        super().refused(code, arguments, *mentions)
        self.assertEqual({path: path.read_bytes() for path in before}, before)

    def test_inputs_of_render(self):
        (self.folder / "link").symlink_to("mine.glb")
        (self.folder / "sub").mkdir()
        for name in ("mine.glb", "./mine.glb", "sub/../mine.glb", str(self.glb), "link"):
            for flag in ("--stats", "--save-cache"):
                with self.subTest(name=name, flag=flag):
                    self.refused(2, ("render", "mine.glb", *quick(flag, name, "-o", "a.png")), f"{flag} {name}", "the scene")
                    self.refused(2, ("render", "mine.toml", *quick(flag, name, "-o", "a.png")), f"{flag} {name}", "mine.glb")
        self.refused(2, ("render", "mine.toml", *quick("--stats", "mine.toml")), "--stats mine.toml", "the scene")

    def test_an_environment_is_kept(self):
        self.done("render", "mine.glb", *quick("--method", "path", "-o", "sky.exr"))
        self.write("mine.toml", "[scene]\nfile = 'mine.glb'\n[environment]\nfile = 'sky.exr'\n")
        self.refused(2, ("render", "mine.toml", *quick("-o", "sky.exr")), "-o sky.exr", "would overwrite sky.exr")

    def test_buffers_and_textures_are_kept(self):
        (self.folder / "some.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0))
        self.write("some.gltf", json.dumps({
            "asset": {"version": "2.0"}, "buffers": [{"uri": "some.bin", "byteLength": 36}], "images": [{"uri": "wood.png"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}]}))
        self.write("some.toml", "[scene]\nfile = 'some.gltf'\n")
        for scene in ("some.gltf", "some.toml"):
            self.refused(2, ("render", scene, *quick("-o", "wood.png")), "-o wood.png", "would overwrite wood.png")
            self.refused(2, ("render", scene, *quick("-o", "a.png", "--stats", "some.bin")), "--stats some.bin", "would overwrite")

    def test_records_that_are_taken_up(self):
        self.done("render", "mine.glb", *quick("--save-cache", "records"))
        self.refused(2, ("render", "mine.glb", *quick("--load-cache", "records", "--stats", "records")), "--load-cache")

    def test_outputs(self):
        (self.folder / "link.png").symlink_to("a.png")
        for one, other in (("a.png", "a.png"), ("a.png", "./a.png"), ("a.png", "link.png"), (str(self.folder / "a.png"), "a.png")):
            with self.subTest(one=one, other=other):
                self.refused(2, ("render", "mine.glb", *quick("-o", one, "-o", other)), f"-o {one}", f"-o {other}", "one file")
                self.refused(2, ("render", "mine.glb", *quick("-o", one, "--preview", other)), "one file")


class UnwritableOutput(ProgramTest):
    """Said before hours of work, not after."""

    def test_every_kind_of_output(self):
        self.write("file", "")
        (self.folder / "folder.exr").mkdir()
        for flags in (("-o", "nowhere/out.exr"), ("-o", "nowhere/out.png"), ("-o", "file/out.exr"), ("-o", "folder.exr"),
                      ("-o", "out.exr", "--stats", "nowhere/s.json"), ("-o", "out.exr", "--preview", "nowhere/p.png"),
                      ("-o", "out.exr", "--show-records", "nowhere/r.png"), ("-o", "out.exr", "--show-error", "nowhere/e.png"),
                      ("-o", "out.exr", "--save-cache", "nowhere/c")):
            with self.subTest(flags=flags):
                self.refused(1, ("render", BOX, *quick(*flags)), flags[-1])

    def test_a_full_disk(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full")
        self.refused(1, ("render", BOX, *quick("--stats", "/dev/full")), "/dev/full")
