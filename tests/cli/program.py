"""What the tests of the program share: running it in a scratch folder, and reading what it writes."""
import json
import os
import struct
import subprocess
import tempfile
import unittest
import zlib
from pathlib import Path

PROGRAM = os.environ["ISOPHOTE_PROGRAM"]
SCENES = Path(__file__).resolve().parents[2] / "scenes"
BOX = str(SCENES / "cornell-box.glb")


def quick(*flags):
    """Flags of a picture within a second, where `flags` say nothing else."""
    defaults = {"--size": "32x32", "--spp": "2", "--rays": "50", "--error": "0.05"}
    if "--a" in flags or "--records" in flags:
        del defaults["--error"]  # which decides the same
    return [part for pair in defaults.items() if pair[0] not in flags for part in pair] + list(flags)


def picture_channels(path):
    """{name: values} of an EXR file as the program writes it: scan lines, ZIP, 32-bit floats; and (width, height)."""
    data = Path(path).read_bytes()
    assert data[:8] == b"\x76\x2f\x31\x01\x02\x00\x00\x00", path
    at, header = 8, {}
    while data[at] != 0:
        name_end = data.index(0, at)
        type_end = data.index(0, name_end + 1)
        size, = struct.unpack_from("<i", data, type_end + 1)
        header[data[at:name_end].decode()] = data[type_end + 5:type_end + 5 + size]
        at = type_end + 5 + size
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    assert header["compression"] == b"\x03"
    names, channels = [], header["channels"]
    while channels[0] != 0:
        end = channels.index(0)
        names.append(channels[:end].decode())
        assert channels[end + 1] == 2, "not float"
        channels = channels[end + 17:]
    at += 1
    values = {name: [] for name in names}
    for offset in struct.unpack_from("<%dQ" % -(-height // 16), data, at):
        first, size = struct.unpack_from("<2i", data, offset)
        rows = min(16, y1 + 1 - first)
        packed = data[offset + 8:offset + 8 + size]
        whole = 4 * width * len(names) * rows
        for row in range(rows):
            for i, name in enumerate(names):
                start = 4 * width * (row * len(names) + i)
                if row == 0 and i == 0:
                    block = packed if size == whole else unpack(packed)
                values[name] += struct.unpack_from("<%df" % width, block, start)
    return values, (width, height)


def unpack(packed):
    """Undoes OpenEXR's ZIP: deflate, differences of bytes, even bytes before odd ones."""
    data = bytearray(zlib.decompress(packed))
    for i in range(1, len(data)):
        data[i] = (data[i - 1] + data[i] - 128) & 255
    half = (len(data) + 1) // 2
    result = bytearray(len(data))
    result[0::2], result[1::2] = data[:half], data[half:]
    return bytes(result)


def png_size(path):
    """(width, height) of a PNG file whose chunks and pixel data are whole; 8-bit RGB."""
    data = Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    at, pixels, kinds = 8, b"", []
    while at < len(data):
        size, = struct.unpack_from(">I", data, at)
        kind, content = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        assert zlib.crc32(kind + content) == struct.unpack_from(">I", data, at + 8 + size)[0], kind
        kinds.append(kind)
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack_from(">IIBB", content)
        if kind == b"IDAT":
            pixels += content
        at += size + 12
    assert kinds[0] == b"IHDR" and kinds[-1] == b"IEND" and (depth, colour) == (8, 2)
    assert len(zlib.decompress(pixels)) == height * (1 + 3 * width)
    return width, height


class ProgramTest(unittest.TestCase):
    """Each test runs the program in a fresh folder."""

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, check=False,
                              stdin=subprocess.DEVNULL)

    def done(self, *arguments):
        """A run that must succeed, and be silent on standard error."""
        result = self.run_program(*arguments)
        self.assertEqual((result.returncode, result.stderr), (0, ""), arguments)
        return result

    def start(self, *arguments):
        """A run in the background; ended with the test, if it has not ended by itself."""
        process = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)

        def end():
            process.kill()
            process.communicate()

        self.addCleanup(end)
        return process

    def stats(self, *arguments):
        """The statistics of a render that must succeed."""
        self.done("render", *arguments, "--stats", "stats.json")
        return json.loads((self.folder / "stats.json").read_text(encoding="utf-8"))

    def names(self):
        return sorted(p.name for p in self.folder.iterdir())

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def refused(self, code, arguments, *mentions):
        """Exit code, one line that mentions what is wrong, nothing else said, nothing left behind."""
        before = self.names()
        result = self.run_program(*arguments)
        self.assertEqual(result.returncode, code, (arguments, result.stderr))
        self.assertEqual(result.stdout, "", arguments)
        self.assertEqual(result.stderr.count("\n"), 1, (arguments, result.stderr))
        self.assertTrue(result.stderr.startswith("isophote: "), (arguments, result.stderr))
        for mention in mentions:
            self.assertIn(mention, result.stderr, arguments)
        self.assertEqual(self.names(), before, arguments)
