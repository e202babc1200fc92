#include "wheelwright/run/result_files.h"

#include <fmt/format.h>

#include <numbers>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/report/solution_fields.h"
#include "wheelwright/report/svg.h"
#include "wheelwright/report/tread_contact.h"
#include "wheelwright/report/vtu.h"
#include "wheelwright/report/wheel_pictures.h"
#include "wheelwright/run/run_title.h"

namespace wheelwright {
namespace {

WheelState<2> wheel_state(const std::string& heading, const LevelSet<2>& shape, double objective,
                       double measure) {
  return {heading, material_contours(shape, contour_subdivisions(shape.lattice.degree())), objective,
          volume_fraction(shape.lattice.grid(), measure)};
}

void write_shapes(const RunView<2>& run, const OptimizationState<2>& last) {
  const PolarGrid<2>& grid = run.study.grid();
  const std::string title = run_title(run.study.source);
  const InitialShape<2>& initial = *run.initial;
  const WheelState<2> before = wheel_state("initial", initial.shape, initial.objective, initial.measure);
  const WheelState<2> after = wheel_state(fmt::format("after {} shapes", last.iteration), last.shape,
                                       last.evaluation.function("objective").value, last.measure);
  write_atomically(run.folder / "shape.svg", shape_svg(grid, after.boundary, title));
  write_atomically(run.folder / "comparison.svg",
                   comparison_svg(grid, {.title = title,
                                         .caption = fmt::format("sum over {} load positions, {}",
                                                                run.study.model().n_positions,
                                                                load_text(run.study.model())),
                                         .objective_name = std::string(name(Quantity::objective)),
                                         .objective_unit = unit<2>(kind(Quantity::objective)),
                                         .before = before,
                                         .after = after}));
}

/// The wheel, its tread and the ground in every load position, at the azimuth of the contact in degrees.
void write_rolling(const RunView<2>& run, const LevelSet<2>& shape,
                   const std::vector<PositionFields<2>>& positions, const std::vector<TreadContact>& treads) {
  make_subfolder(run.folder / "rolling");
  const VtuMesh<2> mesh(shape, positions.front().lattice, vtu_cut_subdivisions);
  std::vector<PvdEntry> entries;
  for (size_t i = 0; i < positions.size(); ++i) {
    const auto file = [&](const char* part) { return fmt::format("rolling/{}_{:02d}.vtu", part, i); };
    const double ground_azimuth = positions[i].ground_azimuth;
    mesh.write(run.folder / file("wheel"), named_fields(positions[i]));
    write_tread_vtu(run.folder / file("tread"), treads[i]);
    write_ground_vtu(run.folder / file("ground"), run.study.grid(), ground_azimuth);
    const double degrees = ground_azimuth * 180 / std::numbers::pi;
    for (const char* part : {"wheel", "tread", "ground"})
      entries.push_back({degrees, file(part), static_cast<int>(entries.size() % 3), part});
  }
  write_pvd(run.folder / "rolling.pvd", entries);
}

}  // namespace

void ResultFiles::operator()(const Event<2>& event, const RunView<2>& run) {
  const auto* ended = std::get_if<RunEnded<2>>(&event);
  if (!ended || !ended->solution) return;
  const LevelSet<2>& shape = ended->state->shape;
  const State<2>& solution = *ended->solution;
  write_shapes(run, *ended->state);
  const auto positions = all_position_fields(*ended->solver, solution);
  write_rolling(run, shape, positions, all_tread_contacts(*ended->solver, solution));
  write_wheel_pictures(
      run.folder, {.prefix = "", .title = run_title(run.study.source), .width = run.study.source.wheel.width},
      shape, solution.domain(), positions[worst_position(solution.strain_energy())]);
}

}  // namespace wheelwright
