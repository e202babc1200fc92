#pragma once

#include "wheelwright/functionals/functional.h"
#include "wheelwright/state/material_integral.h"

namespace wheelwright {

/// int_Omega M(u_i) dx (36) of every load position i, with M a function of the strain: derived classes
/// implement M and its derivative, at() of MaterialDensity.
template <int dim>
class MaterialDensityIntegral : public Functional<dim>, MaterialDensity<dim> {
 public:
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&, const State<dim>& state,
                                const Matrix&) const override {
    FunctionalValue<dim> value{.by_position = material_integral<dim>(solver, state, *this)};
    value.derivative.integrals.push_back({this, std::vector<double>(value.by_position.size(), 1.0)});
    return value;
  }

 protected:
  using typename MaterialDensity<dim>::Value;
};

}  // namespace wheelwright
