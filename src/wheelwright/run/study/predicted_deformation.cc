#include "wheelwright/run/study/predicted_deformation.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/coarse_grid.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/layers.h"
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

/// Whether a failure of the coarse grid tells about the wheel: at large deformation it does unless the model
/// cannot be solved at all.
bool tells_about_wheel(FailureReason reason, const Case& c) {
  return reason == FailureReason::rim_under_ground || reason == FailureReason::material_overlaps ||
         reason == FailureReason::overload || reason == FailureReason::sliding ||
         (has_large_strains(c) &&
          (reason == FailureReason::not_positive_definite || reason == FailureReason::newton_stalled));
}

Expected<DeformationSize> deformation_of(const Case& c, const Interrupt& interrupt) {
  const auto solver = make_solver(rolling_model<2>(c));
  if (!solver) return solver.failure();
  const LevelSet<2> shape = initial_shape<2>(c);
  const auto state = (*solver)->states(shape, (*solver)->distinct_positions(shape), interrupt);
  if (!state) return state.failure();
  return deformation_size(**solver, shape, **state);
}

std::string warning(const PredictedDeformation& predicted) {
  const auto& size = predicted.size;
  const std::string text = size ? deformation_warning(*size) : size.failure().detail;
  if (text.empty()) return "";
  const bool is_sought = !size && size.failure().reason == FailureReason::newton_stalled;
  const std::string hint =
      is_sought ? "; the load may be far more than the wheel carries, and `wheelwright analyze` with --loads "
                  "from a tenth of it on shows how much that is"
                : "";
  return fmt::format("{}the initial shape on {}: {}{}",
                     predicted.load_case.empty() ? "" : fmt::format("load case {}: ", predicted.load_case),
                     predicted.grid, text, hint);
}

/// Spokes of a few cells that bend and buckle are too stiff on a coarse grid.
bool is_rough(const DeformationSize& size) {
  constexpr double large_travel = 0.15, large_strain = 0.4;
  return size.travel > large_travel || size.strain > large_strain;
}

}  // namespace

Case on_predicting_grid(Case c) {
  c.load.positions = std::min(c.load.positions, most_positions);
  c.grid.tread_levels.reset();
  return on_coarser_grid(c, level_with_few_cells(c, most_cells));
}

Expected<DeformationSize> predicted_size(const Case& c) { return deformation_of(on_predicting_grid(c), {}); }

std::vector<PredictedDeformation> predicted_deformations(const Case& c, const Interrupt& interrupt) {
  if (!is_prismatic(c)) return {};
  std::vector<PredictedDeformation> result;
  const auto add = [&](const Case& of_load, const std::string& load_case) {
    const Case coarse = on_predicting_grid(in_the_plane(of_load));
    auto size = deformation_of(coarse, interrupt);
    if (size || tells_about_wheel(size.failure().reason, c))
      result.push_back({load_case, grid_text(coarse), std::move(size)});
  };
  if (c.load.cases.empty()) add(c, "");
  for (std::size_t k = 0; k < c.load.cases.size(); ++k)
    add(with_load_case(c, static_cast<int>(k)), c.load.cases[k].name);
  return result;
}

std::string prediction_note(std::span<const PredictedDeformation> predicted) {
  std::string note;
  for (const auto& [load_case, grid, size] : predicted)
    if (size)
      note += fmt::format(
          "  {:<22}{}travel up to {:.2g} % of the ring's thickness, strains up to {:.2g} %, on {}{}\n",
          "initial shape", load_case.empty() ? "" : load_case + ": ", 100 * size->travel, 100 * size->strain,
          grid, is_rough(*size) ? "; on a finer grid they may be larger by a third or more" : "");
  return note;
}

std::optional<std::string> prediction_warning(std::span<const PredictedDeformation> predicted) {
  for (const PredictedDeformation& of_load : predicted)
    if (std::string text = warning(of_load); !text.empty()) return text;
  return {};
}

}  // namespace wheelwright
