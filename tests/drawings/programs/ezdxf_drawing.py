"""Writes ezdxf.dxf with ezdxf: rational splines of degree 2 and 3 (circles and a free one), and a hatch to leave out."""

import math

import ezdxf

document = ezdxf.new("R2010")
document.units = ezdxf.units.MM
space = document.modelspace()


def at(radius, degrees):
    return (radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees)))


x, y = at(270, 15)
corner = math.sqrt(0.5)
offsets = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)]
space.add_rational_spline([(x + 30 * a, y + 30 * b) for a, b in offsets],
                          [1, corner, 1, corner, 1, corner, 1, corner, 1], degree=2,
                          knots=[0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4])
x, y = at(270, 75)  # two half circles of degree 3
for side in (1, -1):
    space.add_rational_spline([(x + 25 * side, y), (x + 25 * side, y + 50 * side), (x - 25 * side, y + 50 * side),
                               (x - 25 * side, y)], [3, 1, 1, 3], degree=3, knots=[0, 0, 0, 0, 1, 1, 1, 1])
x, y = at(265, 140)  # a hyperbola, closed by a line
space.add_rational_spline([(x + 30, y), (x, y + 40), (x - 30, y)], [1, 3, 1], degree=2, knots=[0, 0, 0, 1, 1, 1])
space.add_line((x - 30, y), (x + 30, y))
space.add_circle(at(265, 250), 30)
space.add_hatch().paths.add_polyline_path([at(265, 250), at(250, 260), at(280, 250)], is_closed=True)
document.saveas("ezdxf.dxf")
