"""Writes OpenVDB files: one fog volume of half floats. The same calls give the same bytes."""

import struct

LEAF, LOWER, UPPER = 3, 4, 5  # log2 of how many children a node of a level has along each axis


def text(s):
    return struct.pack("<I", len(s)) + s.encode()


def metadata(entries):
    """`entries` are (name, type, bytes)."""
    out = struct.pack("<I", len(entries))
    for name, kind, value in entries:
        out += text(name) + text(kind) + struct.pack("<I", len(value)) + value
    return out


def mask(indices, log2):
    bits = bytearray((1 << 3 * log2) // 8)
    for i in indices:
        bits[i >> 3] |= 1 << (i & 7)
    return bytes(bits)


def child_index(point, level_below, log2):
    """Which child of a node holds a point, children being 2^level_below wide."""
    x, y, z = ((p >> level_below) & ((1 << log2) - 1) for p in point)
    return (x << 2 * log2) | (y << log2) | z


def uniform_transform(voxel, origin):
    """Scales by `voxel`, then moves by `origin`, with the inverses that the format also wants."""
    vectors = [origin, (voxel,) * 3, (voxel,) * 3, (1 / voxel,) * 3, (1 / voxel ** 2,) * 3, (0.5 / voxel,) * 3]
    return text("UniformScaleTranslateMap") + b"".join(struct.pack("<3d", *v) for v in vectors)


def tree(values):
    """Topology and buffers of a tree with these values > 0 at points with coordinates from 0 to 127."""
    leaves = {}
    for point, value in values.items():
        assert all(0 <= p < 1 << LEAF + LOWER for p in point)
        leaf = leaves.setdefault(child_index(point, LEAF, LOWER), {})
        leaf[child_index(point, 0, LEAF)] = value
    background = struct.pack("<f", 0)
    plain = b"\0"  # all that is inactive has the background's value
    topology = struct.pack("<I", 1) + background + struct.pack("<II", 0, 1) + struct.pack("<3i", 0, 0, 0)
    topology += mask([0], UPPER) + mask([], UPPER) + plain
    topology += mask(leaves, LOWER) + mask([], LOWER) + plain
    buffers = b""
    for _, leaf in sorted(leaves.items()):
        active = mask(leaf, LEAF)
        topology += active
        buffers += active + plain + b"".join(struct.pack("<e", leaf[i]) for i in sorted(leaf))
    return topology, buffers


def vdb(name, values, voxel, origin):
    """A file with one grid; `values` are those at points (i, j, k), the point 0 lies at `origin`, m."""
    version, library, unique = 224, (10, 0), "00000000-0000-0000-0000-000000000000"
    head = struct.pack("<qIII?", 0x56444220, version, *library, True) + unique.encode()
    head += metadata([("creator", "string", b"isophote tools/make-scenes")]) + struct.pack("<i", 1)
    head += text(name) + text("Tree_float_5_4_3_HalfFloat") + text("")
    active_mask_compression = struct.pack("<I", 2)
    grid = active_mask_compression + metadata([("class", "string", b"fog volume"), ("is_saved_as_half_float", "bool", b"\1"),
                                               ("name", "string", name.encode())])
    grid += uniform_transform(voxel, origin)
    topology, buffers = tree(values)
    start = len(head) + 24
    block = start + len(grid) + len(topology)
    return head + struct.pack("<3q", start, block, block + len(buffers)) + grid + topology + buffers
