#pragma once

#include "wheelwright/functionals/functional.h"

namespace wheelwright {

/// Which load positions of a sector a quantity is about.
enum class Over {
  positions,  ///< each of them: the functional has one value per position
  mean,       ///< their mean; of a stiffness: the mean force by the mean motion
  maximum,    ///< the maximum
  minimum,    ///< the minimum
};

/// Parameters of some quantities.
struct QuantityParameters {
  double density = 0;         ///< of the mass [kg/m^3]
  double from_tread = 0.025;  ///< peak_von_mises_inside: how far the stresses are from the tread [m]
  int harmonic = 1;           ///< of run_out_harmonic and force_variation_harmonic
};

/// The functional whose value is the quantity. `over` does not count for quantities of the shape alone, and
/// for those that compare all positions anyway (run_out, force_variation and their harmonics). Null for
/// quantities that are no functional of this kind: the objective, the terms that need operators of the solver
/// (uniformity_*), pressure_spread, and what is measured on the outline.
///
/// - stiffness: force of the ground by travel of the rim, the secant stiffness under the load, which is what
/// the
///   load test of a wheel shows; tangential_stiffness and torsional_stiffness likewise, where the model's
///   horizontal force or torque moves the rim.
/// - run_out is a variation of the travel, force_variation of the radial force: they vary under a held load
/// and a
///   held travel respectively, and are zero otherwise.
template <int dim>
std::shared_ptr<const Functional<dim>> quantity_functional(Quantity quantity, Over over,
                                                           const QuantityParameters& parameters);

/// Over which positions history.csv and `[[expect]]` have a quantity.
Over usual_positions(Quantity quantity);

}  // namespace wheelwright
