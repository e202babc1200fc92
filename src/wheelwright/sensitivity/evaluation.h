#pragma once

#include <string>
#include <vector>

#include "wheelwright/base/phase_time.h"
#include "wheelwright/geometry/level_set.h"
#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// One criterion's value, summed over the load positions of one sector.
struct CriterionValue {
  std::string name;  ///< as in the case file, e.g. "strain_energy"
  double value;      ///< before weighting; per metre of width when dim = 2
};

/// A number that is watched but not optimized, over the load positions of one sector.
struct MeasureValue {
  std::string name;  ///< e.g. "peak_pressure"
  double value;      ///< in SI units
};

/// What the physics says about one shape: the objective (5), its shape gradient (42), and how it went. Sums
/// run over the N_d load positions of one sector; the paper's sum over all N_l = N_d N_s positions is N_s
/// times that.
template <int dim>
struct Evaluation {
  double objective;                          ///< J [J/m when dim = 2]
  std::vector<CriterionValue> criteria;      ///< the terms of J
  std::vector<SurfaceSample<dim>> gradient;  ///< density G: DJ(Theta) = sum weight value Theta.n, for Theta
                                             ///< equal in all sectors
  std::vector<int> newton_iterations;        ///< one a position that was solved for
  Matrix mean_observations;  ///< of the tread over the positions (functionals/mean_contact_stress.h)
  std::vector<PhaseTime> phases;
  std::vector<MeasureValue> measures;  ///< RollingMeasures, by its names
};

}  // namespace wheelwright
