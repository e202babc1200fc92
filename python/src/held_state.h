#pragma once

#include <memory>

#include "wheelwright/mechanics/state/state.h"

namespace wheelwright::python {

/// A state as Python holds it: with its solver, which must outlive it, and its shape.
template <int dim>
struct HeldState {
  std::shared_ptr<const StateSolver<dim>> solver;
  std::shared_ptr<const State<dim>> state;
  std::shared_ptr<const LevelSet<dim>> shape;
};

/// The law of a material, with the solver that it belongs to.
template <int dim>
struct HeldMaterial {
  std::shared_ptr<const StateSolver<dim>> solver;
  const MaterialLaw<dim>* law;
};

}  // namespace wheelwright::python
