import json
import signal
import time

from program import BOX, ProgramTest, picture_channels, png_size

OUTPUTS = ("-o", "out.exr", "-o", "out.png", "--stats", "stats.json", "--progress", "json")


class Interrupt(ProgramTest):
    def wait_for(self, process, phase, beyond=-1):
        """Until the run reports a phase, more than `beyond` of which is done."""
        for line in process.stderr:
            report = json.loads(line)
            if report["phase"] == phase and report["done"] > beyond:
                return
        self.fail("the run ended early")

    def finish(self, process):
        _, errors = process.communicate(timeout=600)
        for line in errors.splitlines():
            json.loads(line)
        return process.returncode

    def test_the_first_one_finishes_with_what_is_known(self):
        self.done("render", BOX, "--size", "256x256", "--method", "path", "--spp", "1", "--max-depth", "1", "-o", "seen.exr")
        seen = picture_channels(self.folder / "seen.exr")[0]["A"]
        (self.folder / "seen.exr").unlink()
        # Records enough for an hour; what the coarsest level has made covers parts of the picture.
        for which in (signal.SIGINT, signal.SIGTERM):
            process = self.start("render", BOX, "--size", "256x256", "--method", "ward1992", "--a", "0.05", "--rays", "400",
                                 "--preview", "preview.png", *OUTPUTS)
            self.wait_for(process, "build", 0)
            process.send_signal(which)
            self.assertEqual(self.finish(process), 1)
            self.assertEqual(self.names(), ["out.exr", "out.png", "preview.png", "stats.json"])
            channels, _ = picture_channels(self.folder / "out.exr")
            alpha = channels["A"]
            self.assertEqual(set(alpha), {0, 1})
            self.assertGreater(alpha.count(1), 1000)
            for name in ("R", "G", "B", "irradiance.G", "depth.Z"):
                self.assertEqual({v for v, a in zip(channels[name], alpha) if a == 0}, {0}, name)
            self.assertGreater(sum(channels["irradiance.G"]), 0)
            png_size(self.folder / "out.png"), png_size(self.folder / "preview.png")
            stats = json.loads((self.folder / "stats.json").read_text())
            self.assertTrue(stats["cancelled"])
            self.assertEqual((stats["samples"], stats["uncovered"]), (256 * 256, seen.count(1) - alpha.count(1)))

    def test_in_the_final_pass_every_pixel_has_a_sample(self):
        process = self.start("render", BOX, "--size", "128x128", "--method", "path", "--spp", "65536", *OUTPUTS)
        self.wait_for(process, "final")
        process.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(process), 1)
        channels, _ = picture_channels(self.folder / "out.exr")
        self.assertGreater(sum(channels["A"]), 0.9 * 128 * 128)
        stats = json.loads((self.folder / "stats.json").read_text())
        self.assertGreaterEqual(stats["samples"], 128 * 128)
        self.assertLess(stats["samples"], 65536 * 128 * 128)

    def test_in_the_check_the_picture_is_kept_and_finished(self):
        process = self.start("render", BOX, "--size", "64x64", "--error", "0.005", "--spp", "1", *OUTPUTS)
        self.wait_for(process, "check")
        process.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(process), 1)
        stats = json.loads((self.folder / "stats.json").read_text())
        self.assertFalse(stats["cancelled"])
        self.assertEqual(stats["error"], {"asked": 0.005, "points": 0})
        self.assertEqual(stats["samples"], 64 * 64)

    def test_a_second_one_aborts(self):
        self.write("out.exr", "older")
        # One round takes minutes, so that the first signal finds no ear.
        process = self.start("render", BOX, "--size", "64x64", "--rays", "16000000", *OUTPUTS)
        self.wait_for(process, "build")
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        time.sleep(0.5)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        self.assertEqual(self.finish(process), -signal.SIGINT)
        self.assertEqual(self.names(), ["out.exr"])
        self.assertEqual((self.folder / "out.exr").read_bytes(), b"older")
