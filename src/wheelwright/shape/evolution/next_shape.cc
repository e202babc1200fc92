#include "wheelwright/shape/evolution/next_shape.h"

#include <fmt/format.h>

#include <limits>

#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

template <int dim>
using Islands = std::vector<ShapeEvent<dim>>;

template <int dim>
NextShape<dim> finished(MeasuredShape<dim> made, Islands<dim> removed) {
  return {std::move(made.shape), std::move(made.domain), made.measure, std::move(removed)};
}

}  // namespace

template <int dim>
ShapeResult<dim> next_shape(const Evolver<dim>& evolver, const LevelSet<dim>& psi, const ShapeMotion& motion,
                            const ShapeRequirements& required) {
  const auto moved = evolver.move(psi, motion.velocity, motion.distance);
  if (!moved) return UnfinishedShape<dim>{psi, unknown, {}, moved.failure()};
  return reshaped(evolver, *moved, motion.redistances, motion.smooths, required);
}

template <int dim>
ShapeResult<dim> reshaped(const Evolver<dim>& evolver, const LevelSet<dim>& moved, bool redistances,
                          bool smooths, const ShapeRequirements& required) {
  const auto even = redistances ? evolver.redistance(moved) : Expected<LevelSet<dim>>(moved);
  if (!even) return UnfinishedShape<dim>{moved, unknown, {}, even.failure()};
  const auto smooth = smooths ? evolver.smooth(*even) : even;
  if (!smooth) return UnfinishedShape<dim>{*even, unknown, {}, smooth.failure()};
  return finished_shape(evolver, *smooth, required);
}

template <int dim>
ShapeResult<dim> measured_shape(const Evolver<dim>& evolver, const LevelSet<dim>& psi,
                                const FeatureSize& widths) {
  auto made = evolver.measured(psi, widths);
  if (!made) return UnfinishedShape<dim>{psi, unknown, {}, made.failure()};
  return finished<dim>(*std::move(made), {});
}

template <int dim>
ShapeResult<dim> finished_shape(const Evolver<dim>& evolver, LevelSet<dim> psi,
                                const ShapeRequirements& required) {
  constexpr int max_turns = 4;
  Islands<dim> removed;
  double measure = unknown;
  for (int turn = 0; turn < max_turns; ++turn) {
    std::optional<MeasuredShape<dim>> shifted;
    if (required.measure) {
      auto made = evolver.with_measure(psi, *required.measure, required.boundary_measure, required.widths);
      if (!made) return UnfinishedShape<dim>{std::move(psi), unknown, std::move(removed), made.failure()};
      shifted = *std::move(made);
      psi = shifted->shape;
      measure = shifted->measure;
    }
    auto attached = evolver.without_islands(psi, required.largest_island);
    if (!attached)
      return UnfinishedShape<dim>{std::move(psi), measure, std::move(removed), attached.failure()};
    if (attached->removed.empty()) {
      if (shifted) return finished(*std::move(shifted), std::move(removed));
      auto made = evolver.measured(psi, required.widths);
      if (made) return finished(*std::move(made), std::move(removed));
      return UnfinishedShape<dim>{std::move(psi), unknown, std::move(removed), made.failure()};
    }
    psi = std::move(attached->psi);
    removed.insert(removed.end(), attached->removed.begin(), attached->removed.end());
  }
  const Failure failure{FailureReason::disconnected_material,
                        fmt::format("islands reappear whenever they are removed, most recently at {}",
                                    place_text<dim>(removed.back().place))};
  return UnfinishedShape<dim>{std::move(psi), measure, std::move(removed), failure};
}

template decltype(next_shape<2>) next_shape<2>;
template decltype(reshaped<2>) reshaped<2>;
template decltype(measured_shape<2>) measured_shape<2>;
template decltype(finished_shape<2>) finished_shape<2>;
template decltype(next_shape<3>) next_shape<3>;
template decltype(reshaped<3>) reshaped<3>;
template decltype(measured_shape<3>) measured_shape<3>;
template decltype(finished_shape<3>) finished_shape<3>;

}  // namespace wheelwright
