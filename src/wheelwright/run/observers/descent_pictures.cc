#include "wheelwright/run/observers/descent_pictures.h"

#include <fmt/format.h>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/optimization/optimizer/descent.h"
#include "wheelwright/output/report/sector_svg.h"
#include "wheelwright/run/results/run_title.h"

namespace wheelwright {
namespace {

constexpr int parts = 3;  // of a cell, in each direction

/// The pictures of one shape.
class Pictures {
 public:
  Pictures(const OptimizationState<2>& state, const RunView<2>& run) : state_(state), run_(run) {}

  void draw(const char* what, const SectorScalar& scalar) const {
    write_atomically(run_.folder / fmt::format("shapes/shape_{:04d}_{}.svg", state_.iteration, what),
                     sector_svg(state_.shape, scalar,
                                fmt::format("{}, shape {}", run_title(run_.study.source), state_.iteration),
                                layer_circles(run_.study.model().materials)));
  }

  /// Draws nothing if the velocity could not be computed.
  void draw_extended(const char* what, const char* name,
                     const Expected<std::vector<double>>& velocity) const {
    if (!velocity) return;
    LevelSet<2> gradient{state_.shape.lattice, *velocity};
    for (double& value : gradient.values) value = -value;
    draw(what, {name, unit<2>(UnitKind::stress), parts, values_in_parts(gradient, parts)});
  }

 private:
  const OptimizationState<2>& state_;
  const RunView<2>& run_;
};

}  // namespace

void DescentPictures::operator()(const Event<2>& event, const RunView<2>& run) {
  const auto* done = std::get_if<TrialDone<2>>(&event);
  const int every = run.study.source.output.pictures_every;
  if (!done || done->trial.verdict != Verdict::accepted || every == 0 || done->state.iteration % every != 0)
    return;
  const OptimizationState<2>& state = done->state;
  const auto gradient = state.evaluation.gradient(run.study.optimizer.objective);
  const Pictures pictures(state, run);
  make_subfolder(run.folder / "shapes");
  pictures.draw("gradient",
                {"shape gradient", unit<2>(UnitKind::stress), 1, means_in_cells(run.study.grid(), gradient)});
  pictures.draw_extended("extension", "extended gradient", run.evolver.velocity(gradient));
  pictures.draw_extended("corrected", "volume corrected",
                         descent_velocity(run.evolver, run.study.optimizer, state));
  pictures.draw("level_set",
                {"level set", unit<2>(UnitKind::length), parts, values_in_parts(state.shape, parts)});
}

}  // namespace wheelwright
