#include "wheelwright/evolution/evolver.h"

#include <fmt/format.h>

#include <numeric>

#include "wheelwright/evolution/multilinear.h"
#include "wheelwright/evolution/redistance.h"
#include "wheelwright/evolution/spline_level_set.h"
#include "wheelwright/evolution/spline_redistance.h"
#include "wheelwright/evolution/sub_cell_filter.h"
#include "wheelwright/evolution/transport.h"
#include "wheelwright/geometry/finite.h"
#include "wheelwright/geometry/mirror.h"
#include "wheelwright/geometry/place.h"
#include "wheelwright/linalg/dense.h"

namespace wheelwright {

namespace {

constexpr MirrorPlane planes[] = {MirrorPlane::azimuth, MirrorPlane::width};

/// The planes with respect to which a shape is symmetric.
template <int dim>
std::vector<MirrorPlane> symmetries(const LevelSet<dim>& psi) {
  std::vector<MirrorPlane> result;
  for (const MirrorPlane plane : planes)
    if (is_mirror_symmetric(psi, plane)) result.push_back(plane);
  return result;
}

/// How much a velocity may differ from its mirror image, in units of its maximum. Mirror images of load
/// positions are not computed but reflected; halves of the width are computed both.
constexpr double rounding_of(MirrorPlane plane) { return plane == MirrorPlane::azimuth ? 1e-9 : 1e-6; }

}  // namespace

template <int dim>
Evolver<dim>::Evolver(const Lattice<dim>& lattice, const EvolutionOptions& options)
    : lattice_(lattice),
      space_(options.space),
      bands_(lattice, options.bands),
      extension_(make_velocity_extension<dim>(lattice, bands_, options.velocity)),
      deformations_(lattice, bands_.nodes(), options.velocity.length * lattice.grid().resolution(),
                    options.deformation),
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

template <int dim>
std::vector<bool> Evolver<dim>::at_bands(std::span<const SurfacePoint<dim>> boundary) const {
  std::vector<bool> result;
  for (const auto& point : boundary) result.push_back(bands_.touches(point));
  return result;
}

/// A coefficient that may still move by a quarter of what it would is not held: the band clips it.
template <int dim>
std::vector<bool> Evolver<dim>::held_by_bands(const LevelSet<dim>& coefficients,
                                              std::span<const double> velocity, double distance) const {
  constexpr double part = 0.25, least = 0.01;  // of the motion; of a cell
  const double time = distance / largest_magnitude(velocity);
  std::vector<bool> held;
  for (std::size_t node = 0; node < velocity.size(); ++node) {
    const double margin = std::max(-part * time * velocity[node], least * lattice_.grid().resolution());
    held.push_back(velocity[node] < 0 &&
                   bands_.is_clipped(static_cast<int>(node), coefficients.values[node], margin));
  }
  return held;
}

template <int dim>
LevelSet<dim> Evolver<dim>::design_of(const LevelSet<dim>& psi) const {
  return space_ == ShapeSpace::spline ? spline_coefficients(psi) : psi;
}

template <int dim>
LevelSet<dim> Evolver<dim>::shape_of(LevelSet<dim> design) const {
  return bands_.keep(space_ == ShapeSpace::spline ? spline_level_set(bands_.keep(std::move(design)))
                                                  : sub_cell_filter(design));
}

/// Clipping could hide an infinity, so that values are checked first.
template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::finished(LevelSet<dim> design,
                                               const std::vector<MirrorPlane>& symmetries,
                                               const char* what) const {
  if (auto failure = check_finite<dim>(lattice_, design.values, what)) return *failure;
  for (const MirrorPlane plane : symmetries) design = mirror_symmetric_part(design, plane);
  return shape_of(std::move(design));
}

template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::move(const LevelSet<dim>& psi, std::span<const double> velocity,
                                           double distance) const {
  if (auto failure = check_finite<dim>(psi.lattice, psi.values, "the level set")) return *failure;
  if (auto failure = check_finite<dim>(psi.lattice, velocity, "the velocity")) return *failure;
  const double time = distance / largest_magnitude(velocity);
  if (!std::isfinite(time)) return Failure{FailureReason::not_finite, "the velocity vanishes"};
  auto kept = symmetries(psi);
  std::erase_if(kept, [&](MirrorPlane plane) {
    return !is_mirror_symmetric<dim>(psi.lattice, velocity, rounding_of(plane) * largest_magnitude(velocity),
                                     plane);
  });
  const auto move = space_ == ShapeSpace::spline ? smooth_transport<dim> : transport<dim>;
  return finished(move(design_of(psi), velocity, time), kept, "the level set after transport");
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
  auto design = space_ == ShapeSpace::spline ? redistanced_coefficients(psi) : wheelwright::redistance(psi);
  return finished(std::move(design), symmetries(psi), "the level set after redistancing");
}

template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::distance(const LevelSet<dim>& psi) const {
  if (auto failure = check_finite<dim>(psi.lattice, psi.values, "the level set")) return *failure;
  auto distance = wheelwright::redistance<dim>(psi);
  if (auto failure = check_finite<dim>(lattice_, distance.values, "the signed distance")) return *failure;
  return bands_.keep(with_symmetries_of(psi, std::move(distance)));
}

template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::smooth(const LevelSet<dim>& psi) const {
  if (!smoother_) return psi;
  if (auto failure = check_finite<dim>(psi.lattice, psi.values, "the level set")) return *failure;
  return finished((*smoother_)(design_of(psi)), symmetries(psi), "the level set after smoothing");
}

template <int dim>
LevelSet<dim> Evolver<dim>::keep_bands(const LevelSet<dim>& psi) const {
  return bands_.keep(psi);
}

template <int dim>
LevelSet<dim> Evolver<dim>::with_features(const LevelSet<dim>& psi, const FeatureSize& size) const {
  if (!size.any()) return psi;
  LevelSet<dim> result = with_feature_size(psi, size);
  if (result.values == psi.values) return result;
  return bands_.keep(with_symmetries_of(psi, std::move(result)));
}

template <int dim>
Expected<MeasuredShape<dim>> Evolver<dim>::measured(LevelSet<dim> psi, const FeatureSize& size) const {
  if (check_widths(psi, size)) {
    psi = with_features(psi, size);
    if (auto failure = check_widths(psi, size)) return *failure;
  }
  return wheelwright::measured(std::move(psi), cut_points_);
}

/// Fails where a wall or a gap is narrower than its least width by more than the resolution of the nodes
/// explains.
template <int dim>
std::optional<Failure> Evolver<dim>::check_widths(const LevelSet<dim>& psi, const FeatureSize& size) const {
  constexpr double enough = 0.96;
  const auto narrow = narrowest_places(psi, {.wall = enough * size.wall, .gap = enough * size.gap});
  if (narrow.empty()) return {};
  const bool is_wall = narrow.front().kind == ShapeEventKind::thin_wall_mended;
  return Failure{FailureReason::too_narrow,
                 fmt::format("a {} at {} stays narrower than {:.4g} mm", is_wall ? "wall" : "gap",
                             place_text<dim>(narrow.front().place), 1e3 * (is_wall ? size.wall : size.gap))};
}

template <int dim>
Expected<MeasuredShape<dim>> Evolver<dim>::with_measure(const LevelSet<dim>& psi, double target,
                                                        double boundary_measure,
                                                        const FeatureSize& size) const {
  constexpr int most_turns = 6;
  LevelSet<dim> shape = with_features(psi, size);
  for (int turn = 1;; ++turn) {
    auto shifted = wheelwright::with_measure<dim>(shape, bands_, target, boundary_measure, cut_points_);
    if (!shifted || !size.any()) return shifted;
    shape = with_features(shifted->shape, size);
    if (turn < most_turns && shape.values != shifted->shape.values) continue;
    if (auto failure = check_widths(shifted->shape, size)) return *failure;
    return shifted;
  }
}

template <int dim>
Expected<AttachedShape<dim>> Evolver<dim>::without_islands(const LevelSet<dim>& psi, double largest) const {
  auto attached = wheelwright::without_islands<dim>(psi, largest);
  if (attached) attached->psi = bands_.keep(with_symmetries_of(psi, std::move(attached->psi)));
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
