#include "wheelwright/report/wheel_pictures.h"

#include <algorithm>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/report/deformed_svg.h"
#include "wheelwright/report/mesh_svg.h"
#include "wheelwright/report/solution_fields.h"

namespace wheelwright {
namespace {

constexpr double magnification = 20;
constexpr double window_in_thicknesses = 0.75;  // half the view of the contact over the ring's thickness
constexpr double stress_outliers = 0.01;        // at slivers and corners

}  // namespace

int worst_position(const RollingSolution<2>& solution) {
  const auto& energy = solution.strain_energy;
  return static_cast<int>(std::max_element(energy.begin(), energy.end()) - energy.begin());
}

void write_wheel_pictures(const std::filesystem::path& folder, const std::string& prefix,
                          const std::string& title, const RollingProblem<2>& problem,
                          const RollingSolution<2>& solution, const LevelSet<2>& shape) {
  const PolarGrid<2>& grid = problem.model().grid;
  const Lattice<2> lattice(grid, problem.model().degree);
  const int worst = worst_position(solution);
  const double azimuth = solution.positions.grounds[worst].azimuth(grid);
  const RingField displacement = displacement_field(problem, solution, worst);
  const NamedField stress{"von Mises stress", "Pa", von_mises_field(problem, solution, displacement)};
  const NamedField vertical{"displacement down", "m", vertical_field(displacement, azimuth)};
  const auto draw = [&](const char* file, std::optional<double> window, const NamedField& scalar,
                        double outliers) {
    write_atomically(folder / (prefix + file),
                     deformed_svg(shape, lattice,
                                  {title, displacement, magnification, azimuth, window, scalar, outliers}));
  };
  draw("stress.svg", {}, stress, stress_outliers);
  draw("stress_contact.svg", window_in_thicknesses * (grid.outer_radius - grid.inner_radius), stress,
       stress_outliers);
  draw("displacement.svg", {}, vertical, 0);
  write_atomically(folder / (prefix + "mesh.svg"), mesh_svg(shape, solution.domain, title));
}

}  // namespace wheelwright
