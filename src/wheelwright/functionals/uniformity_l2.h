#pragma once

#include "wheelwright/functionals/functional.h"

namespace wheelwright {

/// The naive uniformity criterion (4): int_Gamma_C L/(2E) |sigma(u)n - p_mean|^2. Not continuous in the data
/// of the problem; for comparison.
template <int dim>
class UniformityL2 : public Criterion<dim> {
 public:
  /// `length`: the characteristic length L [m].
  explicit UniformityL2(double length) : length_(length) {}

  std::string name() const override { return std::string(wheelwright::name(Quantity::uniformity_l2)); }
  CriterionTerm evaluate(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                         const Matrix& mean) const override;

 private:
  double length_;
};

}  // namespace wheelwright
