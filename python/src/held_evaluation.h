#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "errors.h"
#include "held_state.h"
#include "wheelwright/run/study/study.h"

namespace wheelwright::python {

/// An evaluation with its shape and, unless it comes from another process, with the states under all load
/// cases.
template <int dim>
struct HeldEvaluation {
  Evaluation<dim> evaluation;
  std::shared_ptr<const LevelSet<dim>> shape;
  int map_degree;
  std::vector<HeldState<dim>> states;

  /// KeyError if there is none of that name.
  const FunctionValue& function(const std::string& name) const {
    const auto found = std::ranges::find(evaluation.functions, name, &FunctionValue::name);
    if (found != evaluation.functions.end()) return *found;
    std::string known;
    for (const FunctionValue& one : evaluation.functions) known += (known.empty() ? "" : ", ") + one.name;
    throw py::key_error("no function is named " + name + "; there are " + known);
  }
};

template <int dim>
HeldEvaluation<dim> held_evaluation(const Study<dim>& study, const LevelSet<dim>& psi,
                                    Evaluated<dim> evaluated) {
  const auto shape = std::make_shared<const LevelSet<dim>>(psi);
  std::vector<HeldState<dim>> states{{study.solver, std::move(evaluated.state), shape}};
  for (auto& other : evaluated.others) states.push_back({study.solver, std::move(other), shape});
  return {std::move(evaluated.evaluation), shape, study.model().degree, std::move(states)};
}

}  // namespace wheelwright::python
