#include "wheelwright/run/result_files.h"

#include <fmt/format.h>

#include <limits>
#include <numbers>
#include <stdexcept>

#include "wheelwright/case/shown_value.h"
#include "wheelwright/cut/measure.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/report/shape_boundary.h"
#include "wheelwright/report/solid_mesh.h"
#include "wheelwright/report/solution_fields.h"
#include "wheelwright/report/surface_vtp.h"
#include "wheelwright/report/svg.h"
#include "wheelwright/report/tread_contact.h"
#include "wheelwright/report/vtu.h"
#include "wheelwright/report/wheel_pictures.h"
#include "wheelwright/run/run_title.h"

namespace wheelwright {
namespace {

template <int dim>
WheelState<dim> wheel_state(const RunView<dim>& run, const std::string& heading, const LevelSet<dim>& shape,
                            double objective, double measure) {
  const ShownUnit shown = shown_unit(run.study.source.objective.minimize, run.study.source.wheel);
  return {heading, shape_boundary(shape, run.study.model().degree), objective * shown.factor,
          volume_fraction(shape.lattice.grid(), measure)};
}

void write_for_workshop(const RunView<2>& run, const std::vector<Contour>& contours) {
  write_atomically(run.folder / "shape.svg",
                   shape_svg(run.study.grid(), contours, run_title(run.study.source)));
}

void write_for_workshop(const RunView<3>& run, const SurfaceMesh& surface) {
  const SolidMesh solid = solid_mesh(surface);
  if (const auto checked = check_solid(solid); !checked)
    throw std::logic_error("shape.stl: " + checked.failure().what);
  write_atomically(run.folder / "shape.stl",
                   stl_file(solid, "wheelwright, millimetres: " + run_title(run.study.source)));
}

template <int dim>
void write_shapes(const RunView<dim>& run, const OptimizationState<dim>& last,
                  const KnownNumber& before_objective) {
  constexpr double not_computed = std::numeric_limits<double>::quiet_NaN();
  const LevelSet<dim>& given = run.study.initial;
  const auto before = wheel_state(run, "initial", given, before_objective ? *before_objective : not_computed,
                                  material_measure(given));
  const auto after = wheel_state(run, fmt::format("after {} shapes", last.iteration), last.shape,
                                 last.evaluation.function("objective").value, last.measure);
  write_for_workshop(run, after.boundary);
  const Quantity minimized = run.study.source.objective.minimize;
  const std::string load = load_text(run.study.model());
  write_atomically(
      run.folder / "comparison.svg",
      comparison_svg(run.study.grid(),
                     Comparison<dim>{.title = run_title(run.study.source),
                                     .caption = minimized == Quantity::objective
                                                    ? fmt::format("sum over {} load positions, {}",
                                                                  run.study.model().n_positions, load)
                                                    : load,
                                     .objective_name = std::string(name(minimized)),
                                     .objective_unit = shown_unit(minimized, run.study.source.wheel).name,
                                     .before = before,
                                     .after = after}));
}

/// The wheel, its tread and the ground in every load position, at the azimuth of the contact in degrees.
template <int dim>
class RollingFiles {
 public:
  RollingFiles(const RunView<dim>& run, const LevelSet<dim>& shape, std::vector<TreadContact<dim>> treads)
      : run_(run),
        mesh_(shape, displacement_lattice(run.study.model()), vtu_cut_subdivisions<dim>),
        treads_(std::move(treads)) {
    make_subfolder(run.folder / "rolling");
  }

  void write(int position, const PositionFields<dim>& fields) {
    const auto file = [&](const char* part) { return fmt::format("rolling/{}_{:02d}.vtu", part, position); };
    mesh_.write(run_.folder / file("wheel"), named_fields(fields));
    write_tread_vtu<dim>(run_.folder / file("tread"), treads_[position]);
    write_ground_vtu(run_.folder / file("ground"), run_.study.grid(), fields.ground_azimuth);
    const double degrees = fields.ground_azimuth * 180 / std::numbers::pi;
    for (const char* part : {"wheel", "tread", "ground"})
      entries_.push_back({degrees, file(part), static_cast<int>(entries_.size() % 3), part});
  }

  void write_collection() const { write_pvd(run_.folder / "rolling.pvd", entries_); }

 private:
  const RunView<dim>& run_;
  VtuMesh<dim> mesh_;
  std::vector<TreadContact<dim>> treads_;
  std::vector<PvdEntry> entries_;
};

/// The wheel under every load case but the first one: its pictures in its worst position, in the folder
/// load_cases.
template <int dim>
void write_other_load_cases(const RunView<dim>& run, const StateSolver<dim>& solver,
                            const LevelSet<dim>& shape, const State<dim>& first) {
  if (run.study.load_cases.size() > 1) make_subfolder(run.folder / "load_cases");
  for (std::size_t k = 1; k < run.study.load_cases.size(); ++k) {
    const auto& [name, model] = run.study.load_cases[k];
    const auto state = first.under(with_loads_of(first.model(), model), Interrupt());
    if (!state) continue;
    const int worst = worst_position((*state)->strain_energy());
    for_each_position<dim>(solver, **state, [&](int position, const PositionFields<dim>& fields) {
      if (position == worst)
        write_wheel_pictures(run.folder / "load_cases",
                             {.prefix = name + "_",
                              .title = run_title(run.study.source) + ", " + name,
                              .width = run.study.source.wheel.width},
                             shape, (*state)->domain(), fields);
    });
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
  const auto* ended = std::get_if<RunEnded<dim>>(&event);
  if (!ended || !ended->solution) return;
  const LevelSet<dim>& shape = ended->state->shape;
  const State<dim>& solution = *ended->solution;
  write_shapes(run, *ended->state, ended->summary->before.objective);
  RollingFiles<dim> rolling(run, shape, all_tread_contacts(*ended->solver, solution));
  const int worst = worst_position(solution.strain_energy());
  for_each_position<dim>(*ended->solver, solution, [&](int position, const PositionFields<dim>& fields) {
    rolling.write(position, fields);
    if (position != worst) return;
    write_surface(run, shape, fields);
    write_wheel_pictures(
        run.folder,
        {.prefix = "", .title = run_title(run.study.source), .width = run.study.source.wheel.width}, shape,
        solution.domain(), fields);
  });
  rolling.write_collection();
  write_other_load_cases(run, *ended->solver, shape, solution);
}

template class ResultFiles<2>;
template class ResultFiles<3>;

}  // namespace wheelwright
