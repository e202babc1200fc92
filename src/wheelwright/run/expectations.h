#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/run/observer.h"

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
template <int dim>
class ExpectationWatch : public Observer<dim> {
 public:
  ExpectationWatch(std::vector<Expectation> expectations, const std::optional<Checkpoint<dim>>& resumed);

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
  void add_to(Checkpoint<dim>& checkpoint) override;

 private:
  std::vector<Expectation> expectations_;
  std::vector<FoundQuantity> found_;
};

/// The values of what is expected of this shape by its number. `solution` is the shape's, of all load
/// positions or of those that stand for them.
template <int dim>
std::vector<FoundQuantity> found_quantities(const std::vector<Expectation>& expectations,
                                            const StateSolver<dim>& solver,
                                            const OptimizationState<dim>& state,
                                            const State<dim>& solution);

/// One finding for each expectation, in their order: from what was found along the way and from the last
/// accepted shape. Without the last shape's solution, its stress is not computed.
template <int dim>
std::vector<Finding> findings(const std::vector<Expectation>& expectations,
                              const std::vector<FoundQuantity>& found, const StateSolver<dim>& solver,
                              const OptimizationState<dim>& last, const State<dim>* solution);

/// Whether any of them is about the stress, which only a solution can tell.
bool need_a_solution(const std::vector<Expectation>& expectations);

}  // namespace wheelwright
