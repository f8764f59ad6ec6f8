"""A small chart as SVG."""
import math

COLOURS = ("#666666", "#1b6ca8", "#aaaaaa", "#c1440e", "#2a7f3e", "#7a3e9d", "#b08900", "#008b8b", "#d4669a", "#333333")
WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 640, 400, 70, 36, 170, 50


def ticks(low, high):
    return [m * 10 ** d for d in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
            for m in (1, 2, 5) if low <= m * 10 ** d <= high]


def linear_ticks(low, high):
    step = 10 ** math.floor(math.log10(high - low))
    step *= next(m for m in (0.1, 0.2, 0.5, 1) if (high - low) / (m * step) <= 10)
    return [i * step for i in range(math.ceil(low / step), math.floor(high / step) + 1)]


def log_log(path, title, x_label, y_label, series):
    xs = [x for points in series.values() for x, _ in points]
    ys = [y for points in series.values() for _, y in points if y > 0]
    bounds = min(xs) / 1.2, max(xs) * 1.2, min(ys) / 1.2, max(ys) * 1.2
    series = {name: [p for p in points if p[1] > 0] for name, points in series.items()}
    draw(path, title, x_label, y_label, series, bounds, ticks, lambda v, low, high: math.log(v / low) / math.log(high / low), True)


def linear(path, title, x_label, y_label, series, y_bounds):
    xs = [x for points in series.values() for x, _ in points]
    inside = {name: [p for p in points if y_bounds[0] <= p[1] <= y_bounds[1]] for name, points in series.items()}
    draw(path, title, x_label, y_label, inside, (min(xs), max(xs), *y_bounds), linear_ticks, lambda v, low, high: (v - low) / (high - low), False)


def draw(path, title, x_label, y_label, series, bounds, ticks_of, part, dots):
    """`part(v, low, high)` is how far along an axis v lies, from 0 to 1. A series of one point is a dot."""
    x0, x1, y0, y1 = bounds

    def px(x):
        return LEFT + (WIDTH - LEFT - RIGHT) * part(x, x0, x1)

    def py(y):
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * part(y, y0, y1)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/><text x="{LEFT}" y="20" font-size="14">{title}</text>']
    for x in ticks_of(x0, x1):
        out.append(f'<path d="M{px(x):.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#eeeeee"/>'
                   f'<text x="{px(x):.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{x:g}</text>')
    for y in ticks_of(y0, y1):
        out.append(f'<path d="M{LEFT} {py(y):.1f}H{WIDTH - RIGHT}" stroke="#eeeeee"/>'
                   f'<text x="{LEFT - 6}" y="{py(y) + 4:.1f}" text-anchor="end">{y:g}</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 12}" text-anchor="middle">{x_label}</text>')
    out.append(f'<text transform="translate(16 {(TOP + HEIGHT - BOTTOM) / 2}) rotate(-90)" text-anchor="middle">{y_label}</text>')
    for i, (name, points) in enumerate(series.items()):
        colour = COLOURS[i % len(COLOURS)]
        line = " ".join(f"{px(x):.1f},{py(y):.1f}" for x, y in points)
        out.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
        if dots or len(points) == 1:
            out += [f'<circle cx="{px(x):.1f}" cy="{py(y):.1f}" r="3" fill="{colour}"/>' for x, y in points]
        out.append(f'<text x="{WIDTH - RIGHT + 12}" y="{TOP + 18 + 18 * i}" fill="{colour}">{name}</text>')
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(out + ["</svg>\n"]))
