import json
import os
import pty
import re
import select
import subprocess

from program import BOX, PROGRAM, SCENES, ProgramTest, picture_channels, png_size, quick

LAYERS = {"R", "G", "B", "A", "depth.Z", "error", "density", "normal.X", "normal.Y", "normal.Z"} | {
    f"{layer}.{c}" for layer in ("direct", "indirect", "irradiance", "albedo") for c in "RGB"}


class Outputs(ProgramTest):
    def test_pictures(self):
        self.done("render", BOX, *quick("--size", "40x24", "-o", "out.exr", "-o", "out.png", "--preview", "preview.png",
                  "--show-records", "records.png"))
        self.assertEqual(self.names(), ["out.exr", "out.png", "preview.png", "records.png"])
        channels, size = picture_channels(self.folder / "out.exr")
        self.assertEqual(size, (40, 24))
        self.assertEqual(set(channels), LAYERS)
        for name in ("out.png", "preview.png", "records.png"):
            self.assertEqual(png_size(self.folder / name), (40, 24), name)
        for c in "RGB":
            for whole, direct, indirect in zip(channels[c], channels["direct." + c], channels["indirect." + c]):
                self.assertAlmostEqual(whole, direct + indirect, delta=1e-5 * (1 + whole))
        self.assertGreater(sum(channels["irradiance.G"]), 0)
        # Of what records serve: an error of 0 only in the very place of a record.
        served = [n > 0 for n in channels["density"]]
        self.assertGreater(sum(served), 0.5 * sum(channels["A"]))
        for alpha, is_served, error in zip(channels["A"], served, channels["error"]):
            self.assertTrue(alpha > 0 and 0 <= error <= 1 if is_served else error == 0)

    def test_the_scene_may_follow_an_output(self):
        self.done("render", "-o", "a.png", BOX, *quick("-o", "b.png"))
        self.assertEqual(self.names(), ["a.png", "b.png"])

    def test_exposure(self):
        for exposure in ("auto", "2", "-3"):
            said = self.done("render", BOX, *quick("--exposure", exposure, "-o", exposure + ".png")).stdout
            stops = float(re.search(rf"^{exposure}\.png: exposure ([-+.0-9]+) EV$", said, re.MULTILINE)[1])
            self.assertTrue(exposure == "auto" or stops == float(exposure))
        self.assertEqual(len({(self.folder / f"{e}.png").read_bytes() for e in ("auto", "2", "-3")}), 3)

    def test_files_are_replaced_not_rewritten(self):
        self.write("out.exr", "older")
        os.link(self.folder / "out.exr", self.folder / "link")
        self.done("render", BOX, *quick("-o", "out.exr"))
        self.assertEqual((self.folder / "link").read_bytes(), b"older")
        picture_channels(self.folder / "out.exr")
        self.assertEqual(self.names(), ["link", "out.exr"])

    def test_links_are_kept(self):
        (self.folder / "there").mkdir()
        (self.folder / "link.exr").symlink_to("there/picture.exr")
        self.done("render", BOX, *quick("-o", "link.exr"))
        self.assertTrue((self.folder / "link.exr").is_symlink())
        picture_channels(self.folder / "there" / "picture.exr")
        self.assertEqual(self.names(), ["link.exr", "there"])

    def test_threads_change_nothing(self):
        for threads in ("1", "2", "5"):
            stats = self.stats(BOX, *quick("--threads", threads, "-o", threads + ".exr", "--save-cache", threads))
            self.assertEqual(stats["threads"], int(threads))
        for threads in ("2", "5"):
            for ending in ("", ".exr"):
                self.assertEqual((self.folder / (threads + ending)).read_bytes(), (self.folder / ("1" + ending)).read_bytes())

    def test_seeds_do(self):
        for seed in ("0", "1"):
            self.assertEqual(self.stats(BOX, *quick("--seed", seed, "-o", seed + ".exr"))["seed"], int(seed))
        self.assertNotEqual((self.folder / "0.exr").read_bytes(), (self.folder / "1.exr").read_bytes())

    def test_error_and_threshold_mean_the_same_for_radiance(self):
        by_error = self.stats(BOX, *quick("--error", "0.1", "-o", "a.exr"))
        by_threshold = self.stats(BOX, *quick("--a", str(by_error["parameters"]["a"]), "-o", "b.exr"))
        self.assertAlmostEqual(by_threshold["glossy"]["a"], by_error["glossy"]["a"], 5)

    def test_records_are_kept_and_taken_up_again(self):
        first = self.stats(BOX, *quick("--save-cache", "records", "-o", "a.exr"))
        again = self.stats(BOX, *quick("--load-cache", "records", "-o", "b.exr"))
        self.assertGreater(first["records"], 20)
        self.assertGreaterEqual(again["records"], first["records"])
        self.assertLessEqual(again["records"], 1.02 * first["records"])
        self.assertLess(again["rays"]["gather"], 0.02 * first["rays"]["gather"] + 64 * 50)  # a survey, and next to nothing
        whole = (self.folder / "records").read_bytes()
        self.done("render", BOX, *quick("--load-cache", "records", "--save-cache", "./records", "--stats", "s.json"))
        self.assertGreaterEqual(len((self.folder / "records").read_bytes()), len(whole))
        (a, _), (b, _) = (picture_channels(self.folder / name) for name in ("a.exr", "b.exr"))
        for x, y in zip(a["irradiance.G"], b["irradiance.G"]):
            self.assertAlmostEqual(x, y, delta=0.02 * (x + 0.1))


