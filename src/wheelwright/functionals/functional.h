#pragma once

#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "wheelwright/base/quantity.h"
#include "wheelwright/rolling/rolling_problem.h"

namespace wheelwright {

/// The derivative of a criterion's share J_i of every position i with respect to its displacement v, as
/// loads: with K the ring's stiffness and T the tread's observations (RollingSolution's columns and rows),
///   -dJ_i/dv = -state_weight K v + ghost_weight G v + T^T observations, G the ghost penalty.
/// An empty matrix is zero.
struct AdjointLoads {
  double state_weight = 0;
  double ghost_weight = 0;
  Matrix observations;
};

/// A criterion at one shape.
struct CriterionTerm {
  std::vector<double> values;  ///< J_i of every position that was solved for, the same as its mirror image's
  AdjointLoads loads;

  /// Summed over the load positions of one sector.
  double value(const LoadPositions& positions) const {
    return std::inner_product(values.begin(), values.end(), positions.multiplicities.begin(), 0.0);
  }
};

/// A criterion of the form (36), summed over the load positions. To add one: a file with a class like this, a
/// finite-difference test, and its line in the list of criteria
/// (run/model.cc).
template <int dim>
class Criterion {
 public:
  virtual ~Criterion() = default;

  /// As in the case file and in history files.
  virtual std::string name() const = 0;

  /// `mean`: what mean_observations() gives, of this solution or held from an earlier shape. At this
  /// solution's own mean the loads are the exact derivative: deviations sum to zero over the positions, so
  /// that the mean's own derivative drops out.
  virtual CriterionTerm evaluate(const RollingProblem<dim>& problem, const RollingSolution<dim>& solution,
                                 const Matrix& mean) const = 0;

  /// M(u, x) of (36) at a point of the moving boundary, per unit volume; zero for what lives at the tread. A
  /// quadratic form of the strain: only so is its sum over the load cases that over their modes.
  virtual double boundary_density(const Voigt<dim>&, const Voigt<dim>&) const { return 0; }
};

/// A term of the objective (6).
template <int dim>
struct WeightedCriterion {
  double weight;
  std::shared_ptr<const Criterion<dim>> criterion;
};

template <int dim>
using Criteria = std::vector<WeightedCriterion<dim>>;

}  // namespace wheelwright
