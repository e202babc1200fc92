#pragma once

#include "wheelwright/quantities/functionals/bounds.h"
#include "wheelwright/quantities/functionals/functional.h"
#include "wheelwright/quantities/functionals/quantity.h"

namespace wheelwright {

/// A term of a function: a functional of the states under one of the load cases.
template <int dim>
struct WeightedFunctional {
  double weight;
  std::shared_ptr<const Functional<dim>> functional;
  int load_case = 0;    ///< 0 is the load of the solver's own model
  Quantity quantity{};  ///< the functional's, whose unit it has
};

template <int dim>
using WeightedSum = std::vector<WeightedFunctional<dim>>;

/// A function of the shape: a weighted sum of functionals, summed over the load positions of one sector, and
/// over load cases, as far as its terms name several.
/// Whether it is the objective, a constraint or only watched is the optimizer's business.
template <int dim>
struct ShapeFunction {
  std::string name;
  WeightedSum<dim> terms;
  /// A factor per load position of the sector (all of them, mirror images too); empty: 1.
  std::vector<double> position_weights = {};
  Bounds bounds = {};
  Quantity quantity = {};  ///< the function's, with its unit; by default a sum of energies
  Over over = Over::mean;  ///< which positions it is about, if the quantity has a value at each
};

/// The function that is minimized, by the name that the optimizer looks for.
template <int dim>
ShapeFunction<dim> objective(WeightedSum<dim> terms) {
  return {.name = "objective", .terms = std::move(terms)};
}

/// Whether the functions have the same value for states and their mirror images in a plane: their functionals
/// do, and every position has the weight of its mirror image in the plane of azimuth 0.
template <int dim>
bool are_mirror_symmetric(std::span<const ShapeFunction<dim>> functions, MirrorPlane plane);

}  // namespace wheelwright
