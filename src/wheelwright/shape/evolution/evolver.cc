#include "wheelwright/shape/evolution/evolver.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "wheelwright/linalg/dense.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/multilinear.h"
#include "wheelwright/shape/evolution/redistance.h"
#include "wheelwright/shape/evolution/spline_level_set.h"
#include "wheelwright/shape/evolution/sub_cell_filter.h"
#include "wheelwright/shape/evolution/transport.h"
#include "wheelwright/shape/evolution/widening.h"
#include "wheelwright/shape/geometry/finite.h"
#include "wheelwright/shape/geometry/mirror.h"
#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {

namespace {

/// How much a velocity may differ from its mirror image, in units of its maximum. Mirror images of load
/// positions are reflected, not computed; both halves of the width are computed.
constexpr double rounding_of(MirrorPlane plane) { return plane == MirrorPlane::azimuth ? 1e-9 : 1e-6; }

template <int dim>
Failure too_narrow(WidthKind kind, const Vec<dim>& place, double minimum) {
  const char* what = kind == WidthKind::wall  ? "a wall at {} remains narrower than {:.4g} mm"
                     : kind == WidthKind::gap ? "a gap at {} remains narrower than {:.4g} mm"
                                              : "a corner at {} keeps a radius below {:.4g} mm";
  return {FailureReason::too_narrow, fmt::format(fmt::runtime(what), place_text<dim>(place), 1e3 * minimum)};
}

/// The minimum widths of the kinds of which some place lacks more than this fraction; 0 of the others.
template <int dim>
FeatureSize sizes_lacking(double fraction, const std::vector<Width<dim>>& widths, const FeatureSize& size) {
  const auto size_if_lacking = [&](WidthKind kind, double minimum) {
    const auto lacks = [&](const auto& width) { return width.kind == kind && width.gap() > fraction; };
    return std::ranges::any_of(widths, lacks) ? minimum : 0;
  };
  return {.wall = size_if_lacking(WidthKind::wall, size.wall),
          .gap = size_if_lacking(WidthKind::gap, size.gap),
          .radius = size_if_lacking(WidthKind::corner, size.radius)};
}

}  // namespace

template <int dim>
Evolver<dim>::Evolver(const Lattice<dim>& lattice, const EvolutionOptions& options)
    : lattice_(lattice),
      space_(options.space),
      invariance_(options.invariance),
      bands_(lattice, options.bands),
      extension_(make_velocity_extension<dim>(lattice, bands_, options.velocity)),
      deformations_(lattice, bands_.nodes(), options.velocity.length * lattice.grid().resolution(),
                    options.deformation, options.invariance),
      features_(options.features),
      cut_points_(options.cut_points) {
  if (options.smoothing > 0)
    smoother_.emplace(lattice, std::sqrt(options.smoothing) * lattice.grid().resolution());
}

