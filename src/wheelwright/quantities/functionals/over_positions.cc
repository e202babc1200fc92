#include "wheelwright/quantities/functionals/over_positions.h"

#include <numeric>

namespace wheelwright {

template <int dim>
void add_over_positions(const LoadPositions& positions, const FunctionalDerivative<dim>& of_functional,
                        std::span<const double> slopes, FunctionalDerivative<dim>& sum) {
  std::vector<double> solved(positions.size());
  std::iota(solved.begin(), solved.end(), 0.0);
  const std::vector<double> source = of_all(positions, solved);
  std::vector<double> factors(positions.size(), 0.0);
  for (std::size_t j = 0; j < source.size(); ++j) {
    const auto i = static_cast<std::size_t>(source[j]);
    factors[i] += slopes[j] / positions.multiplicities[i];
  }
  add(of_functional, factors, sum);
}

template <int dim>
FunctionalValue<dim> FunctionOfPositions<dim>::evaluate(const StateSolver<dim>& solver,
                                                        const LevelSet<dim>& psi, const State<dim>& state,
                                                        const Matrix& mean) const {
  const FunctionalValue<dim> inner = functional_->evaluate(solver, psi, state, mean);
  const OfPositions function = function_(of_all(state.positions(), inner.by_position));
  FunctionalValue<dim> value{.over_positions = function.value,
                             .compares_with_mean = inner.compares_with_mean};
  add_over_positions(state.positions(), inner.derivative, function.slopes, value.derivative);
  return value;
}

template <int dim>
FunctionalValue<dim> RatioOfMeans<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                                 const State<dim>& state, const Matrix& mean) const {
  const FunctionalValue<dim> numerator = numerator_->evaluate(solver, psi, state, mean),
                             denominator = denominator_->evaluate(solver, psi, state, mean);
  const std::vector<double>& multiplicities = state.positions().multiplicities;
  const double n_positions = std::accumulate(multiplicities.begin(), multiplicities.end(), 0.0);
  const auto total = [&](const FunctionalValue<dim>& x) {
    if (x.over_positions) return n_positions * *x.over_positions;
    return std::inner_product(x.by_position.begin(), x.by_position.end(), multiplicities.begin(), 0.0);
  };
  const double below = total(denominator), ratio = total(numerator) / below;
  FunctionalValue<dim> value{.over_positions = ratio};
  const double of_numerator = numerator.over_positions ? n_positions : 1;
  const std::vector<double> up(state.positions().size(), of_numerator / below),
      down(up.size(), -ratio / below);
  add(numerator.derivative, up, value.derivative);
  add(denominator.derivative, down, value.derivative);
  return value;
}

template decltype(add_over_positions<2>) add_over_positions<2>;
template class FunctionOfPositions<2>;
template class RatioOfMeans<2>;
template decltype(add_over_positions<3>) add_over_positions<3>;
template class FunctionOfPositions<3>;
template class RatioOfMeans<3>;

}  // namespace wheelwright
