#pragma once

#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// A shape to compute, with its cut cells if they are known already. Refers to both.
template <int dim>
struct CutShape {
  const LevelSet<dim>& psi;
  const CutDomain<dim>* domain;  ///< cut_domain() of psi; null: not computed yet

  CutShape(const LevelSet<dim>& shape, const CutDomain<dim>* cells = nullptr) : psi(shape), domain(cells) {}
};

}  // namespace wheelwright
