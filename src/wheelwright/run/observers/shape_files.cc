#include "wheelwright/run/observers/shape_files.h"

#include <fmt/format.h>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/output/report/wheel_pictures.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/run/results/run_title.h"

namespace wheelwright {
namespace {

std::string shape_file(int iteration) { return fmt::format("shapes/shape_{:04d}.vtu", iteration); }

template <int dim>
bool is_due(const TrialDone<dim>& done, int every) {
  return done.trial.verdict == Verdict::accepted && done.trial.solution && every > 0 &&
         done.state.iteration % every == 0;
}

/// The extended shape gradient at the nodes, in the unit of its density; nothing if it cannot be computed.
template <int dim>
std::optional<LevelSet<dim>> shape_gradient_field(const OptimizationState<dim>& state,
                                                  const Evolver<dim>& evolver) {
  auto velocity = evolver.velocity(state.evaluation.gradient("objective"));
  if (!velocity) return {};
  for (double& value : *velocity) value = -value;
  return LevelSet<dim>{state.shape.lattice, *std::move(velocity)};
}

}  // namespace

template <int dim>
void ShapeFiles<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (const auto* started = std::get_if<RunStarted>(&event); started && started->resumed_after)
    list_shapes(run.folder, *started->resumed_after);
  if (const auto* done = std::get_if<TrialDone<dim>>(&event);
      done && is_due(*done, run.study.source.output.vtu_every))
    write(*done, run);
}

template <int dim>
void ShapeFiles<dim>::list_shapes(const std::filesystem::path& folder, int last_iteration) {
  for (int iteration = 0; iteration <= last_iteration; ++iteration)
    if (is_there(folder / shape_file(iteration)))
      shapes_.push_back({static_cast<double>(iteration), shape_file(iteration)});
  if (!shapes_.empty()) write_pvd(folder / "shapes.pvd", shapes_);
}

template <int dim>
void ShapeFiles<dim>::write(const TrialDone<dim>& done, const RunView<dim>& run) {
  const StateSolver<dim>& solver = *run.study.solver;
  const State<dim>& solution = *done.trial.solution;
  const PositionFields<dim> worst = most_stressed_fields(solver, solution, run.study.load_cases);
  auto fields = named_fields(worst);
  if (const auto gradient = shape_gradient_field(done.state, run.evolver))
    fields.push_back(
        {"shape_gradient", unit<dim>(UnitKind::stress), repeated_field(solver.model(), *gradient)});
  const int iteration = done.state.iteration;
  make_subfolder(run.folder / "shapes");
  VtuMesh<dim>(done.state.shape, worst.lattice, vtu_cut_subdivisions<dim>, "m",
               layers_of_rows(solver.model()))
      .write(run.folder / shape_file(iteration), fields);
  std::erase_if(shapes_, [&](const PvdEntry& entry) { return entry.time == iteration; });
  shapes_.push_back({static_cast<double>(iteration), shape_file(iteration)});
  write_pvd(run.folder / "shapes.pvd", shapes_);
}

template <int dim>
void ShapePictures<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  const auto* done = std::get_if<TrialDone<dim>>(&event);
  if (!done || !is_due(*done, run.study.source.output.pictures_every)) return;
  const State<dim>& solution = *done->trial.solution;
  const StateSolver<dim>& solver = *run.study.solver;
  const LevelSet<dim>& shape = done->state.shape;
  const auto& cases = run.study.load_cases;
  make_subfolder(run.folder / "shapes");
  write_wheel_pictures(
      run.folder / "shapes",
      {.prefix = fmt::format("shape_{:04d}_", done->state.iteration),
       .title = fmt::format("{}, shape {}", run_title(run.study.source), done->state.iteration),
       .width = run.study.source.wheel.width,
       .n_positions = run.study.model().n_positions,
       .shown = shown_side_face(run.study.source)},
      shape, solution.domain(), most_stressed_fields(solver, solution, cases),
      turn_peaks<dim>(fatigue_results(solver, shape, solution),
                      fatigue_damage(solver, shape, solution, cases, Interrupt()),
                      heat_results(solver, shape, solution)));
}

template class ShapeFiles<2>;
template class ShapeFiles<3>;
template class ShapePictures<2>;
template class ShapePictures<3>;

}  // namespace wheelwright
