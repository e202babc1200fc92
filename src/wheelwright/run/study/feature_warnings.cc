#include "wheelwright/run/study/feature_warnings.h"

#include <fmt/format.h>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/dimension.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/geometry/section.h"

namespace wheelwright {
namespace {

constexpr double mm = 1e3;

/// Relative tolerance for curves and quadratic level sets; of radii more, because they follow from second
/// derivatives.
constexpr double tolerated = 0.01, tolerated_of_radii = 0.05;

bool is_too_narrow(const std::optional<cad::Clearance>& measured, std::optional<double> least) {
  return measured && least && measured->width < (1 - tolerated) * *least;
}

bool is_too_sharp(const std::optional<cad::Bend>& corner, std::optional<double> minimum) {
  return corner && minimum && corner->radius < (1 - tolerated_of_radii) * *minimum;
}

Vec<2> middle(const cad::Clearance& clearance) {
  return {0.5 * (clearance.from[0] + clearance.to[0]), 0.5 * (clearance.from[1] + clearance.to[1])};
}

std::string place(const cad::Clearance& clearance) { return cad::place_of(middle(clearance)); }

/// Whether a wall is a band at the rim or the tread, whose thickness the case gives.
bool is_a_band(const Case& c, const cad::Clearance& wall) {
  const auto [inner, outer] = free_region(c);
  const double radius = norm<2>(middle(wall));
  return radius < inner || radius > outer;
}

std::string too_narrow(const char* what, const cad::Clearance& measured, const char* key, double least) {
  return fmt::format("{} is {:.4g} mm, at {}: optimizer.{} = {:.4g} mm is not met", what, measured.width * mm,
                     place(measured), key, least * mm);
}

}  // namespace

std::vector<std::string> feature_warnings(const Case& c, const OutlineMeasures& measures) {
  const cad::Clearances& measured = measures.clearances;
  std::vector<std::string> result;
  if (is_too_narrow(measured.wall, c.optimizer.minimum_wall))
    result.push_back(
        too_narrow("the thinnest wall", *measured.wall, "minimum_wall", *c.optimizer.minimum_wall));
  if (is_too_narrow(measured.gap, c.optimizer.minimum_gap))
    result.push_back(too_narrow("the narrowest gap", *measured.gap, "minimum_gap", *c.optimizer.minimum_gap));
  if (const auto& corner = measures.roughness ? measures.roughness->internal_corner : std::nullopt;
      is_too_sharp(corner, c.optimizer.minimum_radius))
    result.push_back(
        fmt::format("the sharpest internal corner, at {}, has a radius of {:.3g} mm: "
                    "optimizer.minimum_radius = {:.4g} mm is not met",
                    cad::place_of(corner->place), corner->radius * mm, *c.optimizer.minimum_radius * mm));
  const double cell = polar_grid<2>(c).resolution();
  if (measured.wall && measured.wall->width < least_cells_per_wall * cell && !is_a_band(c, *measured.wall))
    result.push_back(
        fmt::format("the thinnest wall, {:.4g} mm at {}, is only {:.1f} cells thick: its stress is not "
                    "resolved; optimizer.minimum_wall keeps walls thick, a finer grid resolves thinner ones",
                    measured.wall->width * mm, place(*measured.wall), measured.wall->width / cell));
  if (measures.closed_cavities > 0)
    result.push_back(fmt::format(
        "holes that are closed all around: {} in each sector; no tool reaches them, and powder or resin of a "
        "print stays inside; optimizer.made = \"moulded\" or \"printed\" keeps holes open",
        measures.closed_cavities));
  return result;
}

Expected<OutlineMeasures, cad::OutlineFault> initial_outline_measures(const Case& c) {
  return in_dimension_of(c, [&](auto dim) {
    const LevelSet<dim> shape = initial_shape<dim>(c);
    auto measures = outline_measures<dim>(shape);
    if (dim == 3 && measures)
      if (const auto section = outline_measures(mid_plane_section(shape)))
        measures->roughness = section->roughness;
    return measures;
  });
}

}  // namespace wheelwright
