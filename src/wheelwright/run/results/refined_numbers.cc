#include "wheelwright/run/results/refined_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/quantities/analysis/discretization_error.h"
#include "wheelwright/quantities/analysis/finer_grid.h"
#include "wheelwright/run/results/own_numbers.h"
#include "wheelwright/shape/cut/measure.h"

namespace wheelwright {
namespace {

/// The wheel on grids of which each is finer than the one before, and why there is no finer one.
template <int dim>
struct Refinement {
  std::vector<DescribedWheel<dim>> wheels;
  std::string end;
};

/// The order that is observed on the last three grids; nothing if there are fewer.
template <int dim>
std::optional<double> last_order(const WheelNumber<dim>& number, const Refinement<dim>& refined) {
  const auto& wheels = refined.wheels;
  if (wheels.size() < 3) return {};
  const std::size_t n = wheels.size();
  const auto coarse = known_value(number, wheels[n - 3]), middle = known_value(number, wheels[n - 2]),
             fine = known_value(number, wheels[n - 1]);
  if (!coarse || !middle || !fine) return {};
  return observed_order(*coarse, *middle, *fine, refinement(wheels[n - 2].grid, wheels[n - 1].grid));
}

template <int dim>
std::string why_not_accurate(const WheelNumber<dim>& number, const Refinement<dim>& refined) {
  const auto order = last_order(number, refined);
  if (!order || *order >= minimum_order) return refined.end;
  return fmt::format(
      "does not converge: its differences from grid to grid do not fall, as at corners and at edges of the "
      "contact; the largest stress is {}",
      place_of_stress(refined.wheels.back()));
}

/// The finest wheel whose errors are known; the only one if there are no others.
template <int dim>
const DescribedWheel<dim>& last_with_errors(const Refinement<dim>& refined) {
  return refined.wheels[refined.wheels.size() < 2 ? 0 : refined.wheels.size() - 2];
}

template <int dim>
std::vector<AccurateNumber> numbers_of(const Refinement<dim>& refined, double accuracy) {
  const DescribedWheel<dim>& wheel = last_with_errors(refined);
  std::vector<AccurateNumber> result;
  for (const WheelNumber<dim>& number : wheelwright::numbers_of(wheel)) {
    const auto value = known_value(number, wheel);
    if (!value) continue;
    const auto error = error_of(number, wheel);
    AccurateNumber one{number.label, number.key, number.kind, number.shown(), *value, {}, {}};
    if (error && *error) one.error = **error;
    if (!one.error)
      one.reason = error ? error->failure() : refined.end;
    else if (*one.error > accuracy * std::abs(*value))
      one.reason = why_not_accurate(number, refined);
    result.push_back(std::move(one));
  }
  return result;
}

bool are_accurate(const std::vector<AccurateNumber>& numbers, double accuracy) {
  return std::ranges::all_of(numbers, [&](const AccurateNumber& number) {
    return number.error && *number.error <= accuracy * std::abs(number.value);
  });
}

}  // namespace

template <int dim>
std::string place_of_stress(const DescribedWheel<dim>& wheel) {
  const PolarGrid<dim>& grid = wheel.grid;
  const double radius = wheel.loaded->summary.von_mises.place[0];
  if (radius < grid.radius(1)) return "at the rim";
  if (radius > grid.radius(grid.cells[0] - 1)) return "at the tread";
  return fmt::format("inside the ring, at radius {:.1f} mm", 1e3 * radius);
}

template <int dim>
AccurateNumbers refined_numbers(const Case& c, const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                const SolvedStates<dim>& states,
                                Expected<SolvedFinerShape<dim>, std::string> finer, double accuracy,
                                const Interrupt& interrupt) {
  Refinement<dim> refined;
  const double fraction = volume_fraction(solver.model().grid, material_measure(psi));
  refined.wheels.push_back(
      described_solution(solver, psi, fraction, states, {}, own_numbers(c, solver, psi)));
  for (; finer; finer = solved_finer_shape(c, *finer->solver, finer->shape, interrupt)) {
    const auto wheel = finer_wheel<dim>(c, {}, *finer, SolvedStates<dim>(finer->states));
    finer->states.reset();  // the next ones need the memory
    refined.wheels.back() = with_errors(std::move(refined.wheels.back()), wheel);
    refined.wheels.push_back(wheel->wheel);
    if (are_accurate(numbers_of(refined, accuracy), accuracy)) break;
  }
  if (!finer) refined.end = finer.failure();
  return {accuracy, cells_text(last_with_errors(refined).grid), numbers_of(refined, accuracy)};
}

#define WHEELWRIGHT_INSTANTIATE(dim)                            \
  template decltype(place_of_stress<dim>) place_of_stress<dim>; \
  template decltype(refined_numbers<dim>) refined_numbers<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
