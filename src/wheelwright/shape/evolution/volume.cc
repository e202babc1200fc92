#include "wheelwright/shape/evolution/volume.h"

#include <fmt/format.h>

#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/geometry/finite.h"

namespace wheelwright {

namespace {

constexpr int max_evaluations = 60;

/// Shifts between which the solution lies: the measure is above the target for a shift that is too small, and
/// below it for one that is too large.
struct Bracket {
  double too_small, too_large;
  bool contains(double shift) const { return shift > too_small && shift < too_large; }
  double middle() const { return 0.5 * (too_small + too_large); }
};

}  // namespace

template <int dim>
Expected<MeasuredShape<dim>> measured(LevelSet<dim> psi, int points) {
  auto domain = cut_domain(psi, points);
  if (!domain) return domain.failure();
  const double measure = material_measure(*domain, psi.lattice.degree());
  if (!std::isfinite(measure)) return Failure{FailureReason::cut_quadrature, "the measure of the material"};
  return MeasuredShape<dim>{std::move(psi), *std::move(domain), measure};
}

template <int dim>
LevelSet<dim> shifted(LevelSet<dim> psi, const ProtectedBands<dim>& bands, double shift) {
  for (std::size_t node = 0; node < psi.values.size(); ++node)
    if (!bands.nodes()[node]) psi.values[node] += shift;
  return psi;
}

template <int dim>
Expected<MeasuredShape<dim>> with_measure(const ShapeOfShift<dim>& shape_of, double target,
                                          double boundary_measure, int points) {
  LevelSet<dim> psi = shape_of(0);
  if (auto failure = check_finite<dim>(psi.lattice, psi.values, "the level set")) return *failure;
  const PolarGrid<dim> grid = psi.lattice.grid();
  const double reach = grid.outer_radius - grid.inner_radius;
  Bracket bracket{-reach, reach};
  double shift = 0, slope = -boundary_measure, last_shift = 0, last_error = 0;
  for (int k = 0; k < max_evaluations; ++k) {
    auto candidate = measured(std::move(psi), points);
    if (!candidate) return candidate.failure();
    const double error = candidate->measure - target;
    if (std::abs(error) <= measure_tolerance * target) return candidate;
    (error > 0 ? bracket.too_small : bracket.too_large) = shift;
    if (k > 0) slope = (error - last_error) / (shift - last_shift);
    last_shift = shift;
    last_error = error;
    shift -= error / slope;
    if (!bracket.contains(shift)) shift = bracket.middle();
    if (bracket.too_large - bracket.too_small < 1e-12 * reach) break;
    psi = shape_of(shift);
  }
  const bool on_end = bracket.too_large == reach || bracket.too_small == -reach;
  return Failure{
      on_end ? FailureReason::empty_shape : FailureReason::cut_quadrature,
      fmt::format("no shift of the level set gives the measure {:.6g}; the nearest is off by {:.2g}", target,
                  last_error)};
}

template <int dim>
double proportional_multiplier(std::span<const SurfaceSample<dim>> gradient, double target_ratio,
                               double ratio) {
  if (gradient.empty()) return 0;
  const auto by_value = [](const auto& a, const auto& b) { return a.value < b.value; };
  const auto [low, high] = std::minmax_element(gradient.begin(), gradient.end(), by_value);
  return 8 * (high->value - low->value) * (target_ratio - ratio);
}

template decltype(measured<2>) measured<2>;
template decltype(measured<3>) measured<3>;
template decltype(shifted<2>) shifted<2>;
template decltype(shifted<3>) shifted<3>;
template decltype(with_measure<2>) with_measure<2>;
template decltype(with_measure<3>) with_measure<3>;
template decltype(proportional_multiplier<2>) proportional_multiplier<2>;
template decltype(proportional_multiplier<3>) proportional_multiplier<3>;

}  // namespace wheelwright
