"""A plume of smoke on a grid of 64 x 96 x 64 voxels: puffs carried up by a turbulent stream that widens.

Uses nothing but + - * / and integers, so that the bytes do not depend on a machine's mathematical library.
"""

from .vdb import vdb

SIZE, VOXEL = (64, 96, 64), 0.03125  # 2 x 3 x 2 m
PUFFS, STEPS = 4200, 44


def mix(n):
    """A number in [0, 1) from an integer, as good as random."""
    n = (n ^ (n >> 16)) * 0x7FEB352D & 0xFFFFFFFF
    n = (n ^ (n >> 15)) * 0x846CA68B & 0xFFFFFFFF
    return (n ^ (n >> 16)) / 4294967296.0


class Potential:
    """Smooth noise with its gradient: values at the points of a lattice, interpolated by quintics."""

    def __init__(self, seed):
        self.seed = seed * 0x9E3779B9
        self.cells = {}

    def corners(self, cell):
        if cell not in self.cells:
            x, y, z = cell
            self.cells[cell] = [mix(self.seed + (x + a) * 73856093 + (y + b) * 19349663 + (z + c) * 83492791 & 0xFFFFFFFF) - 0.5
                                for a in (0, 1) for b in (0, 1) for c in (0, 1)]
        return self.cells[cell]

    def gradient(self, x, y, z):
        i, j, k = int(x // 1), int(y // 1), int(z // 1)
        a, b, c = x - i, y - j, z - k
        u, v, w = (t * t * t * (t * (6 * t - 15) + 10) for t in (a, b, c))
        du, dv, dw = (30 * t * t * (t * (t - 2) + 1) for t in (a, b, c))
        n = self.corners((i, j, k))
        z00, z01, z10, z11 = (n[m] + w * (n[m + 1] - n[m]) for m in (0, 2, 4, 6))
        low, high = z00 + v * (z01 - z00), z10 + v * (z11 - z10)
        d00, d01, d10, d11 = (n[m + 1] - n[m] for m in (0, 2, 4, 6))
        dz_low, dz_high = d00 + v * (d01 - d00), d10 + v * (d11 - d10)
        dy_low, dy_high = z01 - z00, z11 - z10
        return du * (high - low), dv * (dy_low + u * (dy_high - dy_low)), dw * (dz_low + u * (dz_high - dz_low))


POTENTIALS = [[Potential(3 * octave + axis + 1) for axis in range(3)] for octave in range(3)]


def swirl(x, y, z, time):
    """Curl noise: a velocity without divergence, as smoke's is. The eddies rise with the stream, at two thirds of its speed."""
    total = [0.0, 0.0, 0.0]
    scale, strength = 3.1, 0.8
    for noise in POTENTIALS:
        a, b, c = (p.gradient(x * scale, (y - 0.67 * time) * scale, z * scale) for p in noise)
        for axis, value in enumerate((c[1] - b[2], a[2] - c[0], b[0] - a[1])):
            total[axis] += strength * value
        scale, strength = scale * 1.9, strength * 0.6
    return total


def carried(puff):
    """Where a puff is (m, the source being at 0) and how old it is, from 0 to 1."""
    age = (puff + mix(3 * puff + 1)) / PUFFS
    while True:
        puff += 100003
        x, z = 2 * mix(5 * puff) - 1, 2 * mix(7 * puff + 3) - 1
        if x * x + z * z < 1:
            break
    x, y, z = 0.15 * x, 0.0, 0.15 * z
    steps = int(STEPS * age) + 1
    step = 3.0 * age / steps
    for n in range(steps):
        vx, vy, vz = swirl(x, y, z, n * step - 3.0 * age)
        grip = 0.03 + 0.19 * max(y, 0.0)  # eddies take hold slowly
        spread = 0.2 / (0.5 + max(y, 0.0))
        x += step * (grip * vx + spread * x + 0.02 * y)
        y += step * (1.0 - 0.12 * y + grip * vy)
        z += step * (grip * vz + spread * z)
    return (x, y, z), age


def density():
    values = {}
    for puff in range(PUFFS):
        (x, y, z), age = carried(puff)
        radius = 2.2 + 2.6 * age  # voxels
        center = (x / VOXEL + SIZE[0] / 2, y / VOXEL + 3, z / VOXEL + SIZE[2] / 2)
        top = min(1.0, max(0.0, (SIZE[1] - 4 - center[1]) / 22))  # it fades before the grid ends
        amount = 1.1 * top / (radius * radius * radius)
        spans = [range(max(1, int(c - radius)), min(n - 1, int(c + radius) + 2)) for c, n in zip(center, SIZE)]
        for i in spans[0]:
            for j in spans[1]:
                rest = radius * radius - (i - center[0]) * (i - center[0]) - (j - center[1]) * (j - center[1])
                if rest <= 0:
                    continue
                for k in spans[2]:
                    kernel = rest - (k - center[2]) * (k - center[2])
                    if kernel > 0:
                        kernel /= radius * radius
                        values[i, j, k] = values.get((i, j, k), 0.0) + amount * kernel * kernel
    return {p: v for p, v in values.items() if v > 0.001}


def plume():
    """The grid `density`, at most about 1, whose source lies at the origin."""
    return vdb("density", density(), VOXEL, (-SIZE[0] * VOXEL / 2, -3 * VOXEL, -SIZE[2] * VOXEL / 2))
