"""Reads and writes 8-bit PNG, and draws on pictures: rows of RGB bytes. The standard library alone."""
import struct
import zlib

# Five columns a letter, low bit at the top.
FONT = {
    " ": "0000000000", "-": "0808080808", "+": "08083e0808", ".": "0060600000", ",": "0050300000", "%": "2313086462", "(": "001c224100",
    ")": "0041221c00", "/": "2010080402", "=": "1414141414", ":": "0036360000", "|": "00007f0000",
    "0": "3e5149453e", "1": "00427f4000", "2": "4261514946", "3": "2141454b31", "4": "1814127f10", "5": "2745454539", "6": "3c4a494930",
    "7": "0171090503", "8": "3649494936", "9": "064949291e",
    "a": "2054545478", "b": "7f48444438", "c": "3844444420", "d": "384444487f", "e": "3854545418", "f": "087e090102", "g": "0c5252523e",
    "h": "7f08040478", "i": "00447d4000", "j": "2040443d00", "k": "7f10284400", "l": "00417f4000", "m": "7c04180478", "n": "7c08040478",
    "o": "3844444438", "p": "7c14141408", "q": "081414187c", "r": "7c08040408", "s": "4854545420", "t": "043f444020", "u": "3c4040207c",
    "v": "1c2040201c", "w": "3c4030403c", "x": "4428102844", "y": "0c5050503c", "z": "4464544c44",
}
LETTER_WIDTH, LETTER_HEIGHT = 6, 8


def read(path):
    """(width, height, rows) of a picture as `isophote` writes it: 8-bit RGB, not interlaced."""
    data, at, packed = path.read_bytes(), 8, b""
    width = height = 0
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        content = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", content[:10])
            if (depth, colour) != (8, 2):
                raise ValueError(f"{path}: not 8-bit RGB")
        elif kind == b"IDAT":
            packed += content
        at += 12 + size
    raw, stride = zlib.decompress(packed), 3 * width
    rows, above = [], bytes(stride)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        if kind:
            unfilter(kind, row, above)
        above = bytes(row)
        rows.append(above)
    return width, height, rows


def unfilter(kind, row, above):
    for i in range(len(row)):
        left, up, corner = (row[i - 3], above[i], above[i - 3]) if i >= 3 else (0, above[i], 0)
        if kind == 1:
            row[i] = (row[i] + left) & 255
        elif kind == 2:
            row[i] = (row[i] + up) & 255
        elif kind == 3:
            row[i] = (row[i] + (left + up) // 2) & 255
        else:
            p = left + up - corner
            near = min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]
            row[i] = (row[i] + near) & 255


def write(path, width, rows):
    """With a palette of the 256 colours that describe it best, which keeps files small."""
    pixels = [row[i:i + 3] for row in rows for i in range(0, 3 * width, 3)]
    colours, index = palette(pixels)
    lines = b"".join(b"\0" + bytes(index[p] for p in pixels[y * width:(y + 1) * width]) for y in range(len(rows)))

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 3, 0, 0, 0)) +
                     chunk(b"PLTE", b"".join(colours)) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def palette(pixels):
    """256 colours by median cut, and for each colour that occurs the nearest one's place among them."""
    counts = {}
    for p in pixels:
        counts[p] = counts.get(p, 0) + 1
    boxes = [list(counts)]
    while len(boxes) < 256:
        width = lambda box, c: max(p[c] for p in box) - min(p[c] for p in box)
        spread, i, channel = max((max((width(box, c), c) for c in range(3))[0] * len(box) ** 0.5, i,
                                  max((width(box, c), c) for c in range(3))[1]) for i, box in enumerate(boxes))
        if spread == 0:
            break
        box = sorted(boxes.pop(i), key=lambda p: p[channel])
        boxes += [box[:len(box) // 2], box[len(box) // 2:]]
    colours, index = [], {}
    for box in boxes:
        total = sum(counts[p] for p in box)
        for p in box:
            index[p] = len(colours)
        colours.append(bytes(round(sum(p[c] * counts[p] for p in box) / total) for c in range(3)))
    return colours, index


class Canvas:
    def __init__(self, width, height):
        self.width, self.rows = width, [bytearray(b"\xff" * 3 * width) for _ in range(height)]

    def paste(self, picture, x, y):
        width, _, rows = picture
        for i, row in enumerate(rows):
            self.rows[y + i][3 * x:3 * (x + width)] = row

    def text(self, text, x, y):
        for letter in text.lower():
            for column, bits in enumerate(bytes.fromhex(FONT[letter])):
                for row in range(LETTER_HEIGHT):
                    if bits >> row & 1:
                        self.rows[y + row][3 * (x + column):3 * (x + column) + 3] = b"\0\0\0"
            x += LETTER_WIDTH

    def write(self, path):
        write(path, self.width, [bytes(row) for row in self.rows])


def sheet(path, cells, columns=(), gap=4):
    """A contact sheet: rows of (label, picture) below the names of columns; None leaves a cell empty."""
    pictures = [cell[1] for row in cells for cell in row if cell]
    width, height = max(p[0] for p in pictures), max(p[1] for p in pictures)
    label = LETTER_HEIGHT + 4 if any(cell and cell[0] for row in cells for cell in row) else 0
    top, number = (LETTER_HEIGHT + 6 if columns else 0), max(len(row) for row in cells)
    canvas = Canvas(number * (width + gap) + gap, top + len(cells) * (height + label + gap) + gap)
    for i, name in enumerate(columns):
        canvas.text(name, gap + i * (width + gap), 4)
    for j, row in enumerate(cells):
        for i, cell in enumerate(row):
            if cell:
                x, y = gap + i * (width + gap), top + gap + j * (height + label + gap)
                canvas.text(cell[0], x, y)
                canvas.paste(cell[1], x, y + label)
    canvas.write(path)


def crop(picture, x, y, width, height, zoom=1):
    rows = [b"".join(row[3 * i:3 * i + 3] * zoom for i in range(x, x + width)) for row in picture[2][y:y + height] for _ in range(zoom)]
    return width * zoom, height * zoom, rows


def shrink(picture, factor):
    """Means over squares of pixels, as encoded."""
    width, height, rows = picture[0] // factor, picture[1] // factor, []
    for y in range(height):
        block = picture[2][y * factor:(y + 1) * factor]
        rows.append(bytes(sum(row[3 * (x * factor + k) + c] for row in block for k in range(factor)) // factor ** 2
                          for x in range(width) for c in range(3)))
    return width, height, rows
