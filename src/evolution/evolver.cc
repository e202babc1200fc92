#include "evolution/evolver.h"

#include "evolution/cell_scale.h"
#include "evolution/redistance.h"
#include "evolution/transport.h"
#include "evolution/volume.h"

namespace wheelwright {

template <int dim>
Evolver<dim>::Evolver(const Lattice<dim>& lattice, const EvolutionOptions& options)
    : lattice_(lattice),
      bands_(lattice, options.rim_band, options.tread_band),
      extension_(make_velocity_extension<dim>(lattice, bands_, options.velocity)) {
  if (options.smoothing > 0)
    smoother_.emplace(lattice, std::sqrt(options.smoothing) * lattice.grid().resolution());
}

template <int dim>
std::vector<double> Evolver<dim>::velocity(std::span<const SurfaceSample<dim>> gradient) const {
  auto velocity = (*extension_)(gradient);
  const auto movable = movable_samples<dim>(lattice_, bands_, gradient, velocity);
  return movable.size() == gradient.size() ? velocity : (*extension_)(movable);
}

template <int dim>
std::vector<double> Evolver<dim>::measure_preserving_velocity(
    std::span<const SurfaceSample<dim>> gradient) const {
  const auto preserving = [&](std::span<const SurfaceSample<dim>> samples) {
    return wheelwright::measure_preserving_velocity<dim>(lattice_, *extension_, samples);
  };
  auto velocity = preserving(gradient);
  const auto movable = movable_samples<dim>(lattice_, bands_, gradient, velocity);
  return movable.size() == gradient.size() ? velocity : preserving(movable);
}

template <int dim>
LevelSet<dim> Evolver<dim>::move(const LevelSet<dim>& psi, std::span<const double> velocity,
                                 double distance) const {
  double fastest = 0;
  for (double v : velocity) fastest = std::max(fastest, std::abs(v));
  return bands_.keep(on_cell_scale(transport<dim>(psi, velocity, distance / fastest)));
}

template <int dim>
LevelSet<dim> Evolver<dim>::redistance(const LevelSet<dim>& psi) const {
  return bands_.keep(on_cell_scale(wheelwright::redistance<dim>(psi)));
}

template <int dim>
LevelSet<dim> Evolver<dim>::smooth(const LevelSet<dim>& psi) const {
  return smoother_ ? bands_.keep(on_cell_scale((*smoother_)(psi))) : psi;
}

template <int dim>
LevelSet<dim> Evolver<dim>::keep_bands(const LevelSet<dim>& psi) const {
  return bands_.keep(psi);
}

template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::with_measure(const LevelSet<dim>& psi, double target,
                                                   double boundary_measure) const {
  return wheelwright::with_measure<dim>(psi, bands_, target, boundary_measure);
}

template class Evolver<2>;
template class Evolver<3>;

}  // namespace wheelwright
