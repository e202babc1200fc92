#include "wheelwright/run/study/filled_holes.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/shape/evolution/protected_bands.h"

namespace wheelwright {

namespace {

/// Returns the widths required by a key of the case with this value.
using SizeOf = FeatureSize (*)(double value);
FeatureSize with_wall(double wall) { return {.wall = wall}; }
FeatureSize with_gap(double gap) { return {.gap = gap}; }
FeatureSize with_radius(double radius) { return {.gap = 2 * radius, .radius = radius}; }

/// Enforces minimum widths on the initial shape, and checks whether holes remain.
template <int dim>
class Repair {
 public:
  Repair(const LevelSet<dim>& initial, const Bands& bands)
      : initial_(initial), bands_(initial.lattice, bands) {}

  bool leaves_holes(const FeatureSize& size) const {
    return has_holes(bands_.keep(with_feature_size(initial_, size)));
  }

  /// Searches down to a sixteenth of the given width, which leaves none.
  double widest_that_leaves_holes(double width, SizeOf size_of) const {
    constexpr int bisections = 4;
    double leaves = 0, fills = width;
    for (int k = 0; k < bisections; ++k) {
      const double middle = 0.5 * (leaves + fills);
      (leaves_holes(size_of(middle)) ? leaves : fills) = middle;
    }
    return leaves;
  }

 private:
  const LevelSet<dim>& initial_;
  ProtectedBands<dim> bands_;
};

}  // namespace

template <int dim>
std::optional<Failure> filled_holes(const LevelSet<dim>& initial, const EvolutionOptions& options) {
  const FeatureSize& asked = options.features;
  if (!asked.any() || !has_holes(initial)) return {};
  const Repair<dim> repair(initial, options.bands);
  if (repair.leaves_holes(asked)) return {};
  constexpr double mm = 1e3;
  const auto fault = [&](const char* key, double value, SizeOf size_of) -> std::optional<Failure> {
    if (value <= 0 || repair.leaves_holes(size_of(value))) return {};
    return Failure{FailureReason::too_narrow,
                   fmt::format("optimizer.{} = {:.4g} mm fills all holes of the initial shape; {:.4g} mm "
                               "leaves some",
                               key, value * mm, repair.widest_that_leaves_holes(value, size_of) * mm)};
  };
  if (auto radius = fault("minimum_radius", asked.radius, with_radius)) return radius;
  if (auto gap = fault("minimum_gap", asked.gap, with_gap)) return gap;
  if (auto wall = fault("minimum_wall", asked.wall, with_wall)) return wall;
  return Failure{FailureReason::too_narrow,
                 fmt::format("optimizer.minimum_wall = {:.4g} mm and optimizer.minimum_gap = {:.4g} mm "
                             "together fill all holes of the initial shape; reduce one of them",
                             asked.wall * mm, asked.gap * mm)};
}

template decltype(filled_holes<2>) filled_holes<2>;
template decltype(filled_holes<3>) filled_holes<3>;

}  // namespace wheelwright
