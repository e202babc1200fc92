#pragma once

#include <vector>

#include "wheelwright/elasticity/element.h"

namespace wheelwright {

/// A function of the strain that is integrated over the material, including the tread: M(u) of (36).
template <int dim>
class MaterialDensity {
 public:
  virtual ~MaterialDensity() = default;

  struct Value {
    double density;        ///< M [of the function per m^2, or per m^3 when dim = 3]
    Voigt<dim> by_strain;  ///< dM/d(eps), with respect to engineering shear strains
  };
  virtual Value at(const Voigt<dim>& strain, const Material& material) const = 0;
};

/// How the values J_i of one function depend on the states u_i of the load positions that were solved for:
/// all that an adjoint problem (79) and a shape derivative (42) need to know about the function.
///   dJ_i = energy_i dJ_e,i - tread_loads . d(observations) + density_i d(int M(u_i) dx)
template <int dim>
struct FunctionalDerivative {
  /// dJ_i / dJ_e,i with J_e the strain energy (3), one per position; empty: zero.
  std::vector<double> energy;

  /// Minus the derivative with respect to what the tread observes (ObservationRows); one column per
  /// (position, ring column), as State::observations(); empty: zero.
  Matrix tread_loads;

  /// The derivative with respect to integrals over the material, one factor per position. The densities must
  /// outlive this.
  struct Integral {
    const MaterialDensity<dim>* density;
    std::vector<double> factors;
  };
  std::vector<Integral> integrals;
};

/// Adds a term's derivative to `sum`, multiplied at each position by that position's factor.
template <int dim>
void add(const FunctionalDerivative<dim>& term, const std::vector<double>& factors,
         FunctionalDerivative<dim>& sum);

}  // namespace wheelwright
