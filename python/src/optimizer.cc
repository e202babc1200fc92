#include "wheelwright/optimization/optimizer/optimizer.h"

#include <pybind11/stl.h>

#include "computed.h"
#include "held_evaluation.h"
#include "module.h"
#include "views.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/run/checkpoints/checkpoint.h"
#include "wheelwright/run/study/moved_studies.h"
#include "wheelwright/shape/cut/measure.h"
#include "wheelwright/shape/evolution/next_shape.h"

namespace wheelwright::python {
namespace {

/// A state of the loop, with the degree of the map that places its gradients.
template <int dim>
struct HeldProgress {
  OptimizationState<dim> state;
  int map_degree;
};

/// A trial as Python is told of it.
template <int dim>
struct TrialReport {
  int iteration, halvings;
  double step;
  std::string verdict;
  std::string failure, detail;
  double value;
};

template <int dim>
TrialReport<dim> report(const Trial<dim>& trial) {
  return {trial.iteration,
          trial.halvings,
          trial.step,
          to_string(trial.verdict),
          trial.failure ? to_string(trial.failure->reason) : "",
          trial.failure ? trial.failure->detail : "",
          trial.evaluation ? trial.evaluation->function("objective").value : std::nan("")};
}

/// The loop of a study, one accepted shape after the other. Ctrl-C ends a shape, and the loop can go on from
/// the one before.
template <int dim>
class Loop {
 public:
  explicit Loop(std::shared_ptr<const Study<dim>> study)
      : study_(std::move(study)),
        optimizer_(optimizer_of(*study_, moved_studies(*study_), interrupt_by(*signals_))) {}

  HeldProgress<dim> start(const LevelSet<dim>& initial) {
    return {ended([&] { return optimizer_.start(initial, observer()); }), study_->model().degree};
  }

  /// The next state, or why there is none.
  std::variant<HeldProgress<dim>, std::string> advance(const HeldProgress<dim>& from) {
    OptimizationState<dim> state = from.state;
    std::optional<StopReason> reason;
    {
      const Computing computing;
      reason = optimizer_.advance(state, observer(), [&] { return signals_->raised(); });
    }
    signals_->rethrow();
    if (reason) return to_string(*reason);
    return HeldProgress<dim>{std::move(state), from.map_degree};
  }

  std::optional<std::string> reason_to_stop(const HeldProgress<dim>& at) const {
    const auto reason = wheelwright::reason_to_stop(study_->optimizer, at.state);
    return reason ? std::optional<std::string>(to_string(*reason)) : std::nullopt;
  }

  std::vector<TrialReport<dim>> take_trials() { return std::exchange(trials_, {}); }

 private:
  typename ShapeOptimizer<dim>::Observer observer() {
    return
        [this](const Trial<dim>& trial, const OptimizationState<dim>&) { trials_.push_back(report(trial)); };
  }

  template <class Compute>
  OptimizationState<dim> ended(const Compute& compute) {
    auto result = without_gil(compute);
    signals_->rethrow();
    return value_of(std::move(result));
  }

