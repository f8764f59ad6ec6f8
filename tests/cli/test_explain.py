import json
import re

from program import BOX, SCENES, ProgramTest, png_size, quick


class Explain(ProgramTest):
    def explained(self, scene, pixel, *flags):
        return json.loads(self.done("explain", scene, *quick("--pixel", pixel, "--json", *flags)).stdout)

    def test_the_text(self):
        said = self.done("explain", BOX, *quick("--method", "swept", "--pixel", "8,12", "-o", "around.png")).stdout
        self.assertRegex(said, r"^pixel 8,12 of 32 x 32, method swept, \d+ records\n")
        for wanted in (r"  sees +mesh '", r"material '", r"  at .* m, normal ", r"  from .* m away", r"  radiance .* W/m2/sr: direct .*, indirect ",
                       r"  irradiance .* W/m2, indirect, from \d+ records?; predicted error [0-9.]+%", "records that serve\n",
                       "how far they reach\n", r"around\.png: [0-9.]+ times enlarged"):
            self.assertRegex(said, wanted)
        self.assertEqual(png_size(self.folder / "around.png"), (32, 32))
        serving = said.split("records that serve\n")[1].split("\n\n")[0].splitlines()
        self.assertTrue(serving[0].startswith("  record"))
        self.assertRegex(serving[1], r"^  \d+ red ")
        shares = [float(re.search(r"([0-9.]+)%", row)[1]) for row in serving[1:]]
        self.assertAlmostEqual(sum(shares), 100, delta=0.05)
        for heading in re.finditer(r"(?<=  )\S", serving[0]):
            for row in serving[1:]:
                self.assertEqual(row[heading.start() - 1:heading.start()].strip(), "", row)

    def test_the_json(self):
        for method in ("ward1988", "bounded", "schwarzhaupt2012", "swept", "cached"):
            json_ = self.explained(BOX, "8,12", "--method", method)
            self.assertEqual(set(json_), {"pixel", "size", "method", "records", "surface", "reads_cache", "radiance", "irradiance",
                                          "predicted_error", "serving", "near_misses"})
            self.assertEqual((json_["pixel"], json_["size"], json_["method"]), ([8, 12], [32, 32], method))
            self.assertEqual(set(json_["surface"]), {"mesh", "material", "position", "normal", "mapped_normal", "path_length",
                                                     "depth", "specular_events"})
            for record in json_["serving"]:
                self.assertEqual(set(record), {"record", "position", "distance", "normal_angle", "footprint_error", "weight", "share",
                                               "value", "extrapolated", "predicted_error", "leak_tested", "reach"})
                self.assertEqual(set(record["reach"]), {"semi_axes", "axis", "height", "metric_radius", "less_by_gradient",
                                                        "less_by_neighbours", "raised", "lowered", "gradient_kept", "curvature_kept"})
                self.assertLess(record["record"], json_["records"])
            self.assertAlmostEqual(sum(r["share"] for r in json_["serving"]), 1, places=4)
            for c in range(3):
                value = sum(r["share"] * r["extrapolated"][c] for r in json_["serving"])
                self.assertAlmostEqual(value, json_["irradiance"][c], delta=1e-4 * value + 1e-9)
            for miss in json_["near_misses"]:
                self.assertIn(miss["why"], ("beyond_rim", "facing_away", "in_front", "turned"))

    def test_the_records_of_a_render(self):
        self.done("render", BOX, *quick("--save-cache", "records"))
        whole = (self.folder / "records").read_bytes()
        once, again = (self.explained(BOX, "8,12", *flags) for flags in ((), ("--load-cache", "records")))
        self.assertEqual([r["record"] for r in once["serving"]], [r["record"] for r in again["serving"]])
        self.assertEqual((self.folder / "records").read_bytes(), whole)

    def test_the_records_of_a_refined_render(self):
        # No bound and no neighbour had a say: every radius is what the metric gave with the threshold that refinement came to.
        method = ("--method", "ward1992", "--error", "0.01")
        self.done("render", BOX, *quick(*method, "--refine", "2", "--save-cache", "records"))
        served = self.explained(BOX, "8,12", *method, "--load-cache", "records")["serving"]
        self.assertTrue(served)
        for record in served:
            reach = record["reach"]
            self.assertAlmostEqual(reach["metric_radius"], reach["semi_axes"][0], delta=1e-3 * reach["metric_radius"])
            self.assertFalse(reach["less_by_neighbours"] or reach["raised"] or reach["lowered"])

    def test_pixels_without_records(self):
        said = self.done("explain", str(SCENES / "plate.toml"), *quick("--pixel", "0,0")).stdout
        self.assertRegex(said, r"\n  sees +the sky: no record")
        json_ = self.explained(str(SCENES / "plate.toml"), "0,0", "-o", "sky.png")
        self.assertEqual((json_["surface"], json_["reads_cache"], json_["irradiance"], json_["serving"]), (None, False, None, []))
        self.assertEqual(png_size(self.folder / "sky.png"), (32, 32))
        said = self.done("explain", BOX, *quick("--pixel", "8,12", "--max-depth", "1")).stdout
        self.assertRegex(said, r"\n  sees +mesh .*\n(.*\n)*  but +a surface where --max-depth 1 ")

    def test_what_cannot_be_explained(self):
        def refused(code, flags, *mentions):
            self.refused(code, ("explain", BOX, *quick(*flags)), *mentions)

        for pixel in ("32,0", "0,32", "-1,5", "99999,99999"):
            refused(2, ("--pixel=" + pixel,), pixel, "32 x 32")
        for pixel in ("", "5", "5,", ",5", "a,b", "1.5,2", "1,2,3", "1 2", "9999999999,1"):
            refused(2, ("--pixel=" + pixel,), "--pixel", "X,Y")
        refused(2, (), "--pixel")
        refused(2, ("--pixel", "1,1", "--method", "path"), "path")
        refused(2, ("--pixel", "1,1", "--order", "lazy"), "lazy")
        refused(2, ("--pixel", "1,1", "-o", "out.exr"), "-o out.exr", ".png")
        refused(2, ("--pixel", "1,1", "--stats", "s.json"), "--stats")
        refused(1, ("--pixel", "1,1", "-o", "nowhere/out.png"), "nowhere/out.png")
        refused(1, ("--pixel", "1,1", "--load-cache", "missing"), "missing")
        self.refused(1, ("explain", "missing.glb", "--pixel", "1,1"), "missing.glb")
        (self.folder / "mine.png").write_bytes((SCENES / "cornell-box.glb").read_bytes())
        self.refused(2, ("explain", "mine.png", "--pixel", "1,1", "-o", "mine.png"), "would overwrite")


