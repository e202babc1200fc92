#pragma once

#include <vector>

#include "wheelwright/base/phase_time.h"
#include "wheelwright/mechanics/ring/cyclic_stiffness.h"

namespace wheelwright {

/// Data shared by the direct problems of one shape under all loads.
template <int dim>
struct FactoredShape {
  CutDomain<dim> domain;
  CyclicStiffness<dim> ring;
  std::vector<PhaseTime> phases;  ///< of cutting, assembly and factorization
};

}  // namespace wheelwright
