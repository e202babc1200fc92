#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/run/model.h"
#include "wheelwright/run/checkpoint.h"

namespace wheelwright {

/// What a run found for one expectation of its case.
struct Finding {
  Expectation expectation;
  std::optional<double> found;  ///< empty: the shape was not reached

  /// Whether it is as expected.
  bool met() const;
  /// One line for people, e.g. "strain_energy of the last shape: 34.96, as expected within 1 %".
  std::string text() const;
};

/// Watches the accepted shapes of a run for what its case expects of them.
class ExpectationWatch {
 public:
  /// `found` was noted before the run was stopped, if it was.
  ExpectationWatch(const std::vector<Expectation>& expectations, const std::vector<FoundQuantity>& found);

  /// Notes what is expected of this shape by its number.
  void operator()(const RollingProblem<2>& problem, const OptimizationState<2>& state);

  /// What was noted of shapes so far.
  std::vector<FoundQuantity> found() const;

  /// One finding an expectation, in their order; `last` is the last accepted shape.
  std::vector<Finding> findings(const RollingProblem<2>& problem, const OptimizationState<2>& last) const;

 private:
  std::vector<Finding> findings_;
};

}  // namespace wheelwright
