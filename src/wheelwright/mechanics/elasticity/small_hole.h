#pragma once

#include "wheelwright/base/vec.h"
#include "wheelwright/mechanics/elasticity/isotropic_law.h"
#include "wheelwright/mechanics/elasticity/orthotropic_material.h"

namespace wheelwright {

// A round hole without traction in an unbounded body that is strained uniformly far away; its edge moves.
// When dim = 3 it is a sphere. The polar axes of an orthotropic material are those at the hole.

/// The mean strain of the hole itself, which its edge determines: A eps of the distant strain eps. It is
/// uniform: Eshelby's inclusion without stiffness (Eshelby 1957). For every adjoint strain sigma(p) : A
/// eps(u) is the polarization of a small hole, when dim = 2
///   (lambda + 2 mu) / (2 mu (lambda + mu)) [4 mu sigma(u) : eps(p) + (lambda - mu) tr sigma(u) tr eps(p)]
/// (Garreau, Guillaume and Masmoudi 2001).
template <int dim>
Voigt<dim> strain_of_hole(const Material& material, const Voigt<dim>& distant);

/// The same in an orthotropic material, by the stress sigma far away: with the compliances in the plane and
/// x = 2 sqrt(rr tt) + 2 rt + shear
///   eps_r = (rr + sqrt(rr x)) sigma_r - sqrt(rr tt) sigma_t,
///   eps_t = (tt + sqrt(tt x)) sigma_t - sqrt(rr tt) sigma_r,
///   gamma = (x + (sqrt(rr) + sqrt(tt)) sqrt(x)) sigma_rt
/// from the stress at the edge (Lekhnitskii 1963; Tsukrov and Kachanov 2000).
Voigt<2> strain_of_hole(const OrthotropicMaterial& material, const Voigt<2>& distant);

/// The strain that the hole adds to the distant one at a place outside of it. `place` is counted from the
/// centre of the hole in units of its radius (Kirsch 1898; Goodier 1933).
Voigt<2> strain_around_hole(const Material& material, const Voigt<2>& distant, const Vec<2>& place);
Voigt<3> strain_around_hole(const Material& material, const Voigt<3>& distant, const Vec<3>& place);

}  // namespace wheelwright