class Statistics(ProgramTest):
    def test_every_key(self):
        for method in ("cached", "ward1988", "bounded"):
            stats = self.stats(BOX, *quick("--method", method, "--seed", "7", "--threads", "2"))
            self.assertEqual((stats["method"], stats["seed"], stats["threads"]), (method, 7, 2))
            self.assertGreater(stats["records"], 0)
            self.assertGreaterEqual(stats["uncovered"], 0)
            rays = stats["rays"]
            self.assertEqual(rays["total"], sum(rays[kind] for kind in ("camera", "shadow", "gather", "path", "check", "verification")))
            for kind in ("camera", "shadow", "gather", "check"):
                self.assertGreater(rays[kind], 0, kind)
            for clock in ("cpu_seconds", "wall_seconds"):
                parts = [stats[clock][phase] for phase in ("load", "build", "check", "final")]
                self.assertTrue(all(part >= 0 for part in parts), stats[clock])
                self.assertLessEqual(sum(parts), stats[clock]["total"] * 1.001)
            self.assertGreater(stats["peak_memory_bytes"], 1 << 20)
            error = stats["error"]
            self.assertEqual(error["asked"], 0.05)
            self.assertGreaterEqual(error["points"], 8)
            self.assertGreaterEqual(error["p95"], error["median"])
            self.assertGreaterEqual(error["largest"]["error"], error["p95"])
            self.assertTrue(all(0 <= at < size for at, size in zip(error["largest"]["pixel"], (stats["width"], stats["height"]), strict=True)), error)
            self.assertGreater(error["mean"], 0)
            self.assertLess(abs(error["bias"]), 0.5)

    def test_path_tracing(self):
        stats = self.stats(BOX, *quick("--method", "path"))
        self.assertEqual((stats["method"], stats["records"], stats["uncovered"]), ("path", 0, 0))
        self.assertEqual((stats["rays"]["gather"], stats["rays"]["check"]), (0, 0))

    def test_the_check_can_be_left_out(self):
        stats = self.stats(BOX, *quick("--no-check"))
        self.assertEqual(stats["rays"]["check"], 0)
        self.assertEqual(stats["error"], {"asked": 0.05, "points": 0})

    def test_a_number_of_records(self):
        stats = self.stats(BOX, *quick("--size", "64x64", "--records", "800", "--rays", "200", "--no-check"))
        self.assertLess(abs(stats["records"] - 800), 40)
        # No threshold gives as few: it says so.
        done = self.run_program("render", BOX, *quick("--records", "2", "--no-check", "--stats", "s.json"))
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"warning: --records 2: the nearest that any threshold gave is \d+\n")

    def test_the_closing_words_on_the_error(self):
        # Met; not met; and asked for less than the measurement's own noise.
        verdicts = set()
        for flags in (("--error", "0.5"), ("--error", "0.001", "--rays", "12"), ("--size", "48x48", "--error", "0.01", "--rays", "3200", "--secondary", "off")):
            said = self.done("render", BOX, *quick(*flags, "--stats", "stats.json")).stdout
            error = json.loads((self.folder / "stats.json").read_text())["error"]
            above = error["mean"] - error["noise"] > error["asked"]
            hidden = not above and error["mean"] > 1.5 * error["asked"]
            self.assertEqual("above the asked error; more --rays lower" in said, above, said)
            self.assertEqual("not measurable at this noise" in said, hidden, said)
            verdicts.add((above, hidden))
        self.assertEqual(verdicts, {(False, False), (True, False), (False, True)})

    def test_orders_and_parameters(self):
        stats = self.stats(BOX, *quick("--order", "lazy", "--method", "ward1992", "--a", "0.5", "--metric",
                           "bounded-split-sphere", "--estimator", "ward-heckbert-exact"))
        parameters = stats["parameters"]
        self.assertEqual((parameters["order"], parameters["metric"], parameters["estimator"]),
                         ("lazy", "bounded-split-sphere", "ward-heckbert-exact"))
        self.assertAlmostEqual(parameters["a"], 0.5)
        self.assertEqual((parameters["secondary"], stats["uncovered"]), ("off", 0))

    def test_rays_that_adapt(self):
        coarse, fine = (self.stats(BOX, *quick("--rays", "auto", "--error", error)) for error in ("0.2", "0.02"))
        self.assertEqual((coarse["parameters"]["gather"], coarse["refinements"]), ("auto", 0))
        self.assertGreater(fine["parameters"]["rays_in_the_mean"], 1.5 * coarse["parameters"]["rays_in_the_mean"])
        self.assertLess(fine["error"]["mean"], coarse["error"]["mean"])
        self.assertEqual(self.stats(BOX, *quick())["parameters"]["gather"], [4, 13])

    def test_refinement(self):
        # Few fixed rays leave more noise than is asked for: threshold and rounds alone cannot mend that, but are worked on.
        stats = self.stats(BOX, *quick("--error", "0.01", "--refine", "2"))
        self.assertEqual(stats["refinements"], 2)
        self.assertLess(stats["parameters"]["a"], 0.01)
        self.assertIn("after 1 refinement ", self.done("render", BOX, *quick("--error", "0.01", "--refine", "1", "-o", "a.exr")).stdout)
        met = self.stats(BOX, *quick("--error", "1", "--refine", "3"))
        self.assertEqual(met["refinements"], 0)

    def test_leak_test(self):
        for flags, tested in (((), True), (("--leak-test", "off"), False), (("--method", "bounded"), False)):
            with self.subTest(flags=flags):
                stats = self.stats(BOX, *quick("--secondary", "off", *flags))  # cells are tested in any case
                self.assertEqual(stats["parameters"]["leak_test"], tested)
                self.assertEqual(stats["rays"]["verification"] > 0, tested)

    def test_how_records_are_used(self):
        for flags in (("--extrapolate", "0"), ("--aspect", "1"), ("--weight", "ward"), ()):
            name = (flags + ("none",))[0].lstrip("-")
            stats = self.stats(BOX, *quick("--method", "swept", *flags, "-o", name + ".exr"))
            self.assertEqual(stats["parameters"]["extrapolate"], 0 if name == "extrapolate" else 2)
        pictures = {(self.folder / (name + ".exr")).read_bytes() for name in ("none", "extrapolate", "aspect", "weight")}
        self.assertEqual(len(pictures), 4)


