import json

from program import BOX, ProgramTest, picture_channels, png_size, quick


class Compare(ProgramTest):
    def setUp(self):
        super().setUp()
        for seed in ("1", "2"):
            self.done("render", BOX, *quick("--method", "path", "--seed", seed, "-o", seed + ".exr"))

    def measured(self, *arguments):
        return json.loads(self.done("compare", *arguments, "--json").stdout)

    def test_a_picture_is_its_own_equal(self):
        for layer in ((), ("--layer", "irradiance"), ("--layer", "direct")):
            same = self.measured("1.exr", "1.exr", *layer)
            self.assertEqual(set(same), {"rmse", "relative_rmse", "relative_mse", "bias", "block_error", "ssim"})
            self.assertEqual([same[k] for k in ("rmse", "relative_rmse", "relative_mse", "bias", "block_error")], [0] * 5)
            self.assertAlmostEqual(same["ssim"], 1)

    def test_blocks_average_noise_away(self):
        whole, blocks = self.measured("1.exr", "2.exr"), self.measured("1.exr", "2.exr", "--block", "8")
        self.assertGreater(whole["rmse"], 3 * blocks["rmse"])
        self.assertAlmostEqual(whole["bias"], blocks["bias"], places=5)

    def test_a_threshold_is_an_exit_code(self):
        rmse = self.measured("1.exr", "2.exr")["relative_rmse"]
        self.done("compare", "1.exr", "2.exr", "--fail-above", str(rmse * 1.01))
        result = self.run_program("compare", "1.exr", "2.exr", "--fail-above", str(rmse * 0.99))
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertEqual(self.run_program("compare", "1.exr", "1.exr", "--fail-above", "0").returncode, 0)

    def test_what_pictures_have_in_common(self):
        whole = self.measured("1.exr", "2.exr")["rmse"]
        self.assertAlmostEqual(self.measured("1.exr", "2.exr", "--other", "1.exr")["rmse"], whole, delta=1e-6 * whole)
        self.assertEqual(self.measured("1.exr", "2.exr", "--other", "2.exr")["rmse"], 0)
        self.refused(1, ("compare", "1.exr", "2.exr", "--other", "missing.exr"), "missing.exr")

    def test_the_error_picture(self):
        self.done("compare", "1.exr", "2.exr", "--layer", "irradiance", "--error-picture", "error.png")
        self.assertEqual(png_size(self.folder / "error.png"), (32, 32))

    def test_layers_of_one_channel_are_grey(self):
        (one, _), (two, _) = (picture_channels(self.folder / name) for name in ("1.exr", "2.exr"))
        for layer, name in (("depth", "depth.Z"), ("depth.Z", "depth.Z"), ("albedo.G", "albedo.G"), ("A", "A")):
            squares = [(a - b) ** 2 for a, b in zip(one[name], two[name])]
            rmse = (sum(squares) / len(squares)) ** 0.5
            self.assertAlmostEqual(self.measured("1.exr", "2.exr", "--layer", layer)["rmse"], rmse, delta=1e-5 * (rmse + 1e-3))

    def test_the_error_picture_replaces_nothing_that_is_read(self):
        before = {name: (self.folder / name).read_bytes() for name in self.names()}
        for name in ("2.exr", "e.jpg", "e"):
            self.refused(2, ("compare", "1.exr", "2.exr", "--error-picture", name), f"--error-picture {name}", ".png")
        self.assertEqual({name: (self.folder / name).read_bytes() for name in self.names()}, before)
        (self.folder / "2.exr").rename(self.folder / "2.png")
        for arguments in (("1.exr", "2.png"), ("2.png", "1.exr"), ("1.exr", "1.exr", "--second", "2.png"), ("1.exr", "1.exr", "--other", "2.png")):
            self.refused(2, ("compare", *arguments, "--error-picture", "./2.png"), "would overwrite")
        self.assertEqual((self.folder / "2.png").read_bytes(), before["2.exr"])

    def test_what_cannot_be_compared(self):
        self.refused(1, ("compare", "1.exr", "missing.exr"), "missing.exr")
        self.refused(1, ("compare", "1.exr", "2.exr", "--layer", "nonsense"), "1.exr", "nonsense", "irradiance")
        self.done("render", BOX, *quick("--size", "16x16", "-o", "small.exr"))
        self.refused(1, ("compare", "1.exr", "small.exr"), "32", "16")
        self.write("cut.exr", (self.folder / "1.exr").read_bytes()[:5000])
        self.refused(1, ("compare", "cut.exr", "1.exr"), "cut.exr")
        self.refused(1, ("compare", "1.exr", "2.exr", "--error-picture", "nowhere/e.png"), "nowhere/e.png")
        self.refused(2, ("compare", "1.exr", "2.exr", "--block", "0"), "--block")
        for limit in ("much", "nan", "inf", "-0.1"):
            self.refused(2, ("compare", "1.exr", "2.exr", "--fail-above", limit), "--fail-above")
