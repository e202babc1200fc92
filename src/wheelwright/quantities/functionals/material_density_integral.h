#pragma once

#include <memory>

#include "wheelwright/mechanics/state/material_integral.h"
#include "wheelwright/quantities/functionals/functional.h"

namespace wheelwright {

/// int_Omega M_i dx (36) of every load position i. `Density` is MaterialDensity, or DensityOfStrain for
/// functions of the strain in the same load case; derived classes implement it. It must outlive its values.
template <int dim, class Density = DensityOfStrain<dim>>
class MaterialDensityIntegral : public Functional<dim>, protected Density {
 public:
  FunctionalValue<dim> evaluate(const StateSolver<dim>& solver, const LevelSet<dim>&, const State<dim>& state,
                                const Matrix&) const override {
    FunctionalValue<dim> value{.by_position = material_integral<dim>(solver, state, *this)};
    const std::shared_ptr<const MaterialDensity<dim>> density(std::shared_ptr<void>(), this);  // not owned
    value.derivative.integrals.push_back({density, std::vector<double>(value.by_position.size(), 1.0)});
    return value;
  }
};

}  // namespace wheelwright