class SceneFiles(ProgramTest):
    def scene(self, text):
        return str(self.write("scene.toml", f'[scene]\nfile = "{BOX}"\n' + text))

    def test_flags_win_over_the_file_and_the_file_over_defaults(self):
        scene = self.scene("[film]\nsize = [24, 16]\nspp = 2\n[method]\nmethod = 'ward1992'\nerror = 0.1\nrays = 60\nseed = 3\n")
        stats = self.stats(scene)
        self.assertEqual((stats["width"], stats["height"], stats["samples"]), (24, 16, 24 * 16 * 2))
        self.assertEqual((stats["method"], stats["seed"], stats["error"]["asked"]), ("ward1992", 3, 0.1))
        stats = self.stats(scene, "--size", "16x20", "--spp", "1", "--method", "bounded", "--error", "0.05", "--seed", "4")
        self.assertEqual((stats["width"], stats["height"], stats["samples"]), (16, 20, 16 * 20))
        self.assertEqual((stats["method"], stats["seed"], stats["error"]["asked"]), ("bounded", 4, 0.05))

    def test_flags_decide_in_place_of_the_file(self):
        for text in ("a = 0.5\n", "records = 50\n", "error = 0.1\n"):
            scene = self.scene("[method]\n" + text)
            stats = self.stats(scene, *quick("--error", "0.2"))
            self.assertEqual(stats["error"]["asked"], 0.2)
            self.assertAlmostEqual(self.stats(scene, *quick("--a", "0.4"))["parameters"]["a"], 0.4)

    def test_a_combination_may_be_completed_by_the_file(self):
        scene = self.scene("[method]\nbound-gradient = false\n")
        self.stats(scene, *quick("--method", "bounded", "--estimator", "irradiance"))

    def test_an_environment(self):
        self.done("render", str(SCENES / "plate.toml"), *quick("-o", "out.exr"))
        channels, _ = picture_channels(self.folder / "out.exr")
        self.assertGreater(min(g for g, a in zip(channels["G"], channels["A"]) if a == 0), 0.01)


