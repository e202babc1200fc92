#include <pybind11/stl.h>

#include "computed.h"
#include "held_case.h"
#include "held_evaluation.h"
#include "module.h"
#include "views.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/mechanics/state/place_in_body.h"
#include "wheelwright/optimization/sensitivity/taylor_test.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/results/refined_numbers.h"
#include "wheelwright/run/study/gradient_check.h"

namespace wheelwright::python {
namespace {

template <int dim>
Study<dim> study_of(const HeldCase& held, int level) {
  return computed([&](const Interrupt&) { return make_study<dim>(held.value, level); });
}

template <int dim>
HeldEvaluation<dim> evaluation_at(const Study<dim>& study, const LevelSet<dim>& psi) {
  auto evaluated = computed([&](const Interrupt& interrupt) {
    return evaluate_of(study, interrupt)(psi, static_cast<const Evaluation<dim>*>(nullptr));
  });
  return held_evaluation(study, psi, std::move(evaluated));
}

/// The states under all load cases, at all positions.
template <int dim>
std::vector<HeldState<dim>> states_at(const Study<dim>& study, const LevelSet<dim>& psi) {
  auto states = computed([&](const Interrupt& interrupt) {
    return states_of_cases<dim>(*study.solver, study.load_cases, psi, study.solver->all_positions(),
                                interrupt);
  });
  const auto shape = std::make_shared<const LevelSet<dim>>(psi);
  std::vector<HeldState<dim>> result;
  for (auto& state : states) result.push_back({study.solver, std::move(state), shape});
  return result;
}

/// (value, derivative, steps, remainders, orders) of every function.
py::tuple as_tuple(const TaylorTest& test) {
  return py::make_tuple(test.value, test.derivative, test.steps, test.remainders, test.orders);
}

template <int dim>
py::dict taylor_tests_at(const Study<dim>& study, const LevelSet<dim>& psi, const Array& direction,
                         double step, int halvings) {
  const std::vector<double> along = numbers(direction);
  if (along.size() != psi.values.size())
    throw py::value_error("a direction has one value per node of the shape");
  const auto tests = computed([&](const Interrupt& interrupt) -> Expected<std::vector<TaylorTest>> {
    const std::function<Expected<Evaluation<dim>>(const LevelSet<dim>&)> evaluation =
        [&](const LevelSet<dim>& at) -> Expected<Evaluation<dim>> {
      auto evaluated =
          evaluate<dim>(*study.solver, study.functions, at, nullptr, interrupt, study.load_cases);
      if (!evaluated) return evaluated.failure();
      return std::move(evaluated->evaluation);
    };
    const auto start = evaluation(psi);
    if (!start) return start.failure();
    return taylor_tests<dim>(evaluation, *start, psi, along, study.model().degree, step, halvings);
  });
  py::dict result;
  for (std::size_t i = 0; i < tests.size(); ++i)
    result[py::str(study.functions[i].name)] = as_tuple(tests[i]);
  return result;
}

/// (function, radius, passed, is smoothed, lowest order, largest error, test) of every function.
template <int dim>
py::list gradient_checks(const Study<dim>& study, const LevelSet<dim>& psi) {
  const auto checks =
      computed([&](const Interrupt& interrupt) { return check_gradients(study, psi, interrupt); });
  py::list result;
  for (const GradientCheck& check : checks)
    result.append(py::make_tuple(check.function, check.passed(), check.is_smoothed, check.lowest_order(),
                                 check.largest_error(), as_tuple(check.test)));
  return result;
}

/// (key, label, value, error or None, reason) of every number, with the levels of the tread that results
/// have.
template <int dim>
py::list accurate_numbers(const Study<dim>& study, const LevelSet<dim>& psi, double accuracy) {
  if (!(accuracy > 0)) throw py::value_error("the accuracy must be positive");
  const auto result = computed([&](const Interrupt& interrupt) -> Expected<AccurateNumbers> {
    const Case c = with_levels_of_results(study.computed());
    const auto solver = make_solver(rolling_model<dim>(c));
    if (!solver) return solver.failure();
    const auto states = (*solver)->states(psi, (*solver)->all_positions(), interrupt);
    if (!states) return states.failure();
    return refined_numbers(c, **solver, psi, SolvedStates<dim>(*states),
                           solved_finer_shape(c, **solver, psi, interrupt), accuracy, interrupt);
  });
  py::list numbers;
  for (const AccurateNumber& one : result.numbers)
    numbers.append(py::make_tuple(one.key, one.label, one.value, one.error, one.reason));
  return numbers;
}

template <int dim>
py::array points(const HeldEvaluation<dim>& held, const std::vector<SurfacePoint<dim>>& boundary) {
  std::vector<Vec<dim>> places;
  for (const auto& point : boundary)
    places.push_back(cartesian_place<dim>(held.shape->lattice.grid(), held.map_degree, point.cell, point.xi));
  return rows<dim>(places);
}

/// (points, normals, weights, density) at the boundary, or at the edges in the side faces.
template <int dim>
py::tuple gradient(const py::object& self, const std::string& name, bool at_edges) {
  const auto& held = py::cast<const HeldEvaluation<dim>&>(self);
  const auto& list = at_edges ? held.evaluation.edges : held.evaluation.boundary;
  const FunctionValue& function = held.function(name);
  const auto& density = at_edges ? function.edge_gradient : function.gradient;
  return py::make_tuple(points(held, list), members(self, list, &SurfacePoint<dim>::normal),
                        members(self, list, &SurfacePoint<dim>::weight),
                        view(self, density.data(), {static_cast<py::ssize_t>(density.size())}));
}

template <int dim>
py::array nodal(const HeldEvaluation<dim>& held, const std::string& name) {
  held.function(name);
  auto sums = nodal_gradient(held.evaluation.gradient(name), *held.shape, held.map_degree);
  const auto at_edges = nodal_gradient(held.evaluation.edge_gradient(name), *held.shape, held.map_degree);
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += at_edges[i];
  const auto& nodes = held.shape->lattice.nodes();
  Shape shape{nodes[1], nodes[0]};
  if constexpr (dim == 3) shape.insert(shape.begin() + 1, nodes[2]);
  return owned(std::move(sums), shape);
}

template <int dim>
py::tuple saved(const HeldEvaluation<dim>& held) {
  return py::make_tuple(py::bytes(evaluation_file(held.evaluation)), py::bytes(level_set_file(*held.shape)),
                        held.map_degree);
}

template <int dim>
HeldEvaluation<dim> restored(const py::tuple& saved) {
  const auto bytes = saved[0].cast<std::string>(), of_shape = saved[1].cast<std::string>();
  auto evaluation = parse_evaluation_file<dim>(bytes);
  if (!evaluation) raise("FormatError", to_string(evaluation.failure().fault), evaluation.failure().detail);
  auto shape = parse_level_set_file<dim>(of_shape);
  if (!shape) raise("FormatError", to_string(shape.failure().fault), shape.failure().detail);
  return {*std::move(evaluation),
          std::make_shared<const LevelSet<dim>>(*std::move(shape)),
          saved[2].cast<int>(),
          {}};
}

template <int dim>
void bind_evaluation(py::module_& m) {
  using Held = HeldEvaluation<dim>;
  py::class_<Held>(m, "Evaluation")
      .def_property_readonly("dimension", [](const Held&) { return dim; })
      .def_property_readonly("names",
                             [](const Held& held) {
                               std::vector<std::string> names;
                               for (const auto& function : held.evaluation.functions)
                                 names.push_back(function.name);
                               return names;
                             })
      .def("value", [](const Held& held, const std::string& name) { return held.function(name).value; })
      .def("unit", [](const Held& held,
                      const std::string& name) { return std::string(unit<dim>(held.function(name).unit)); })
      .def("bounds",
           [](const Held& held, const std::string& name) {
             const Bounds& bounds = held.function(name).bounds;
             return std::pair(bounds.lower, bounds.upper);
           })
      .def("by_position",
           [](const py::object& self, const std::string& name) {
             const auto& values = py::cast<const Held&>(self).function(name).by_position;
             return view(self, values.data(), {static_cast<py::ssize_t>(values.size())});
           })
      .def("gradient", &gradient<dim>)
      .def("nodal_gradient", &nodal<dim>)
      .def_property_readonly("terms",
                             [](const Held& held) {
                               std::map<std::string, double> terms;
                               for (const auto& term : held.evaluation.terms) terms[term.name] = term.value;
                               return terms;
                             })
      .def_property_readonly("measures",
                             [](const Held& held) {
                               std::map<std::string, double> measures;
                               for (const auto& [name, value] : held.evaluation.measures)
                                 measures[name] = value;
                               return measures;
                             })
      .def_property_readonly("newton_iterations",
                             [](const Held& held) { return held.evaluation.newton_iterations; })
      .def_property_readonly("seconds",
                             [](const Held& held) {
                               py::dict phases;
                               for (const auto& [phase, seconds] : held.evaluation.phases)
                                 phases[py::str(phase)] = seconds;
                               return phases;
                             })
      .def_property_readonly("level_set", [](const Held& held) { return LevelSet<dim>(*held.shape); })
      .def_property_readonly("states", [](const Held& held) { return held.states; })
      .def("save", &saved<dim>)
      .def_static("restore", &restored<dim>);
}

}  // namespace

template <int dim>
void bind_study(py::module_& m) {
  bind_evaluation<dim>(m);
  py::class_<Study<dim>, std::shared_ptr<Study<dim>>>(m, "Study")
      .def(py::init(&study_of<dim>))
      .def_property_readonly("initial", [](const Study<dim>& study) { return study.initial; })
      .def_property_readonly("functions",
                             [](const Study<dim>& study) {
                               std::vector<std::string> names;
                               for (const auto& function : study.functions) names.push_back(function.name);
                               return names;
                             })
      .def_property_readonly("load_cases",
                             [](const Study<dim>& study) {
                               std::vector<std::string> names;
                               for (const auto& load_case : study.load_cases) names.push_back(load_case.name);
                               return names;
                             })
      .def("evaluate", &evaluation_at<dim>)
      .def("solve", &states_at<dim>)
      .def("taylor_tests", &taylor_tests_at<dim>)
      .def("accurate_numbers", &accurate_numbers<dim>)
      .def("check_gradients", &gradient_checks<dim>);
}

template void bind_study<2>(py::module_&);
template void bind_study<3>(py::module_&);

}  // namespace wheelwright::python
