#pragma once

#include "wheelwright/cut/cut_domain.h"

namespace wheelwright {

/// A shape that is to be computed, with its cut cells if something before has made them: a level set alone is
/// one too. Refers to both.
template <int dim>
struct CutShape {
  const LevelSet<dim>& psi;
  const CutDomain<dim>* domain;  ///< cut_domain() of psi; null: not made yet

  CutShape(const LevelSet<dim>& shape, const CutDomain<dim>* cells = nullptr) : psi(shape), domain(cells) {}
};

}  // namespace wheelwright
