#include "wheelwright/run/study/predicted_deformation.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/quantities/analysis/deformation_size.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright {
namespace {

/// Number of cells that is solved in about a tenth of a second.
constexpr int most_cells = 6'000;

/// With an even number, positions over the middle of a hole and of a spoke are among them.
constexpr int most_positions = 4;

bool is_prismatic(const Case& c) {
  const SavedLevelSet* saved = c.saved_shape.shape.contents.get();
  return c.holes.spheres.empty() && c.holes.tapered.empty() && c.holes.grooves.empty() &&
         !(saved && saved->index() == 1);
}

/// The wheel in 2D, as in the middle of its width.
Case in_the_plane(Case c) {
  c.wheel.dimension = 2;
  c.load.lateral_force = c.load.camber = 0;
  return c;
}

bool is_physical(FailureReason reason) {
  return reason == FailureReason::rim_under_ground || reason == FailureReason::material_overlaps ||
         reason == FailureReason::overload || reason == FailureReason::sliding;
}

Expected<DeformationSize> deformation_of(const Case& c, const Interrupt& interrupt) {
  const auto solver = make_solver(rolling_model<2>(c));
  if (!solver) return solver.failure();
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto state = (*solver)->states(shape, (*solver)->distinct_positions(shape), interrupt);
  if (!state) return state.failure();
  return deformation_size(**solver, shape, **state);
}

/// Under the only load of a case.
std::optional<std::string> predicted_under_load(const Case& source, const Interrupt& interrupt) {
  if (!is_prismatic(source)) return {};
  const Case coarse = on_predicting_grid(in_the_plane(source));
  const auto size = deformation_of(coarse, interrupt);
  if (!size && !is_physical(size.failure().reason)) return {};
  const std::string text = size ? deformation_warning(*size) : size.failure().detail;
  if (text.empty()) return {};
  return fmt::format("the initial shape on {}: {}", grid_text(coarse), text);
}

}  // namespace

Case on_predicting_grid(Case c) {
  c.load.positions = std::min(c.load.positions, most_positions);
  c.grid.tread_levels.reset();
  return on_coarser_grid(c, level_with_few_cells(c, most_cells));
}

Expected<DeformationSize> predicted_size(const Case& c) { return deformation_of(on_predicting_grid(c), {}); }

std::optional<std::string> predicted_deformation(const Case& c, const Interrupt& interrupt) {
  if (c.load.cases.empty()) return predicted_under_load(c, interrupt);
  for (std::size_t k = 0; k < c.load.cases.size(); ++k)
    if (const auto warning = predicted_under_load(with_load_case(c, static_cast<int>(k)), interrupt))
      return fmt::format("load case {}: {}", c.load.cases[k].name, *warning);
  return {};
}

}  // namespace wheelwright