class Cameras(ProgramTest):
    def picture(self, *flags, size="32x32"):
        self.done("render", BOX, *quick("--size", size, "--method", "path", *flags, "-o", "out.exr"))
        return picture_channels(self.folder / "out.exr")[0]

    def test_forms(self):
        default = self.picture()
        for name in ("published", "0"):
            self.assertEqual(self.picture("--camera", name), default)
        same = self.picture("--camera", "2.78,2.73,-8;2.78,2.73,0;39.3077")
        for channel in ("normal.X", "normal.Z", "albedo.G"):
            agree = sum(abs(a - b) < 1e-3 for a, b in zip(same[channel], default[channel]))
            self.assertGreater(agree, 0.97 * 32 * 32, channel)
        near = self.picture("--camera", "2.78,2.73,1;2.78,2.73,2;90")
        self.assertLess(max(near["depth.Z"]), max(default["depth.Z"]) - 5)

    def test_size_keeps_the_vertical_field_of_view(self):
        square, wide = self.picture(), self.picture(size="64x32")
        agree = sum(abs(wide["normal.Y"][y * 64 + 16 + x] - square["normal.Y"][y * 32 + x]) < 0.3
                    for y in range(32) for x in range(32))
        self.assertGreater(agree, 0.9 * 32 * 32)


class Manners(ProgramTest):
    def test_help_version_and_methods(self):
        for arguments in (("--help",), ("render", "--help"), ("compare", "--help"), ("explain", "--help"), ("--version",)):
            said = self.done(*arguments).stdout
            self.assertTrue(said)
            for unreadable in ("INT", "TEXT", "FLOAT", "{", " ..."):
                self.assertNotIn(unreadable, said, arguments)
        listed = self.done("methods").stdout
        for name in ("path", "ward1988", "ward1992", "bounded", "uniform", "cached", "irradiance", "ward-heckbert",
                     "ward-heckbert-exact", "split-sphere", "bounded-split-sphere", "[Ward, Heckbert 1992]"):
            self.assertRegex(listed, r"(^|\s)%s(\s|$)" % name.replace("[", r"\[").replace("]", r"\]"))
        for table in listed.split("\n\n"):
            heading, *rows = table.splitlines()
            for start in re.finditer(r"(?<=  )\S", heading):
                for row in rows:
                    self.assertEqual(row[start.start() - 1:start.start()].strip(), "", row)
        # Every method that is listed renders.
        for name in listed.split("\n\n")[0].splitlines()[1:]:
            self.stats(BOX, *quick("--method", name.split()[0]))

    def test_progress_for_scripts(self):
        result = self.run_program("render", BOX, *quick("--progress", "json", "-o", "out.exr"))
        self.assertEqual(result.returncode, 0)
        lines = [json.loads(line) for line in result.stderr.splitlines()]
        phases = list(dict.fromkeys(line["phase"] for line in lines))
        self.assertEqual([p for p in phases if p != "check"], ["load", "build", "final"])
        for line in lines:
            self.assertTrue(0 <= line["done"] <= 1, line)
            # From next to nothing no time is foretold.
            self.assertEqual(line["seconds_left"] is None, line["done"] < 0.02, line)
            self.assertTrue(line["seconds_left"] is None or line["seconds_left"] >= 0, line)
        for phase in ("build", "final"):
            done = [line["done"] for line in lines if line["phase"] == phase]
            self.assertEqual((done, done[-1]), (sorted(done), 1))

    def test_progress_can_be_had_in_a_pipe_and_not_on_a_terminal(self):
        self.assertIn("#", self.run_program("render", BOX, *quick("--progress", "bar", "-o", "out.exr")).stderr)
        self.assertIn("s left", self.on_terminal())
        self.assertEqual(self.on_terminal("--progress", "none"), "")

    def on_terminal(self, *flags):
        """What a run writes to standard error, that being a terminal."""
        try:
            ours, theirs = pty.openpty()
        except OSError as error:
            self.skipTest(f"no terminal to be had here: {error}")
        with subprocess.Popen([PROGRAM, "render", BOX, *quick(*flags, "-o", "out.exr")], cwd=self.folder, stderr=theirs,
                              stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL) as process:
            os.close(theirs)
            text = b""
            try:
                while select.select([ours], [], [], 600)[0]:
                    part = os.read(ours, 4096)
                    if not part:
                        break
                    text += part
            except OSError:  # the terminal's other end is closed
                pass
            os.close(ours)
            self.assertEqual(process.wait(), 0)
        return text.decode()
