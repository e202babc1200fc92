#pragma once

#include <string>
#include <vector>

#include "geometry/level_set.h"

namespace wheelwright {

/// One criterion's value, summed over all load positions of the ring.
struct CriterionValue {
  std::string name;  ///< as in the case file, e.g. "strain_energy"
  double value;      ///< J per metre of width when dim = 2
};

/// Wall time of one phase of an evaluation.
struct PhaseTime {
  std::string phase;
  double seconds;
};

/// What the physics says about one shape: the objective (5), its shape gradient (42), and how it went.
template <int dim>
struct Evaluation {
  double objective;                          ///< J, summed over all N_l positions [J/m when dim = 2]
  std::vector<CriterionValue> criteria;      ///< the terms of J before weighting
  std::vector<SurfaceSample<dim>> gradient;  ///< density G: DJ(Theta) = N_s * sum weight value Theta.n
  std::vector<int> newton_iterations;        ///< one a position of the sector
  std::vector<PhaseTime> phases;
};

}  // namespace wheelwright
