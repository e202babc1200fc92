#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "wheelwright/output/report/layer_circles.h"
#include "wheelwright/shape/geometry/contour.h"
#include "wheelwright/shape/geometry/print.h"
#include "wheelwright/shape/surface/surface_mesh.h"

namespace wheelwright {

/// Text for XML 1.0, on one line: & < > " ' as entities, tabs and line ends as spaces, and '?' for characters
/// that XML excludes or that control a terminal.
std::string escape_xml(std::string_view text);

/// The start of an SVG document of this size in pixels: a white card with the title at `left`.
std::string titled_svg(double width, double height, std::string_view title, double left);

/// A path along a full circle about the axle, by two arcs, rounded to this number of decimals.
std::string circle_path(double radius, int decimals);

/// The `d` attribute of a path along the material's boundary, to be filled with the even-odd rule: exact arcs
/// for rim and tread, polylines for the rest. y points down. Points closer than `spacing` [m] to the last one
/// drawn are omitted.
std::string material_path(const PolarGrid<2>& grid, std::span<const Contour> contours, double units_per_metre,
                          int decimals, double spacing);

/// The shape for cutting: an SVG document at true scale, one user unit = 1 mm, rounded to 0.1 micrometre,
/// with the axle at the origin.
std::string shape_svg(const PolarGrid<2>& grid, std::span<const Contour> contours, std::string_view title);

/// The boundary of a shape: closed curves, or a closed surface.
template <int dim>
using Boundary = std::conditional_t<dim == 2, std::vector<Contour>, SurfaceMesh>;

/// One wheel of a comparison.
template <int dim>
struct WheelState {
  std::string heading;  ///< e.g. "initial"
  Boundary<dim> boundary;
  double objective;        ///< NaN: not computed
  double volume_fraction;  ///< measure of the material over that of the full ring; NaN: not computed
};

/// Two wheels side by side, with their numbers.
template <int dim>
struct Comparison {
  std::string title;
  std::string caption;         ///< below the wheels
  std::string objective_name;  ///< e.g. "strain energy"
  std::string objective_unit;  ///< e.g. "J/m"
  WheelState<dim> before, after;
  LayerCircles layers = {};             ///< of the second wheel
  LayerCircles layers_before = {};      ///< of the first; empty: the same
  SideFace shown = SideFace::larger_z;  ///< when dim = 3
};

/// The comparison as an SVG document for pages and README files. In 2D the holes of the first wheel are
/// outlined in the second; in 3D the wheels are lit surfaces.
std::string comparison_svg(const PolarGrid<2>& grid, const Comparison<2>& comparison);
std::string comparison_svg(const PolarGrid<3>& grid, const Comparison<3>& comparison);

}  // namespace wheelwright
