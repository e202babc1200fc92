#include "wheelwright/run/run_folder.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/write.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/report/pressure_plot.h"
#include "wheelwright/report/solution_fields.h"
#include "wheelwright/report/svg.h"
#include "wheelwright/report/wheel_pictures.h"
#include "wheelwright/run/provenance.h"

namespace wheelwright {
namespace {

constexpr int cut_subdivisions = 4;

std::vector<NamedField> position_fields(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                                        int position) {
  RingField displacement = displacement_field(problem, solution, position);
  RingField von_mises = von_mises_field(problem, solution, displacement);
  return {{"displacement", "m", std::move(displacement)}, {"von_mises", "Pa", std::move(von_mises)}};
}

std::string load_text(const RollingModel<2>& model) {
  return model.travel ? fmt::format("rim travel {:.6g} mm", *model.travel * 1e3)
                      : fmt::format("{:.6g} N/m", model.load);
}

Lattice<2> displacement_lattice(const RollingProblem<2>& problem) {
  return Lattice<2>(problem.model().grid, problem.model().degree);
}

WheelState wheel_state(const std::string& heading, const LevelSet<2>& shape, double objective,
                       double measure) {
  return {heading, material_contours(shape, contour_subdivisions(shape.lattice.degree())), objective,
          volume_fraction(shape.lattice.grid(), measure)};
}

std::string shape_file(int iteration) { return fmt::format("shapes/shape_{:04d}.vtu", iteration); }

/// Name of the folder that the case gives, whether or not it ends in a slash.
std::string folder_name(const Case& c) {
  return (std::filesystem::path(c.output.folder) / "").parent_path().filename().string();
}

}  // namespace

RunFolder::RunFolder(std::filesystem::path folder, const Case& c, std::optional<int> resumed_at)
    : folder_(std::move(folder)), case_(c) {
  make_folder(folder_);
  write_atomically(folder_ / "case.toml", fmt::format("# {}\n\n{}", program_text(), to_toml(c)));
  if (resumed_at) list_shapes(*resumed_at);
}

void RunFolder::list_shapes(int last_iteration) {
  for (int iteration = 0; iteration <= last_iteration; ++iteration)
    if (const std::string file = shape_file(iteration); std::filesystem::exists(folder_ / file))
      shapes_.push_back({static_cast<double>(iteration), file});
  if (!shapes_.empty()) write_list_of_shapes();
}

void RunFolder::write_list_of_shapes() const { write_pvd(folder_ / "shapes.pvd", shapes_); }

void RunFolder::write_shape(const RollingProblem<2>& problem, const OptimizationState<2>& state) {
  const auto solution = problem.solve(state.shape);
  if (!solution) return;  // accepted shapes were solved before; nothing to draw otherwise
  auto fields = position_fields(problem, *solution, worst_position(*solution));
  if (auto velocity =
          Evolver<2>(state.shape.lattice, evolution_options(case_)).velocity(state.evaluation.gradient)) {
    for (double& value : *velocity) value = -value;
    const LevelSet<2> gradient{state.shape.lattice, *std::move(velocity)};
    fields.push_back({"shape_gradient", "Pa", repeated_field(problem, gradient)});
  }

  const std::string file = shape_file(state.iteration);
  make_folder(folder_ / "shapes");
  VtuMesh(state.shape, displacement_lattice(problem), cut_subdivisions).write(folder_ / file, fields);
  shapes_.push_back({static_cast<double>(state.iteration), file});
  write_list_of_shapes();
}

void RunFolder::write_pictures(const RollingProblem<2>& problem, const OptimizationState<2>& state) const {
  const auto solution = problem.solve(state.shape);
  if (!solution) return;
  make_folder(folder_ / "shapes");
  write_wheel_pictures(folder_ / "shapes", fmt::format("shape_{:04d}_", state.iteration),
                       fmt::format("{}, shape {}", title(), state.iteration), problem, *solution,
                       state.shape);
}

std::string RunFolder::title() const { return case_.title.empty() ? folder_name(case_) : case_.title; }

void RunFolder::write_pressures(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                                const std::string& name) const {
  const auto points = contact_points(problem, solution);
  std::vector<double> azimuths;
  for (const GroundPosition& ground : solution.positions.grounds)
    azimuths.push_back(ground.azimuth(problem.model().grid));
  write_pressure_csv(folder_ / fmt::format("pressures_{}.csv", name), points);
  write_atomically(
      folder_ / fmt::format("pressures_{}.svg", name),
      plot_svg(pressure_plot(points, azimuths, fmt::format("Contact pressure, {} shape", name))));
}

void RunFolder::write_result(const RollingProblem<2>& problem, const InitialShape<2>& initial,
                             const OptimizationState<2>& final_state) const {
  const PolarGrid<2>& grid = problem.model().grid;
  const std::string title = this->title();
  const WheelState before = wheel_state("initial", initial.shape, initial.objective, initial.measure);
  const WheelState after =
      wheel_state(fmt::format("after {} shapes", final_state.iteration), final_state.shape,
                  final_state.evaluation.objective, final_state.measure);
  write_atomically(folder_ / "shape.svg", shape_svg(grid, after.contours, title));
  write_atomically(folder_ / "comparison.svg",
                   comparison_svg(grid, {title,
                                         fmt::format("sum over {} load positions, {}",
                                                     problem.model().n_positions, load_text(problem.model())),
                                         "objective", "J/m", before, after}));

  const auto solution = problem.solve(final_state.shape);
  if (!solution) return;
  write_pressures(problem, *solution, "final");
  make_folder(folder_ / "rolling");
  const VtuMesh mesh(final_state.shape, displacement_lattice(problem), cut_subdivisions);
  std::vector<PvdEntry> positions;
  for (int i = 0; i < solution->positions.size(); ++i) {
    const std::string file = fmt::format("rolling/position_{:02d}.vtu", i);
    mesh.write(folder_ / file, position_fields(problem, *solution, i));
    positions.push_back({static_cast<double>(i), file});
  }
  write_pvd(folder_ / "rolling.pvd", positions);
  write_wheel_pictures(folder_, "", title, problem, *solution, final_state.shape);
}

}  // namespace wheelwright
