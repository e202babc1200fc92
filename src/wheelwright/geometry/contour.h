#pragma once

#include <span>
#include <vector>

#include "wheelwright/geometry/level_set.h"

namespace wheelwright {

/// What a boundary curve of the material runs along: the whole rim circle, the whole tread circle, or
/// {psi = 0} (in part along the rim or tread where a hole breaks through them).
enum class ContourKind { rim, tread, free };

/// A closed polyline on the boundary of the full ring's material, Cartesian [m], body frame. The last point
/// joins the first; the material is on the left, so a hole and the rim run clockwise.
struct Contour {
  ContourKind kind;
  std::vector<Vec<2>> points;
};

/// Squares that a cell is divided into along each axis, fine enough for cutting: at degree 2 and 28 x 384
/// cells the polyline stays within 3 micrometres of a hole of 4 cm.
constexpr int contour_subdivisions(int degree) { return 4 * degree; }

/// All boundary curves of {psi < 0} in the full ring, on the isoparametric cells of psi's lattice. Each cell
/// is sampled on `subdivisions` squares along each axis (marching squares; psi at the square's centre decides
/// the ambiguous case), and every vertex lies on the zero of the polynomial. What is smaller than such a
/// square may be lost. The curves are closed and disjoint, and their signed areas add up to the area of the
/// material.
std::vector<Contour> material_contours(const LevelSet<2>& psi, int subdivisions);

/// Enclosed area [m^2]: positive where the material is inside (tread, islands), negative for holes and rim.
double signed_area(const Contour& contour);

/// Length [m].
double perimeter(const Contour& contour);

struct BoundingBox {
  Vec<2> lower, upper;
};
BoundingBox bounding_box(const Contour& contour);

/// A convex piece of one cell's material: 3 to 6 corners in the unit cell, counter-clockwise in
/// (radius, azimuth).
using MaterialPolygon = std::vector<Vec<2>>;

/// Divides the material of a sector into polygons, one list a cell: the whole cell where it is full, squares
/// clipped at {psi = 0} where it is cut. Their edges are those of material_contours() with equal
/// subdivisions.
std::vector<std::vector<MaterialPolygon>> material_polygons(const LevelSet<2>& psi, int subdivisions);

}  // namespace wheelwright
