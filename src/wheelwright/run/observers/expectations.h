#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// The result of a run for one expectation of its case.
struct Finding {
  Expectation expectation;
  KnownNumber found;  ///< or why it is unknown, e.g. because the shape was not reached

  /// Whether it is as expected.
  bool met() const;
  /// One readable line, e.g. "strain_energy in kerb of the last shape: 34.96, as expected within 1 %".
  std::string text() const;
};

/// Records the values of the accepted shapes for which the case has expectations.
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

/// The values of the quantities with expectations for this shape, selected by its number. `solution` is that
/// of the shape under the first of the load cases, at all load positions or at those that represent them.
template <int dim>
std::vector<FoundQuantity> found_quantities(const std::vector<Expectation>& expectations,
                                            const StateSolver<dim>& solver, const LoadCases<dim>& cases,
                                            const OptimizationState<dim>& state,
                                            const std::shared_ptr<const State<dim>>& solution);

/// One finding for each expectation, in their order: from the values recorded during the run, and from the
/// last accepted shape with its solution, or the reason why it has none.
template <int dim>
std::vector<Finding> findings(const std::vector<Expectation>& expectations,
                              const std::vector<FoundQuantity>& found, const StateSolver<dim>& solver,
                              const LoadCases<dim>& cases, const OptimizationState<dim>& last,
                              const SolvedStates<dim>& solution);

/// Whether any of them concerns the stress, which requires a solution.
bool need_a_solution(const std::vector<Expectation>& expectations);

}  // namespace wheelwright
