"""Media from scene files through the program: methods, records on disk, refusals."""
import re

from program import BOX, SCENES, ProgramTest, picture_channels, png_size, quick

FOG = str(SCENES / "cornell-fog.toml")


class Media(ProgramTest):
    def test_records_in_media_are_counted_and_threads_change_nothing(self):
        for threads in ("1", "2"):
            stats = self.stats(FOG, *quick("--threads", threads, "-o", threads + ".exr", "--save-cache", threads))
            self.assertEqual(stats["media"]["from"], "cache")
            self.assertGreater(stats["media"]["records"]["media"], 0)
        for ending in ("", ".exr"):
            self.assertEqual((self.folder / ("1" + ending)).read_bytes(), (self.folder / ("2" + ending)).read_bytes())

    def test_records_in_media_are_kept_and_taken_up_again(self):
        first = self.stats(FOG, *quick("--save-cache", "records", "-o", "a.exr"))
        again = self.stats(FOG, *quick("--load-cache", "records", "-o", "b.exr"))
        for part in ("surfaces", "media"):
            before, after = (s["media"]["records"][part] for s in (first, again))
            self.assertGreaterEqual(after, before)
            self.assertLessEqual(after, 1.1 * before + 2)
        (a, _), (b, _) = (picture_channels(self.folder / name) for name in ("a.exr", "b.exr"))
        mean = lambda values: sum(values) / len(values)
        self.assertAlmostEqual(mean(a["G"]), mean(b["G"]), delta=0.02 * mean(a["G"]))

    def test_aspect_is_of_records_in_media_too(self):
        for flags, aspect in (((), 4), (("--aspect", "1"), 1)):
            self.stats(FOG, *quick("--method", "marco2018", *flags, "--save-cache", "records"))
            self.assertIn(b", aspect %d, " % aspect, (self.folder / "records").read_bytes())

    def test_paths_make_no_records_in_media(self):
        stats = self.stats(FOG, *quick("--media", "paths", "-o", "a.exr"))
        self.assertIsNone(stats["media"])

    def test_what_does_not_go_together_is_refused(self):
        for flags, text in (
            (("--media", "paths", "--media-a", "0.5"), "--media-..."),
            (("--media", "cache", "--order", "lazy", "--method", "bounded"), "--order lazy"),
            (("--media", "cache", "--max-depth", "3"), "--max-depth"),
            (("--media-estimator", "volume", "--media-metric", "volume-error"), "Hessian"),
            (("--media", "somehow"), "cache or paths"),
        ):
            self.refused(2, ("render", FOG, *flags, "-o", "x.exr"), text)

    def test_pictures_of_records_in_media_are_slices(self):
        self.done("render", FOG, *quick("--save-cache", "records"))
        told = {}
        for name, flags in (("default", ()), ("side", ("--slice", "4,2,2;-4,0,0")), ("behind", ("--slice", "0,0,9;0,0,1"))):
            picture = name + ".png"
            said = self.done("render", FOG, *quick("--load-cache", "records", "--show-records", picture, *flags)).stdout
            told[name] = re.search(rf"^{name}\.png: media on the slice ([^ ]+), ", said, re.MULTILINE)[1]
            self.assertEqual(png_size(self.folder / picture), (32, 32))
        self.assertEqual(told["side"], "4,2,2;-1,0,0")
        self.assertTrue(told["default"].endswith(";0,0,1"), told)
        self.assertEqual(len({(self.folder / (name + ".png")).read_bytes() for name in told}), 3)
        # What is told says the same again.
        self.done("render", FOG, *quick("--load-cache", "records", "--show-records", "again.png", "--slice", told["side"]))
        self.assertEqual((self.folder / "again.png").read_bytes(), (self.folder / "side.png").read_bytes())

    def test_slices_without_records_in_media_are_refused(self):
        plane = ("--slice", "1,1,1;0,0,1")
        self.refused(2, ("render", FOG, *quick(*plane, "-o", "a.png")), "--slice", "--show-records")
        self.refused(2, ("render", BOX, *quick(*plane, "--show-records", "a.png")), "--slice", "no media")
        self.refused(2, ("render", FOG, *quick(*plane, "--show-records", "a.png", "--media", "paths")), "--slice", "--media cache")
