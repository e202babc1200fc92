#pragma once

#include "wheelwright/base/vec.h"
#include "wheelwright/mechanics/elasticity/isotropic_law.h"

namespace wheelwright {

// A round hole without traction in an unbounded body that is strained uniformly far away; its edge moves.
// When dim = 3 it is a sphere.

/// The mean strain of the hole itself, which its edge determines: A eps of the distant strain eps. It is
/// uniform: Eshelby's inclusion without stiffness (Eshelby 1957). For every adjoint strain sigma(p) : A
/// eps(u) is the polarization of a small hole, when dim = 2
///   (lambda + 2 mu) / (2 mu (lambda + mu)) [4 mu sigma(u) : eps(p) + (lambda - mu) tr sigma(u) tr eps(p)]
/// (Garreau, Guillaume and Masmoudi 2001).
template <int dim>
Voigt<dim> strain_of_hole(const Material& material, const Voigt<dim>& distant);

/// The strain that the hole adds to the distant one at a place outside of it. `place` is counted from the
/// centre of the hole in units of its radius (Kirsch 1898).
Voigt<2> strain_around_hole(const Material& material, const Voigt<2>& distant, const Vec<2>& place);

}  // namespace wheelwright
