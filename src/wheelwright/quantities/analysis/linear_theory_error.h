#pragma once

#include "wheelwright/base/vec.h"
#include "wheelwright/mechanics/elasticity/voigt.h"

namespace wheelwright {

/// The elastic energy of a linear solution, and the next terms of its expansion, which linear theory neglects
/// (docs/method.md): per volume at a point [J/m^3], or integrated over the material.
struct ExpandedEnergy {
  double linear = 0;  ///< 1/2 sigma:eps, of second order in the displacement

  // Of third order. The stress that is linear in Green's strain has the energy of_rotation + of_strain, the
  // one that is linear in Hencky's logarithmic strain of_rotation - of_strain.
  double of_rotation = 0;  ///< -1/2 sigma:omega^2 in isotropic materials
  double of_strain = 0;    ///< 1/2 sigma:eps^2

  /// Of fourth order: the linear energy times the square of the rotation, the energy of bending without
  /// stretching, whose third order is zero.
  double of_bending = 0;

  ExpandedEnergy& operator+=(const ExpandedEnergy& other);
};

ExpandedEnergy operator*(double volume, ExpandedEnergy density);

/// The densities at a point from the linear stress, the strain, and the rotation vector (when dim = 2 its
/// component along the axle) against the body that holds the wheel.
template <int dim>
ExpandedEnergy expanded_energy(const Voigt<dim>& stress, const Voigt<dim>& strain,
                               const Vec<dim*(dim - 1) / 2>& rotation);

/// An estimate of what linear theory neglects under one load: by how much the real wheel is stiffer, as the
/// relative change of the force at a given travel, or minus that of the travel at a given load. With other
/// loads than one on the rim, of the work of all loads.
struct LinearTheoryError {
  double of_rotation = 0;  ///< of first order in the load: 3/2 of_rotation by the linear energy
  double of_strain = 0;    ///< the same of of_strain; with the opposite sign by Hencky's law
  double of_bending = 0;   ///< of second order in the load: 2 of_bending by the linear energy; never negative

  /// The estimate of the error of linear theory: the sum of the sizes of the three.
  double size() const;
};

/// From energies integrated over the whole material.
LinearTheoryError linear_theory_error(const ExpandedEnergy& energy);

/// The largest share s <= 1 of the load at which an error falls to a limit, if the first two terms fall with
/// s and the last with s^2.
double share_within(const LinearTheoryError& error, double limit);

}  // namespace wheelwright
