#include "wheelwright/run/study/plane_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

/// Accepted difference between 2D and 3D.
constexpr double tolerable = 0.1;

constexpr int most_cells_of_a_section = 3'500, axial_cells = 4, positions = 2;

/// The case in 3D with few cells, with its width and free side faces.
Case coarse_solid(Case c) {
  if (!c.load.cases.empty()) c = with_load_case(c, 0);
  c.load.cases.clear();
  c.load.positions = std::min(c.load.positions, positions);
  c.wheel.dimension = 3;
  c.wheel.side_faces = SideFaces::free;
  c.material.plane = Plane::strain;
  c.grid.tread_levels = 0;
  c.grid.level_set_degree = 1;  // in both dimensions, so that they see the same edges
  c.grid.axial_cells = axial_cells;
  Case coarse = on_coarser_grid(c, level_with_few_cells(c, most_cells_of_a_section));
  coarse.grid.axial_cells = axial_cells;
  coarse.grid.tread_levels = 0;
  return coarse;
}

/// Whether spokes are thinner than a cell.
bool has_thin_spokes(const Case& c) {
  const double cell = polar_grid<2>(c).resolution();
  return std::ranges::any_of(c.shapes.spokes,
                             [&](const SpokeShape& spoke) { return spoke.thickness < cell; });
}

/// Of the whole wheel [N/m].
template <int dim>
Expected<double> stiffness(const Case& c, const Interrupt& interrupt) {
  const auto solver = make_solver(rolling_model<dim>(c));
  if (!solver) return solver.failure();
  const LevelSet<dim> shape = initial_shape<dim>(c);
  const auto state = (*solver)->states(shape, (*solver)->distinct_positions(shape), interrupt);
  if (!state) return state.failure();
  double force = 0, travel = 0;
  for (const ContactSummary& contact : contact_summaries<dim>(**state)) {
    force += contact.radial_force;
    travel += contact.travel;
  }
  return force / travel * (dim == 2 ? c.wheel.width : 1);
}

std::string word(Plane plane) { return plane == Plane::strain ? "strain" : "stress"; }

/// e.g. "22 % stiffer".
std::string difference(double error) {
  return fmt::format("{:.0f} % {}", 100 * std::abs(error), error > 0 ? "stiffer" : "softer");
}

}  // namespace

std::optional<Plane> PlaneComparison::recommended() const {
  const Plane nearer =
      std::abs(error(Plane::strain)) < std::abs(error(Plane::stress)) ? Plane::strain : Plane::stress;
  if (std::abs(error(nearer)) > tolerable) return {};
  return nearer;
}

Expected<PlaneComparison> compare_planes(const Case& c, const Interrupt& interrupt) {
  const Case solid = coarse_solid(with_small_strains(c));
  if (solid.grid.radial_cells * solid.grid.angular_cells > 2 * most_cells_of_a_section)
    return Failure{FailureReason::unsupported_model,
                   "layers of materials do not end on the lines of a coarse grid"};
  if (has_thin_spokes(solid))
    return Failure{FailureReason::unsupported_model, "spokes are thinner than the cells of a coarse grid"};
  Case plane = solid;
  plane.wheel.dimension = 2;
  PlaneComparison result{0, 0, 0, grid_text(solid)};
  for (const auto& [value, kind] :
       {std::pair(&result.strain, Plane::strain), {&result.stress, Plane::stress}}) {
    plane.material.plane = kind;
    const auto found = stiffness<2>(plane, interrupt);
    if (!found) return found.failure();
    *value = *found;
  }
  const auto found = stiffness<3>(solid, interrupt);
  if (!found) return found.failure();
  result.solid = *found;
  return result;
}

std::string comparison_text(const Case& c, const PlaneComparison& comparison) {
  const auto best = comparison.recommended();
  const std::string solid = has_large_strains(c)
                                ? fmt::format("for small strains on {}", comparison.grid)
                                : fmt::format("{:.4g} N/mm on {}", comparison.solid / 1e3, comparison.grid);
  return fmt::format("  {:<22}{}; plane strain {}, plane stress {}\n  {:<22}{}\n", "stiffness in 3D", solid,
                     difference(comparison.error(Plane::strain)), difference(comparison.error(Plane::stress)),
                     "recommended",
                     best                   ? fmt::format("material.plane = \"{}\"", word(*best))
                     : has_large_strains(c) ? "neither; large deformation is computed in 2D only"
                                            : "wheel.dimension = 3");
}

std::optional<std::string> plane_warning(const Case& c, const PlaneComparison& comparison) {
  const double error = comparison.error(c.material.plane);
  if (std::abs(error) <= tolerable) return {};
  const auto better = comparison.recommended();
  const Plane other = c.material.plane == Plane::strain ? Plane::stress : Plane::strain;
  const double ring = c.wheel.outer_radius - c.wheel.inner_radius;
  const std::string remedy =
      better ? fmt::format("with material.plane = \"{}\" it is {}", word(*better),
                           difference(comparison.error(*better)))
             : fmt::format("plane {} is {}{}", word(other), difference(comparison.error(other)),
                           has_large_strains(c) ? "" : "; use wheel.dimension = 3");
  return fmt::format(
      "plane {}: the wheel is {} than in 3D on {}, because its width is {:.2g} times the ring's thickness; "
      "{}",
      word(c.material.plane), difference(error), comparison.grid, c.wheel.width / ring, remedy);
}

}  // namespace wheelwright
