"""The size of a hole, from the points of its contour."""

import math
from dataclasses import dataclass

Point = tuple[float, float]


@dataclass
class Hole:
    length: float  # radial extent [mm]
    width: float  # largest extent across the radial line through the hole's centre [mm]
    outer_radius: float  # farthest from the axle [mm]

    def resembles(self, other: "Hole") -> bool:
        return abs(self.length - other.length) < 0.5 and abs(self.outer_radius - other.outer_radius) < 0.5


def measured(contour: list[Point]) -> Hole:
    """`contour`: the corners of a closed polygon about the origin's ring, in order [mm]."""
    centre = _centre(contour)
    distance = math.hypot(*centre)
    across = [(centre[0] * y - centre[1] * x) / distance for x, y in contour]
    radii = [math.hypot(x, y) for x, y in contour]
    return Hole(max(radii) - min(radii), max(across) - min(across), max(radii))


def _centre(contour: list[Point]) -> Point:
    """Of the area that the polygon encloses."""
    area = x_moment = y_moment = 0.0
    for (x0, y0), (x1, y1) in zip(contour, contour[1:] + contour[:1]):
        cross = x0 * y1 - x1 * y0
        area += cross
        x_moment += (x0 + x1) * cross / 3
        y_moment += (y0 + y1) * cross / 3
    return x_moment / area, y_moment / area
