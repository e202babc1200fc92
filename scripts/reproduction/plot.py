"""Line plots as small SVG documents."""

import math
from dataclasses import dataclass
from pathlib import Path

colours = ["#1f6feb", "#d1242f", "#1a7f37", "#9a6700", "#8250df", "#57606a"]


@dataclass
class Curve:
    name: str
    values: list[float]  # one an iteration


def line_plot(path: Path, title: str, y_name: str, curves: list[Curve]) -> None:
    """Curves against the number of the iteration."""
    width, height, left, right, top, bottom = 720, 380, 70, 210, 44, 48
    x_ticks = _ticks(0, max(len(c.values) for c in curves) - 1)
    values = [v for c in curves for v in c.values]
    y_ticks = _ticks(min(values), max(values))

    def x_of(x):
        return left + (width - left - right) * (x - x_ticks[0]) / (x_ticks[-1] - x_ticks[0])

    def y_of(y):
        return height - bottom - (height - top - bottom) * (y - y_ticks[0]) / (y_ticks[-1] - y_ticks[0])

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" font-family="Helvetica,Arial,DejaVu Sans,sans-serif" font-size="13" '
        'fill="#24292f">',
        f"<title>{title}</title>",
        f'<rect width="{width}" height="{height}" fill="#ffffff"/>',
        f'<text x="{left}" y="26" font-size="16" font-weight="600">{title}</text>',
    ]
    for x in x_ticks:
        parts.append(f'<path stroke="#d8dee4" d="M{x_of(x):.1f} {top}V{height - bottom}"/>')
        parts.append(f'<text x="{x_of(x):.1f}" y="{height - bottom + 18}" text-anchor="middle">{x:g}</text>')
    for y in y_ticks:
        parts.append(f'<path stroke="#d8dee4" d="M{left} {y_of(y):.1f}H{width - right}"/>')
        parts.append(f'<text x="{left - 8}" y="{y_of(y) + 4:.1f}" text-anchor="end">{y:g}</text>')
    middle = (left + width - right) / 2
    parts.append(f'<text x="{middle}" y="{height - 10}" text-anchor="middle">iteration</text>')
    parts.append(
        f'<text transform="translate(18 {(top + height - bottom) / 2}) rotate(-90)" '
        f'text-anchor="middle">{y_name}</text>'
    )
    for k, curve in enumerate(curves):
        colour = colours[k % len(colours)]
        points = " ".join(f"{x_of(x):.1f},{y_of(y):.1f}" for x, y in enumerate(curve.values))
        parts.append(f'<polyline fill="none" stroke="{colour}" stroke-width="2" points="{points}"/>')
        y = top + 14 + 22 * k
        parts.append(f'<path stroke="{colour}" stroke-width="2" d="M{width - right + 14} {y - 4}h22"/>')
        parts.append(f'<text x="{width - right + 42}" y="{y}">{curve.name}</text>')
    path.write_text("\n".join(parts) + "\n</svg>\n")


def _ticks(low: float, high: float) -> list[float]:
    """Round numbers, at most about 7, from at most low to at least high."""
    span = max(high - low, 1e-12)
    raw = span / 6
    power = 10 ** math.floor(math.log10(raw))
    step = next(power * m for m in (1, 2, 5, 10) if power * m >= raw * 0.999)
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    return [round(k * step, 12) for k in range(first, last + 1)]