  std::shared_ptr<const Study<dim>> study_;
  std::unique_ptr<Signals> signals_ = std::make_unique<Signals>();
  ShapeOptimizer<dim> optimizer_;
  std::vector<TrialReport<dim>> trials_;
};

/// The stages of Evolver that a loop of Python needs.
template <int dim>
void bind_evolver(py::module_& m) {
  using Evolve = Evolver<dim>;
  const auto moved = [](auto&& stage) { return value_of(without_gil(stage)); };
  py::class_<Evolve>(m, "Evolver")
      .def(py::init([](const Study<dim>& study) {
        return without_gil([&] { return Evolve(study.initial.lattice, study.evolution); });
      }))
      .def("velocity",
           [moved](const Evolve& evolver, const HeldEvaluation<dim>& held, const std::string& name,
                   bool preserves_measure) {
             held.function(name);
             const auto gradient = held.evaluation.gradient(name);
             auto velocity = moved([&] {
               return preserves_measure ? evolver.measure_preserving_velocity(gradient)
                                        : evolver.velocity(gradient);
             });
             Shape shape{held.shape->lattice.nodes()[1], held.shape->lattice.nodes()[0]};
             if constexpr (dim == 3) shape.insert(shape.begin() + 1, held.shape->lattice.nodes()[2]);
             return owned(std::move(velocity), shape);
           })
      .def("move",
           [moved](const Evolve& evolver, const LevelSet<dim>& psi, const Array& velocity, double distance) {
             const auto along = numbers(velocity);
             if (along.size() != psi.values.size())
               throw py::value_error("a velocity has one value per node of the shape");
             return moved([&] { return evolver.move(psi, along, distance); });
           })
      .def("redistance",
           [moved](const Evolve& evolver, const LevelSet<dim>& psi) {
             return moved([&] { return evolver.redistance(psi); });
           })
      .def("smooth", [moved](const Evolve& evolver,
                             const LevelSet<dim>& psi) { return moved([&] { return evolver.smooth(psi); }); })
      .def("with_measure", [moved](const Evolve& evolver, const LevelSet<dim>& psi, double target) {
        return moved([&]() -> Expected<LevelSet<dim>> {
          double length = 0;
          for (const auto& sample : boundary_samples(psi)) length += sample.weight;
          auto measured = evolver.with_measure(psi, target, length);
          if (!measured) return measured.failure();
          return std::move(measured->shape);
        });
      });
}

template <int dim>
HeldProgress<dim> restored(const py::bytes& bytes, int map_degree) {
  auto state = parse_state_file<dim>(std::string_view(bytes));
  if (!state) raise("FormatError", to_string(state.failure().fault), state.failure().detail);
  return {*std::move(state), map_degree};
}

}  // namespace

template <int dim>
void bind_optimizer(py::module_& m) {
  using Held = HeldProgress<dim>;
  py::class_<TrialReport<dim>>(m, "Trial")
      .def_readonly("iteration", &TrialReport<dim>::iteration)
      .def_readonly("halvings", &TrialReport<dim>::halvings)
      .def_readonly("step", &TrialReport<dim>::step)
      .def_readonly("verdict", &TrialReport<dim>::verdict)
      .def_readonly("failure", &TrialReport<dim>::failure)
      .def_readonly("detail", &TrialReport<dim>::detail)
      .def_readonly("value", &TrialReport<dim>::value);
  py::class_<Held>(m, "Progress")
      .def_property_readonly("dimension", [](const Held&) { return dim; })
      .def_property_readonly("level_set", [](const Held& held) { return held.state.shape; })
      .def_property_readonly("evaluation",
                             [](const Held& held) {
                               return HeldEvaluation<dim>{
                                   held.state.evaluation,
                                   std::make_shared<const LevelSet<dim>>(held.state.shape),
                                   held.map_degree,
                                   {}};
                             })
      .def_property_readonly("iteration", [](const Held& held) { return held.state.iteration; })
      .def_property_readonly("step", [](const Held& held) { return held.state.step; })
      .def_property_readonly("measure", [](const Held& held) { return held.state.measure; })
      .def_property_readonly("objectives",
                             [](const Held& held) {
                               std::vector<double> objectives;
                               for (const auto& shape : held.state.history)
                                 objectives.push_back(shape.objective);
                               return objectives;
                             })
      .def(
          "save",
          [](const Held& held) { return py::make_tuple(py::bytes(state_file(held.state)), held.map_degree); })
      .def_static("restore", &restored<dim>);
  py::class_<Loop<dim>>(m, "Loop")
      .def(py::init(
          [](std::shared_ptr<Study<dim>> study) { return std::make_unique<Loop<dim>>(std::move(study)); }))
      .def("start", &Loop<dim>::start)
      .def("advance", &Loop<dim>::advance)
      .def("reason_to_stop", &Loop<dim>::reason_to_stop)
      .def("take_trials", &Loop<dim>::take_trials);
  bind_evolver<dim>(m);
}

template void bind_optimizer<2>(py::module_&);
template void bind_optimizer<3>(py::module_&);

}  // namespace wheelwright::python
