#pragma once

#include "wheelwright/base/interrupt.h"
#include "wheelwright/mechanics/contact/reduced_contact.h"

namespace wheelwright {

/// The end of a path of contact problems.
template <int dim>
struct PathEnd {
  ContactUnknowns<dim> x;  ///< the solution, but for rounding errors; if the path does not arrive: its start
  int turns = 0;
  bool arrives = false;
};

/// Solves a plane contact problem with friction by following a path: of the problems whose residual is
/// (1 - t) that of `start`, from t = 0, where `start` is the solution, to t = 1. In the plane Coulomb's law
/// is linear in pieces (open, stick, slide to either side), and so is the path: it turns where a point
/// changes its piece, and goes back in t where the problem at t has several solutions, so that it cannot
/// cycle (Katzenelson, Bell System Technical Journal 44, 1965; Chien and Kuh, IEEE Transactions on Circuits
/// and Systems 23, 1976). A turn costs the solution of one factored system. The path does not arrive if it
/// leads to infinity, or once `interrupt`, which is polled and told of at every turn, asks for it.
PathEnd<2> follow_path(const ReducedContact<2>& contact, ContactUnknowns<2> start,
                       const Interrupt& interrupt = {}, int steps_before = 0);

}  // namespace wheelwright