template <int dim>
template <class Extend>
Expected<std::vector<double>> Evolver<dim>::movable_velocity(std::span<const SurfaceSample<dim>> gradient,
                                                             Extend extend) const {
  const auto invariant = [&](Expected<std::vector<double>> velocity) {
    if (velocity) velocity = invariant_part<dim>(lattice_, *velocity, invariance_);
    return velocity;
  };
  auto velocity = invariant(extend(gradient));
  if (!velocity) return velocity;
  const auto movable = movable_samples<dim>(lattice_, bands_, gradient, *velocity);
  return movable.size() == gradient.size() ? velocity : invariant(extend(movable));
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

/// A coefficient that can make at least a quarter of its move is not held: the band clips it.
template <int dim>
bool Evolver<dim>::hold_at_bands(const LevelSet<dim>& coefficients, std::span<const double> velocity,
                                 double distance, std::vector<bool>& held) const {
  constexpr double part = 0.25, minimum = 0.01;  // of the motion; of a cell
  const double time = distance / largest_magnitude(velocity);
  bool is_more = false;
  for (std::size_t node = 0; node < velocity.size(); ++node) {
    const double margin = std::max(-part * time * velocity[node], minimum * lattice_.grid().resolution());
    if (held[node] || velocity[node] >= 0 ||
        !bands_.is_clipped(static_cast<int>(node), coefficients.values[node], margin))
      continue;
    held[node] = is_more = true;
  }
  return is_more;
}

template <int dim>
bool Evolver<dim>::follow_as_made(const LevelSet<dim>& coefficients, std::span<const double> velocity,
                                  double distance, Following& following) const {
  const double fastest = largest_magnitude(velocity);
  if (!bands_.made() || !(fastest > 0)) return false;
  const auto moved = smooth_transport<dim>(coefficients, velocity, distance / fastest);
  return bands_.made()->follow(bands_.clip_design(coefficients), bands_.clip_design(moved), following);
}

template <int dim>
LevelSet<dim> Evolver<dim>::design_of(const LevelSet<dim>& psi) const {
  return space_ == ShapeSpace::spline ? spline_coefficients(psi) : psi;
}

template <int dim>
LevelSet<dim> Evolver<dim>::shape_of(LevelSet<dim> design) const {
  return bands_.keep(space_ == ShapeSpace::spline ? spline_level_set(bands_.keep_design(std::move(design)))
                                                  : sub_cell_filter(design));
}

/// Clipping could hide an infinity, so the values are checked first.
template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::finished(LevelSet<dim> design,
                                               const std::vector<MirrorPlane>& symmetries,
                                               const char* what) const {
  if (auto failure = check_finite<dim>(lattice_, design.values, what)) return *failure;
  return shape_with(symmetries, std::move(design));
}

template <int dim>
LevelSet<dim> Evolver<dim>::shape_with(const std::vector<MirrorPlane>& symmetries,
                                       LevelSet<dim> design) const {
  for (const MirrorPlane plane : symmetries) design = mirror_symmetric_part(design, plane);
  // The nodes of a spline are invariant up to rounding only.
  return invariant_part(shape_of(invariant_part(std::move(design), invariance_)), invariance_);
}

template <int dim>
LevelSet<dim> Evolver<dim>::in_space(const LevelSet<dim>& psi) const {
  return space_ == ShapeSpace::spline ? shape_with(symmetries(psi), design_of(psi)) : keep_bands(psi);
}

template <int dim>
LevelSet<dim> Evolver<dim>::like(const LevelSet<dim>& other, LevelSet<dim> psi) const {
  return keep_bands(invariant_part(with_symmetries_of(other, std::move(psi)), invariance_));
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
  return like(psi, std::move(distance));
}

template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::smooth(const LevelSet<dim>& psi) const {
  if (!smoother_) return psi;
  if (auto failure = check_finite<dim>(psi.lattice, psi.values, "the level set")) return *failure;
  return finished((*smoother_)(design_of(psi)), symmetries(psi), "the level set after smoothing");
}

template <int dim>
LevelSet<dim> Evolver<dim>::keep_bands(const LevelSet<dim>& psi) const {
  return bands_.made() ? shape_of(design_of(psi)) : bands_.keep(psi);
}

template <int dim>
LevelSet<dim> Evolver<dim>::with_features(const LevelSet<dim>& psi, const FeatureSize& size) const {
  if (!size.any()) return psi;
  LevelSet<dim> result = with_feature_size(psi, size);
  if (result.values == psi.values) return result;
  return in_space(like(psi, std::move(result)));
}

template <int dim>
Expected<MeasuredShape<dim>> Evolver<dim>::measured(LevelSet<dim> psi, const FeatureSize& size) const {
  return with_widths(std::move(psi), size, false, [&](LevelSet<dim> shape) {
    return wheelwright::measured(std::move(shape), cut_points_);
  });
}

template <int dim>
Expected<MeasuredShape<dim>> Evolver<dim>::with_measure(const LevelSet<dim>& psi, double target,
                                                        double boundary_measure,
                                                        const FeatureSize& size) const {
  if (auto failure = check_finite<dim>(psi.lattice, psi.values, "the level set")) return *failure;
  return with_widths(psi, size, true, [&](const LevelSet<dim>& shape) {
    return wheelwright::with_measure<dim>(shifted(shape), target, boundary_measure, cut_points_);
  });
}

/// A spline is shifted by its coefficients, so that it remains one: bands clip them, and would clip nodes to
/// another shape. A drawn level set changes like its spline. The coefficients of one drawn up to a band
/// exceed the band's: they are clipped before the shift too, or the measure would jump at the shift 0.
template <int dim>
ShapeOfShift<dim> Evolver<dim>::shifted(const LevelSet<dim>& psi) const {
  if (space_ != ShapeSpace::spline)
    return [&](double shift) { return bands_.keep(wheelwright::shifted<dim>(psi, bands_, shift)); };
  const LevelSet<dim> coefficients = bands_.keep_design(spline_coefficients(psi));
  return [this, &psi, coefficients, unmoved = spline_level_set(coefficients)](double shift) {
    if (shift == 0) return psi;
    LevelSet<dim> result =
        spline_level_set(bands_.keep_design(wheelwright::shifted<dim>(coefficients, bands_, shift)));
    for (std::size_t node = 0; node < result.values.size(); ++node)
      result.values[node] += psi.values[node] - unmoved.values[node];
    return like(psi, std::move(result));
  };
}

/// Measures the shape, or shifts it to a measure, and widens narrow places until none is left. If much of a
/// width is missing, first inserts balls, or rounds corners: only those of which so much is missing, because
/// balls would thicken all walls that just have their width. If a hole is too small to be detected by its
/// widths, does both.
template <int dim>
template <class Measure>
Expected<MeasuredShape<dim>> Evolver<dim>::with_widths(LevelSet<dim> psi, const FeatureSize& size,
                                                       bool keeps_measure, Measure measure) const {
  constexpr int max_turns = 12, max_repairs = 2;
  constexpr double enough = 1e-3, far = 0.2;
  constexpr double sampled = 0.9;  // of a diameter: small holes are measured by samples
  const double reach = 0.5 * lattice_.grid().resolution();
  int repairs = 0;
  for (int turn = 0;; ++turn) {
    auto shape = measure(std::move(psi));
    if (!shape || !size.any()) return shape;
    const auto widths = narrow_widths_with_margin(shape->shape, size, reach);
    const double gap = largest_gap(widths);
    if (!std::isfinite(gap)) return Failure{FailureReason::not_finite, "a width of the shape"};
    const auto hole = gap <= enough ? small_hole(shape->shape, sampled * size.gap) : std::nullopt;
    if (gap <= enough && !hole) return shape;
    if (repairs < max_repairs && (hole || (turn == 0 && gap > far))) {
      ++repairs;
      psi = with_features(shape->shape, hole ? size : sizes_lacking(far, widths, size));
      continue;
    }
    if (hole) return too_narrow<dim>(WidthKind::gap, hole->place, size.gap);
    if (turn == max_turns) {
      const auto& narrowest = *std::ranges::max_element(widths, {}, &Width<dim>::gap);
      return too_narrow<dim>(narrowest.kind, narrowest.place, narrowest.minimum - narrowest.narrower);
    }
    auto wider = widened(shape->shape, widths, keeps_measure);
    if (!wider) return wider.failure();
    psi = *std::move(wider);
  }
}

/// The shape after a deformation that establishes the widths to first order and moves no boundary point by
/// more than half a cell.
template <int dim>
Expected<LevelSet<dim>> Evolver<dim>::widened(const LevelSet<dim>& psi, const std::vector<Width<dim>>& widths,
                                              bool keeps_measure) const {
  constexpr int max_turns = 3;
  constexpr double farthest = 0.5;
  const auto samples = boundary_samples<dim>(psi);
  const std::vector<SurfacePoint<dim>> boundary(samples.begin(), samples.end());
  const auto motion = deformations_.motion_of(psi, boundary);
  std::vector<bool> held(psi.values.size(), false);
  std::vector<double> velocity;
  for (int turn = 0; turn < max_turns; ++turn) {
    const auto free = motion.holding(held);
    std::vector<std::vector<double>> kept;
    if (keeps_measure) kept.push_back(free.load(std::vector<double>(boundary.size(), 1.0)));
    const auto deformation = widening(deformations_, free, widths, kept);
    velocity = free.speeds_at_nodes(deformation);
    const double reached = std::max(largest_magnitude(free.speeds(deformation)), 1e-300),
                 most = farthest * lattice_.grid().resolution();
    for (double& speed : velocity) speed *= std::min(1.0, most / reached);
    if (!hold_at_bands(motion.coefficients(), velocity, largest_magnitude(velocity), held)) break;
  }
  const double distance = largest_magnitude(velocity);
  return distance == 0 ? psi : move(psi, velocity, distance);
}

template <int dim>
Expected<AttachedShape<dim>> Evolver<dim>::without_islands(const LevelSet<dim>& psi, double largest) const {
  auto attached = wheelwright::without_islands<dim>(psi, largest);
  if (!attached) return attached;
  attached->psi = like(psi, std::move(attached->psi));
  if (!attached->removed.empty()) attached->psi = in_space(attached->psi);
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
