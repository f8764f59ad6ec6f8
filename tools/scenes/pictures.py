"""Writes PNG and OpenEXR pictures, uncompressed, so that their bytes depend on no library's version."""

import struct
import zlib


def srgb_byte(linear):
    x = min(max(linear, 0.0), 1.0)
    return round(255 * (12.92 * x if x <= 0.0031308 else 1.055 * x ** (1 / 2.4) - 0.055))


def linear_byte(x):
    return round(255 * min(max(x, 0.0), 1.0))


def png(width, height, pixel):
    """`pixel(x, y)` gives 3 or 4 bytes, y from the top."""
    rows = []
    for y in range(height):
        rows.append(b"\0" + b"".join(bytes(pixel(x, y)) for x in range(width)))
    color_type = 2 if len(pixel(0, 0)) == 3 else 6
    data = b"".join(rows)
    stored = b"\x78\x01"
    for start in range(0, len(data), 65535):
        part = data[start:start + 65535]
        last = start + 65535 >= len(data)
        stored += struct.pack("<BHH", last, len(part), len(part) ^ 0xFFFF) + part
    stored += struct.pack(">I", zlib.adler32(data))

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)) +
            chunk(b"IDAT", stored) + chunk(b"IEND", b""))


def exr(width, height, pixel):
    """Channels B, G, R of 32-bit floats; `pixel(x, y)` gives (r, g, b), y from the top."""
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value

    channels = b"".join(c + b"\0" + struct.pack("<iBxxxii", 2, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<II", 20000630, 2)
    header += attribute(b"channels", b"chlist", channels)
    header += attribute(b"compression", b"compression", b"\0")
    header += attribute(b"dataWindow", b"box2i", window)
    header += attribute(b"displayWindow", b"box2i", window)
    header += attribute(b"lineOrder", b"lineOrder", b"\0")
    header += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    header += attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0))
    header += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"
    line_size = 8 + 12 * width
    first = len(header) + 8 * height
    offsets = b"".join(struct.pack("<Q", first + y * line_size) for y in range(height))
    lines = []
    for y in range(height):
        row = [pixel(x, y) for x in range(width)]
        values = [c[k] for k in (2, 1, 0) for c in row]
        lines.append(struct.pack("<ii", y, 12 * width) + struct.pack("<%df" % (3 * width), *values))
    return header + offsets + b"".join(lines)
