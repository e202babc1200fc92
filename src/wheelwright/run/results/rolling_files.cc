#include "wheelwright/run/results/rolling_files.h"

#include <fmt/format.h>

#include <numbers>

#include "wheelwright/files/atomic_file.h"

namespace wheelwright {

template <int dim>
RollingFiles<dim>::RollingFiles(std::filesystem::path run, const LevelSet<dim>& shape,
                                const StateSolver<dim>& solver, const State<dim>& solution)
    : run_(std::move(run)),
      mesh_(shape, displacement_lattice(solver.model()), vtu_cut_subdivisions<dim>, "m",
            layers_of_rows(solver.model())),
      treads_(all_tread_contacts(solver, solution)) {
  make_subfolder(run_ / "rolling");
}

template <int dim>
void RollingFiles<dim>::write(int position, const PositionFields<dim>& fields) {
  const auto file = [&](const char* part) { return fmt::format("rolling/{}_{:02d}.vtu", part, position); };
  mesh_.write(run_ / file("wheel"), named_fields(fields));
  write_tread_vtu<dim>(run_ / file("tread"), treads_[position]);
  write_ground_vtu(run_ / file("ground"), fields.lattice.grid(), fields.ground_azimuth, fields.ground,
                   fields.camber);
  const double degrees = fields.ground_azimuth * 180 / std::numbers::pi;
  for (const char* part : {"wheel", "tread", "ground"})
    entries_.push_back({degrees, file(part), static_cast<int>(entries_.size() % 3), part});
}

template <int dim>
void RollingFiles<dim>::write_collection() const {
  write_pvd(run_ / "rolling.pvd", entries_);
}

template class RollingFiles<2>;
template class RollingFiles<3>;

}  // namespace wheelwright
