#pragma once

#include <memory>
#include <span>
#include <vector>

#include "wheelwright/mechanics/elasticity/element.h"
#include "wheelwright/mechanics/state/rim.h"
#include "wheelwright/mechanics/state/strains_in_cell.h"
#include "wheelwright/shape/geometry/polar_grid.h"

namespace wheelwright {

/// A function of the strains that is integrated over the material, including the tread: M(u) of (36). It may
/// be zero in whole rows of cells.
template <int dim>
class MaterialDensity {
 public:
  virtual ~MaterialDensity() = default;

  /// M at the points of a cell in every load case [of the function per m^2, or per m^3 when dim = 3]: one row
  /// per load case, one column per point. It may depend on the strains of all load cases, such as their range
  /// over a turn; then all positions must be solved (Functional::is_mirror_symmetric).
  virtual Matrix densities(const StrainsInCell<dim>& cell) const = 0;

  /// The derivative of sum_j factor_j M_j, j the load cases, at every point with respect to all strains
  /// (engineering shear strains) at that point: one row per load case, n_strains columns per point.
  virtual Matrix slopes(const StrainsInCell<dim>& cell, std::span<const double> factors) const = 0;

  /// Whether it counts in a radial row of cells, the first of them at the rim.
  virtual bool covers(const PolarGrid<dim>&, int) const { return true; }
};

/// A density that is the same function of the strains at every point.
template <int dim>
class DensityOfHistory : public MaterialDensity<dim> {
 public:
  Matrix densities(const StrainsInCell<dim>& cell) const final;
  Matrix slopes(const StrainsInCell<dim>& cell, std::span<const double> factors) const final;

  /// M of every load case, from the strains of all of them.
  virtual void densities_at(const StrainsAtPoint<dim>& point, std::span<double> values) const = 0;
  /// The derivative of sum_j factor_j M_j.
  virtual void slopes_at(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                         const StressRows<dim>& slopes) const = 0;
};

/// A density that is the same function of the strain at every point and in every load case.
template <int dim>
class DensityOfStrain : public DensityOfHistory<dim> {
 public:
  struct Value {
    double density;        ///< M
    Voigt<dim> by_strain;  ///< dM/d(eps)
  };
  virtual Value at(const Voigt<dim>& strain, const MaterialLaw<dim>& law) const = 0;

  void densities_at(const StrainsAtPoint<dim>& point, std::span<double> values) const override;
  void slopes_at(const StrainsAtPoint<dim>& point, std::span<const double> factors,
                 const StressRows<dim>& slopes) const override;
};

/// The derivative of the values J_i of one function with respect to the states u_i of the solved load
/// positions: everything that an adjoint problem (79) and a shape derivative (42) need from the function.
///   dJ_i = energy_i dJ_e,i - tread_loads . d(observations) + density_i d(int M(u_i) dx)
///          + rim_i . d(motion of the rim) + tractions_i . d(traction of the ground)
///          + growth_i d(growth)
template <int dim>
struct FunctionalDerivative {
  /// dJ_i / dJ_e,i with J_e the strain energy (3), one per position; empty: zero.
  std::vector<double> energy = {};

  /// dJ / dW_n, of all positions together, with the energies W_n of State::energy_by_harmonic(); empty: zero.
  /// Only where every position was solved.
  std::vector<double> energy_by_harmonic = {};

  /// Whether it depends on strain energies.
  bool has_energy() const { return !energy.empty() || !energy_by_harmonic.empty(); }

  /// Minus the derivative with respect to what the tread observes (ObservationRows); one column per
  /// (position, ring column), as State::observations(); empty: zero.
  Matrix tread_loads = {};

  /// The derivative with respect to integrals over the material, one factor per position.
  struct Integral {
    std::shared_ptr<const MaterialDensity<dim>> density;
    std::vector<double> factors;
  };
  std::vector<Integral> integrals = {};

  /// The derivative with respect to the motion of the rim (ContactPatch::rim), one per position; empty: zero.
  /// Motions that the model prescribes do not change with the shape: their entries do not count.
  std::vector<RimForce> rim = {};

  /// The derivative with respect to the ground's tractions on the wheel, [position][point of the patch], in
  /// the ground frame (ContactPatch::Point::traction); empty: zero.
  std::vector<std::vector<Vec<dim>>> tractions = {};

  /// The derivative with respect to ContactPatch::growth, one per position; empty: zero.
  std::vector<double> growth = {};

  /// Whether it is zero because the function does not depend on the states.
  bool empty() const {
    return !has_energy() && tread_loads.columns() == 0 && integrals.empty() && rim.empty() &&
           tractions.empty() && growth.empty();
  }
};

/// Those of the integrals whose densities count in a radial row of cells.
template <int dim>
std::vector<typename FunctionalDerivative<dim>::Integral> integrals_in_row(
    std::span<const typename FunctionalDerivative<dim>::Integral> integrals, const PolarGrid<dim>& grid,
    int row) {
  std::vector<typename FunctionalDerivative<dim>::Integral> result;
  for (const auto& integral : integrals)
    if (integral.density->covers(grid, row)) result.push_back(integral);
  return result;
}

/// The sum of their slopes, each with its factors, in the layout of MaterialDensity::slopes().
template <int dim>
Matrix sum_of_slopes(std::span<const typename FunctionalDerivative<dim>::Integral> integrals,
                     const StrainsInCell<dim>& cell);

/// Adds a term's derivative to `sum`, multiplied at each position by that position's factor. They must be
/// equal if the term depends on energies by harmonics.
template <int dim>
void add(const FunctionalDerivative<dim>& term, const std::vector<double>& factors,
         FunctionalDerivative<dim>& sum);

}  // namespace wheelwright
