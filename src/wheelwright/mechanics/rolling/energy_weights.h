#pragma once

#include "wheelwright/mechanics/rolling/rolling_problem.h"
#include "wheelwright/mechanics/state/functional_derivative.h"

namespace wheelwright {

/// The share of the strain energies in a function's derivative: dJ = sum over pairs of load cases of T_jk
/// a(v_j, dv_k), with the energy's form a in one sector. T is diagonal for energies by positions, and for
/// energies by harmonics a matrix that does not change when all load cases are turned by a sector. It acts on
/// the load cases only, so that T v is a displacement of the ring, with the loads T f of the loads f of v.
template <int dim>
class EnergyWeights {
 public:
  /// The solution must outlive this.
  EnergyWeights(const RollingSolution<dim>& solution, const FunctionalDerivative<dim>& derivative);

  /// Whether T is zero.
  bool empty() const { return factors_.empty() && !couples(); }

  /// The factor, if T is that times the identity.
  std::optional<double> common_factor() const { return common_; }

  /// T x; one row per load case.
  Matrix of_cases(const Matrix& x) const;

  /// Fields x by their modes, one row per mode, in the place of v's: W^T M T W x, with the weights W of v's
  /// modes in the load cases and their multiplicities M.
  Matrix of_modes(Matrix x) const;

  /// Adds T x times a sign to `to`: columns[k] of it to column first + k. `x` holds all columns (position,
  /// ring column).
  void add_observations(double sign, const Matrix& x, std::span<const int> columns, int first,
                        Matrix& to) const;

 private:
  bool couples() const { return coupling_.columns() > 0; }

  const RollingSolution<dim>& s_;
  std::vector<double> factors_;  ///< of the positions, if T is diagonal; empty: T is zero, or coupling_
  std::optional<double> common_;
  Matrix coupling_;  ///< T if it is not diagonal
  Matrix on_modes_;  ///< W^T M T W, unless T is the identity times a factor
};

}  // namespace wheelwright
