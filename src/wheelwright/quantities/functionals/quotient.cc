#include "wheelwright/quantities/functionals/quotient.h"

namespace wheelwright {

template <int dim>
FunctionalValue<dim> Quotient<dim>::evaluate(const StateSolver<dim>& solver, const LevelSet<dim>& psi,
                                             const State<dim>& state, const Matrix& mean) const {
  const FunctionalValue<dim> a = numerator_->evaluate(solver, psi, state, mean),
                             b = denominator_->evaluate(solver, psi, state, mean);
  FunctionalValue<dim> value;
  std::vector<double> by_a, by_b;
  for (std::size_t i = 0; i < a.by_position.size(); ++i) {
    value.by_position.push_back(a.by_position[i] / b.by_position[i]);
    by_a.push_back(1 / b.by_position[i]);
    by_b.push_back(-value.by_position[i] / b.by_position[i]);
  }
  add(a.derivative, by_a, value.derivative);
  add(b.derivative, by_b, value.derivative);
  return value;
}

template class Quotient<2>;
template class Quotient<3>;

}  // namespace wheelwright