class Maps(ProgramTest):
    """Pictures in false colours, and the layers they show."""

    def test_pictures_and_their_scales(self):
        said = self.done("render", BOX, *quick("--show-records", "r.png", "--record-colour", "error", "--show-error", "e.png",
                         "--show-density", "d.png", "-o", "out.exr")).stdout
        number = r"([0-9.e+-]+) "
        for name, what, end in (("r", "predicted relative error at the rim", ", logarithmic"), ("e", "predicted relative error", ""),
                                ("d", "records per square metre", ", logarithmic")):
            scale = re.search(rf"^{name}\.png: {what}, from {number}\(violet\) to {number}\(yellow\){end}$", said, re.MULTILINE)
            self.assertLess(float(scale[1]), float(scale[2]), name)
            self.assertEqual(png_size(self.folder / (name + ".png")), (32, 32))
        said = self.done("render", BOX, *quick("--show-records", "radius.png")).stdout
        self.assertIn("radius.png: radius of footprints, m, from ", said)
        self.assertNotEqual((self.folder / "r.png").read_bytes(), (self.folder / "radius.png").read_bytes())

    def test_layers_of_the_cache_can_be_compared(self):
        # With many rays: the records' own noise is predicted too.
        for name, flags in (("coarse", ("--error", "0.05")), ("fine", ("--error", "0.01"))):
            self.done("render", BOX, *quick("--method", "ward1992", "--rays", "4000", *flags, "-o", name + ".exr"))
        for layer, sign in (("error", 1), ("density", -1)):
            difference = json.loads(self.done("compare", "coarse.exr", "fine.exr", "--layer", layer, "--json").stdout)
            self.assertGreater(sign * difference["bias"], 0.2, layer)

    def test_the_path_tracer_has_none(self):
        for flag in ("--show-error", "--show-density"):
            self.refused(2, ("render", BOX, *quick("--method", "path", flag, "a.png")), flag, "path")
        self.done("render", BOX, *quick("--method", "path", "-o", "out.exr"))
        self.refused(1, ("compare", "out.exr", "out.exr", "--layer", "density"), "density", "depth.Z")
        self.refused(2, ("render", BOX, *quick("--record-colour", "error", "-o", "a.png")), "--show-records")
        self.refused(2, ("render", BOX, *quick("--show-records", "a.png", "--record-colour", "blue")), "--record-colour")
