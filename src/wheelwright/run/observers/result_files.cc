#include "wheelwright/run/observers/result_files.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "wheelwright/case/layers.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/case/single_load.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/output/report/fatigue_field.h"
#include "wheelwright/output/report/shape_boundary.h"
#include "wheelwright/output/report/solid_mesh.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/output/report/surface_vtp.h"
#include "wheelwright/output/report/svg.h"
#include "wheelwright/output/report/temperature_picture.h"
#include "wheelwright/output/report/wheel_pictures.h"
#include "wheelwright/output/report/workshop_surface.h"
#include "wheelwright/quantities/analysis/shape_summary.h"
#include "wheelwright/run/results/given_wheel.h"
#include "wheelwright/run/results/making.h"
#include "wheelwright/run/results/run_title.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

template <int dim>
WheelState<dim> wheel_state(const RunView<dim>& run, const std::string& heading, const LevelSet<dim>& shape,
                            double objective, double measure) {
  const ShownUnit shown = shown_unit(run.study.source.objective.minimize, run.study.source.wheel);
  return {heading, shape_boundary(shape, run.study.model().degree), objective * shown.factor,
          volume_fraction(shape.lattice.grid(), measure)};
}

void write_for_workshop(const RunView<2>& run, const LevelSet<2>&, const std::vector<Contour>& contours) {
  write_atomically(run.folder / "shape.svg",
                   shape_svg(run.study.grid(), contours, run_title(run.study.source)));
}

void write_for_workshop(const RunView<3>& run, const LevelSet<3>& shape, const SurfaceMesh& of_pictures) {
  const SolidMesh solid = solid_mesh(workshop_surface(of_pictures, shape, run.study.model().degree));
  if (const auto checked = check_solid(solid); !checked)
    throw std::logic_error("shape.stl: " + checked.failure().what);
  write_atomically(run.folder / "shape.stl",
                   stl_file(solid, "wheelwright, millimetres: " + run_title(run.study.source)));
}

template <int dim>
void write_shapes(const RunView<dim>& run, const OptimizationState<dim>& last,
                  const KnownNumber& before_objective) {
  constexpr double not_computed = std::numeric_limits<double>::quiet_NaN();
  const Study<dim> given_by_case = given_study(run.study, *run.initial);
  const LevelSet<dim>& given = given_by_case.initial;
  const auto before = wheel_state(run, "initial", given, before_objective ? *before_objective : not_computed,
                                  material_measure(given));
  const auto after =
      wheel_state(run, fmt::format("after {} shape{}", last.iteration, last.iteration == 1 ? "" : "s"),
                  last.shape, last.evaluation.function("objective").value, last.measure);
  write_for_workshop(run, last.shape, after.boundary);
  const Quantity minimized = minimized_quantity(run.study.source);
  const std::string load = load_text(run.study.model()), sum = sum_over_load_cases(run.study.source);
  const int n = run.study.model().n_positions;
  const bool is_sum = minimized == Quantity() && n > 1;
  const std::string caption = !sum.empty() ? sum
                              : is_sum     ? fmt::format("sum over {} load positions, {}", n, load)
                                           : load;
  write_atomically(
      run.folder / "comparison.svg",
      comparison_svg(run.study.grid(),
                     Comparison<dim>{.title = run_title(run.study.source),
                                     .caption = caption,
                                     .objective_name = name(minimized),
                                     .objective_unit = shown_unit(minimized, run.study.source.wheel).name,
                                     .before = before,
                                     .after = after,
                                     .layers = layer_circles(run.study.model().materials),
                                     .layers_before = layer_circles(given_by_case.model().materials),
                                     .shown = shown_side_face(run.study.source)}));
}

/// The wheel under every load case except the first: its pictures, in the folder load_cases.
template <int dim>
void write_other_load_cases(const RunView<dim>& run, const StateSolver<dim>& solver,
                            const LevelSet<dim>& shape, const State<dim>& first,
                            const DescribedWheel<dim>& wheel) {
  if (run.study.load_cases.size() > 1) make_subfolder(run.folder / "load_cases");
  for (std::size_t k = 1; k < run.study.load_cases.size(); ++k) {
    const auto& [name, model, share] = run.study.load_cases[k];
    const auto state = first.under(with_loads(first.model(), model), Interrupt());
    if (!state) continue;
    write_wheel_pictures(run.folder / "load_cases",
                         {.prefix = name + "_",
                          .title = run_title(run.study.source) + ", " + name,
                          .width = run.study.source.wheel.width,
                          .n_positions = model.n_positions,
                          .shown = shown_side_face(run.study.source)},
                         shape, (*state)->domain(), most_stressed_fields(solver, **state),
                         turn_peaks(wheel.others[k - 1]));
  }
}

void write_surface(const RunView<2>&, const LevelSet<2>&, const PositionFields<2>&) {}

void write_surface(const RunView<3>& run, const LevelSet<3>& shape, const PositionFields<3>& worst) {
  write_atomically(run.folder / "surface.vtp", surface_vtp(shape_boundary(shape, run.study.model().degree),
                                                           worst.lattice, named_fields(worst)));
}

}  // namespace

template <int dim>
void ResultFiles<dim>::operator()(const Event<dim>& event, const RunView<dim>& run) {
  if (const auto* shown = std::get_if<PositionShown<dim>>(&event)) write(*shown, run);
  const auto* ended = std::get_if<RunEnded<dim>>(&event);
  if (!ended || !ended->solution) return;
  if (rolling_) rolling_->write_collection();
  rolling_.reset();
  write_shapes(run, *ended->state, ended->summary->before.objective);
  write_other_load_cases(run, *ended->solver, ended->state->shape, *ended->solution,
                         ended->summary->after.wheel);
}

template <int dim>
void ResultFiles<dim>::write(const PositionShown<dim>& shown, const RunView<dim>& run) {
  const LevelSet<dim>& shape = shown.ended.state->shape;
  const State<dim>& solution = *shown.ended.solution;
  if (run.study.source.output.vtu_every > 0) {
    if (!rolling_) rolling_.emplace(run.folder, shape, *shown.ended.solver, solution);
    rolling_->write(shown.position, shown.fields);
  }
  if (shown.position != most_stressed_position(solution)) return;
  PositionFields<dim> worst = shown.fields;
  worst.fatigue = fatigue_field(*shown.ended.solver, solution, run.study.load_cases);
  worst.temperature = temperature_picture(*shown.ended.solver, solution);
  write_surface(run, shape, worst);
  write_wheel_pictures(run.folder,
                       {.prefix = "",
                        .title = run_title(run.study.source),
                        .width = run.study.source.wheel.width,
                        .n_positions = run.study.model().n_positions,
                        .shown = shown_side_face(run.study.source)},
                       shape, solution.domain(), worst, turn_peaks(shown.ended.summary->after.wheel));
}

template class ResultFiles<2>;
template class ResultFiles<3>;

}  // namespace wheelwright
