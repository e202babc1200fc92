#include "wheelwright/run/study/parting_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/shown_value.h"
#include "wheelwright/run/study/study.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/islands.h"
#include "wheelwright/shape/evolution/volume.h"

namespace wheelwright {
namespace {

/// The volume at which the planes are compared, in one sector [m^3].
double compared_measure(const Case& c, const Study<3>& study) {
  const auto bound = std::ranges::find(c.constraints, built_in("volume_fraction"), &Constraint::quantity);
  const bool is_bound = bound != c.constraints.end() && bound->equals;
  const double first = material_measure(study.initial);
  const double per_fraction = first / volume_fraction(study.grid(), first);
  if (c.volume.target) return *c.volume.target * per_fraction;
  return is_bound ? *bound->equals * per_fraction : first;
}

/// Why a run cannot begin with a plane's wheel as it is drawn. If the target is in reach, it does not do
/// that.
std::optional<Failure> fault_as_drawn(const Study<3>& study, const LevelSet<3>& drawn) {
  const OptimizerOptions& options = study.optimizer;
  const double whole = sector_measure<3>(study.grid());
  const double far = options.measure_rate * whole;
  if (options.target_measure && std::abs(*options.target_measure - material_measure(drawn)) <= far) return {};
  const auto attached = without_islands<3>(drawn, options.largest_island * whole);
  return attached ? std::nullopt : std::optional(attached.failure());
}

/// The first wheel of a plane at this volume.
Expected<LevelSet<3>> first_wheel(const Case& c, const Study<3>& study, double measure) {
  const LevelSet<3> drawn = initial_shape<3>(c);
  if (auto fault = fault_as_drawn(study, drawn)) return *std::move(fault);
  const ProtectedBands<3> limits(drawn.lattice, bands(c));
  double boundary = 0;
  for (const SurfaceSample<3>& sample : boundary_samples(drawn)) boundary += sample.weight;
  auto shape = with_measure<3>([&](double shift) { return limits.keep(shifted<3>(drawn, limits, shift)); },
                               measure, boundary, study.model().points_in_cut_cells());
  if (!shape) return shape.failure();
  return std::move(shape->shape);
}

Expected<double> objective_of(const Study<3>& study, const LevelSet<3>& shape, const Interrupt& interrupt) {
  const auto evaluated = evaluate_of(study, interrupt)(shape, nullptr);
  if (!evaluated) return evaluated.failure();
  return evaluated->evaluation.function(study.optimizer.objective).value;
}

std::string text(const RatedPlane& plane, const ShownUnit& shown) {
  return fmt::format("  plane z = {:.6g} mm: {}", 1e3 * plane.z,
                     plane.fault.empty()
                         ? fmt::format("{:.5g} {}", plane.objective * shown.factor, shown.name)
                         : plane.fault);
}

}  // namespace

bool finds_parting_plane(const Case& c) {
  return c.wheel.dimension == 3 && c.optimizer.made == Manufacture::moulded &&
         c.optimizer.parting == Parting::found;
}

Case with_parting_plane(Case c, double z) {
  c.optimizer.parting = Parting::given;
  c.optimizer.parting_plane = z;
  return c;
}

std::optional<std::size_t> best_plane(const std::vector<RatedPlane>& planes, double width) {
  constexpr double near_tie = 1e-6;
  double least = HUGE_VAL;
  for (const RatedPlane& plane : planes)
    if (plane.objective < least) least = plane.objective;
  if (!std::isfinite(least)) return {};
  std::optional<std::size_t> best;
  const double rounding = 1e-9 * width;
  const auto from_middle = [&](std::size_t i) { return std::abs(planes[i].z - 0.5 * width); };
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (planes[i].objective - least <= near_tie * std::abs(least) &&
        (!best || from_middle(i) < from_middle(*best) - rounding))
      best = i;
  return best;
}

Expected<RatedPlanes> rated_parting_planes(const Case& c, const PlaneSearch& search) {
  Case plain = c;
  plain.optimizer.parting = Parting::given;
  const auto study = make_study<3>(plain);
  if (!study) return study.failure();
  const double measure = compared_measure(plain, *study);
  RatedPlanes rated{.planes = {}, .best = 0, .volume = volume_fraction(study->grid(), measure)};
  const ShownUnit shown = shown_unit(c.objective.minimize, c.wheel);
  search.report(fmt::format(
      "looking for the parting plane by the initial wheel of each, at {:.4g} % of the ring's volume",
      100 * rated.volume));
  std::optional<Failure> first_fault;
  for (int k = 0; k <= c.grid.axial_cells; ++k) {
    const double z = c.wheel.width * k / c.grid.axial_cells;
    const auto shape = first_wheel(with_parting_plane(c, z), *study, measure);
    const auto objective =
        shape ? objective_of(*study, *shape, search.interrupt) : Expected<double>(shape.failure());
    if (!objective && objective.failure().reason == FailureReason::interrupted) return objective.failure();
    if (!objective && !first_fault) first_fault = objective.failure();
    rated.planes.push_back(
        {z, objective ? *objective : std::nan(""), objective ? "" : objective.failure().detail});
    search.report(text(rated.planes.back(), shown));
  }
  const auto best = best_plane(rated.planes, c.wheel.width);
  if (!best) return *first_fault;
  rated.best = *best;
  search.report(fmt::format("the halves of the mould meet at z = {:.6g} mm", 1e3 * rated.planes[*best].z));
  return rated;
}

Expected<Case> with_parting_plane_found(const Case& c, const PlaneSearch& search) {
  if (!finds_parting_plane(c)) return c;
  const auto rated = rated_parting_planes(c, search);
  if (!rated) return rated.failure();
  return with_parting_plane(c, rated->planes[rated->best].z);
}

}  // namespace wheelwright
