#include "wheelwright/evolution/evolver.h"

#include <numeric>

#include "wheelwright/evolution/multilinear.h"
#include "wheelwright/evolution/redistance.h"
#include "wheelwright/evolution/sub_cell_filter.h"
#include "wheelwright/evolution/transport.h"
#include "wheelwright/geometry/finite.h"
#include "wheelwright/geometry/mirror.h"

namespace wheelwright {

namespace {

double largest_magnitude(std::span<const double> values) {
  double largest = 0;
  for (double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

}  // namespace

template <int dim>
Evolver<dim>::Evolver(const Lattice<dim>& lattice, const EvolutionOptions& options)
    : lattice_(lattice),
      bands_(lattice, options.bands),
      extension_(make_velocity_extension<dim>(lattice, bands_, options.velocity)),
      features_(options.features),
      cut_points_(options.cut_points) {
  if (options.smoothing > 0)
    smoother_.emplace(lattice, std::sqrt(options.smoothing) * lattice.grid().resolution());
}

template <int dim>
template <class Extend>
Expected<std::vector<double>> Evolver<dim>::movable_velocity(std::span<const SurfaceSample<dim>> gradient,
                                                             Extend extend) const {
  auto velocity = extend(gradient);
  if (!velocity) return velocity;
  const auto movable = movable_samples<dim>(lattice_, bands_, gradient, *velocity);
  return movable.size() == gradient.size() ? velocity : extend(movable);
}

template <int dim>
Expected<std::vector<double>> Evolver<dim>::velocity(std::span<const SurfaceSample<dim>> gradient) const {
  return movable_velocity(
      gradient, [&](std::span<const SurfaceSample<dim>> samples) { return (*extension_)(samples); });
}

template <int dim>
Expected<std::vector<double>> Evolver<dim>::measure_preserving_velocity(
    std::span<const SurfaceSample<dim>> gradient) const {
  return movable_velocity(gradient, [&](std::span<const SurfaceSample<dim>> samples) {
    return wheelwright::measure_preserving_velocity<dim>(lattice_, *extension_, samples);
  });
}

/// Post-processes the result of a stage: applies the sub-cell filter, restores mirror symmetry if the input
/// of the stage had it, and clips holes at the protected bands. Clipping could hide an infinity, so that
/// values are checked first.
template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::finished(const LevelSet<dim>& psi, bool is_symmetric,
                                               const char* what) const {
  if (auto failure = check_finite<dim>(lattice_, psi.values, what)) return *failure;
  LevelSet<dim> filtered = sub_cell_filter(psi);
  return bands_.keep(is_symmetric ? mirror_symmetric_part(filtered) : std::move(filtered));
}

template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::move(const LevelSet<dim>& psi, std::span<const double> velocity,
                                           double distance) const {
  if (auto failure = check_finite<dim>(psi.lattice, velocity, "the velocity")) return *failure;
  const double time = distance / largest_magnitude(velocity);
  if (!std::isfinite(time)) return Failure{FailureReason::not_finite, "the velocity vanishes"};
  const bool is_symmetric =
      is_mirror_symmetric(psi) &&
      is_mirror_symmetric<dim>(psi.lattice, velocity, 1e-9 * largest_magnitude(velocity));
  return finished(transport<dim>(psi, velocity, time), is_symmetric, "the level set after transport");
}

template <int dim>
double Evolver<dim>::first_order_change(std::span<const SurfaceSample<dim>> gradient,
                                        std::span<const double> velocity, double distance) const {
  const auto load = boundary_load<dim>(lattice_, gradient);
  return std::inner_product(load.begin(), load.end(), velocity.begin(), 0.0) * distance /
         largest_magnitude(velocity);
}

template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::redistance(const LevelSet<dim>& psi) const {
  if (auto failure = check_finite<dim>(psi.lattice, psi.values, "the level set")) return *failure;
  return finished(wheelwright::redistance<dim>(psi), is_mirror_symmetric(psi),
                  "the level set after redistancing");
}

template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::smooth(const LevelSet<dim>& psi) const {
  if (!smoother_) return psi;
  return finished((*smoother_)(psi), is_mirror_symmetric(psi), "the level set after smoothing");
}

template <int dim>
LevelSet<dim> Evolver<dim>::keep_bands(const LevelSet<dim>& psi) const {
  return bands_.keep(psi);
}

template <int dim>
LevelSet<dim> Evolver<dim>::with_features(const LevelSet<dim>& psi) const {
  if (!features_.any()) return psi;
  LevelSet<dim> result = with_feature_size(psi, features_);
  if (result.values == psi.values) return result;
  return bands_.keep(is_mirror_symmetric(psi) ? mirror_symmetric_part(result) : std::move(result));
}

template <int dim>
Expected<MeasuredShape<dim>> Evolver<dim>::measured(LevelSet<dim> psi) const {
  return wheelwright::measured(with_features(psi), cut_points_);
}

template <int dim>
Expected<MeasuredShape<dim>> Evolver<dim>::with_measure(const LevelSet<dim>& psi, double target,
                                                        double boundary_measure) const {
  constexpr int most_turns = 6;
  LevelSet<dim> shape = with_features(psi);
  for (int turn = 1;; ++turn) {
    auto shifted = wheelwright::with_measure<dim>(shape, bands_, target, boundary_measure, cut_points_);
    if (!shifted || !features_.any() || turn == most_turns) return shifted;
    shape = with_features(shifted->shape);
    if (shape.values == shifted->shape.values) return shifted;
  }
}

template <int dim>
Expected<AttachedShape<dim>> Evolver<dim>::without_islands(const LevelSet<dim>& psi, double largest) const {
  auto attached = wheelwright::without_islands<dim>(psi, largest);
  if (attached) attached->psi = bands_.keep(std::move(attached->psi));
  return attached;
}

template <int dim>
std::vector<ShapeEvent<dim>> Evolver<dim>::changes(const LevelSet<dim>& before,
                                                   const LevelSet<dim>& after) const {
  const auto old = components(before), now = components(after);
  auto events = topology_changes(old, now);
  for (auto& event : bands_.contacts(old, now)) events.push_back(event);
  return events;
}

template class Evolver<2>;
template class Evolver<3>;

}  // namespace wheelwright
