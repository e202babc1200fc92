#pragma once

#include "wheelwright/quantities/functionals/boundary_integral.h"

namespace wheelwright {

/// The length (area when dim = 3) of the moving boundary of one sector: N = 1.
template <int dim>
class Perimeter : public BoundaryIntegral<dim> {
 public:
  std::string name() const override { return "perimeter"; }

 private:
  typename BoundaryIntegral<dim>::Density density(const Vec<dim>&) const override { return {1, {}}; }
};

}  // namespace wheelwright
