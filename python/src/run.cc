#include "wheelwright/run/session/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include "computed.h"
#include "held_case.h"
#include "module.h"
#include "wheelwright/case/write.h"
#include "wheelwright/run/commands/command_json.h"
#include "wheelwright/run/observers/event_lines.h"

namespace wheelwright::python {
namespace {

/// What a callback of a run raised first: the run is asked to save and stop, and then it is raised again.
class CallbackErrors {
 public:
  explicit CallbackErrors(CommandQueue& commands) : commands_(commands) {}

  /// call(), with the GIL, unless something was raised already.
  template <class Call>
  void guard(const Call& call) {
    const py::gil_scoped_acquire gil;
    if (error_) return;
    try {
      call();
    } catch (py::error_already_set& error) {
      error_.emplace(error);
      commands_.push(Stop{});
    }
  }

  /// With the GIL.
  void rethrow() {
    if (!error_) return;
    py::error_already_set error = *std::move(error_);
    error_.reset();
    throw error;
  }

 private:
  CommandQueue& commands_;
  std::optional<py::error_already_set> error_;
};

/// Tells Python of every accepted shape.
template <int dim>
class ShapeObserver : public Observer<dim> {
 public:
  ShapeObserver(py::function callback, CallbackErrors& errors)
      : callback_(std::move(callback)), errors_(errors) {}
  ~ShapeObserver() override {
    const py::gil_scoped_acquire gil;
    callback_ = py::object();
  }

  void operator()(const Event<dim>& event, const RunView<dim>& run) override {
    const auto* done = std::get_if<TrialDone<dim>>(&event);
    if (!done || done->trial.verdict != Verdict::accepted) return;
    errors_.guard([&] { callback_(py::bytes(state_file(done->state)), run.study.model().degree); });
  }

 private:
  py::object callback_;
  CallbackErrors& errors_;
};

template <int dim>
struct NotBegunText {
  [[noreturn]] void operator()(const FolderInUse& in_use) const {
    raise("RunError", "folder_in_use", to_string(in_use) + " is writing to this folder");
  }
  [[noreturn]] void operator()(const FolderHoldsARun&) const {
    raise("RunError", "folder_holds_a_run", "the folder contains a run; Run.resume continues it");
  }
  [[noreturn]] void operator()(const ForeignFiles& foreign) const {
    raise("RunError", "foreign_files",
          fmt::format("{}: not written by a run, so not replaced", fmt::join(foreign.names, ", ")));
  }
  [[noreturn]] void operator()(const CheckpointsGone&) const {
    raise("RunError", "checkpoints_gone", "its checkpoints are missing; it cannot continue");
  }
  [[noreturn]] void operator()(const NoUsableCheckpoint& none) const {
    std::string text = "no usable checkpoint";
    for (const auto& [file, reason] : none.unusable) text += fmt::format("; {}: {}", file.string(), reason);
    raise("RunError", "no_usable_checkpoint", text);
  }
  [[noreturn]] void operator()(const CheckpointMisfit& misfit) const {
    raise("RunError", "checkpoint_misfit", misfit.reason);
  }
  [[noreturn]] void operator()(const AlreadyFinished<dim>& finished) const {
    raise("RunError", "already_finished",
          fmt::format("the run is finished: {} shapes ({})", finished.end.state.iteration,
                      to_string(*finished.end.finished)));
  }
  [[noreturn]] void operator()(const Failure& failure) const { raise(failure); }
};

/// A run with its commands. Its folder is locked until it has been executed.
template <int dim>
class HeldRun {
 public:
  HeldRun(const std::string& folder, Expected<Run<dim>, NotBegun<dim>> run) : folder_(folder) {
    if (!run) std::visit(NotBegunText<dim>(), run.failure());
    run_.emplace(*std::move(run));
  }

  static std::unique_ptr<HeldRun> begun(const HeldCase& held, const std::string& folder) {
    return std::make_unique<HeldRun>(folder,
                                     without_gil([&] { return Run<dim>::begin(held.value, folder); }));
  }
  static std::unique_ptr<HeldRun> resumed(const HeldCase& held, const std::string& folder) {
    return std::make_unique<HeldRun>(folder,
                                     without_gil([&] { return Run<dim>::resume(held.value, folder); }));
  }

  void send(const std::string& json) {
    auto command = parse_command(json);
    if (!command) throw py::value_error(command.failure().reason);
    // The queue's owner may wait for the GIL, to ask for signals.
    const auto commands = commands_;
    const py::gil_scoped_release release;
    commands->push(*std::move(command));
  }

  /// (reason, state, how many trials failed at the end). Callbacks may be None.
  py::tuple execute(const py::object& on_event, const py::object& on_shape) {
    if (!run_) raise("RunError", "executed", "the run has been executed; Run.resume continues it");
    Signals signals;
    CallbackErrors errors(*commands_);
    commands_->add_source([&signals]() -> std::optional<Command> {
      return signals.raised() ? std::optional<Command>(Stop{}) : std::nullopt;
    });
    if (!on_event.is_none())
      run_->add(std::make_unique<EventLines<dim>>(
          [&errors, &on_event](const std::string& line) { errors.guard([&] { on_event(line); }); }));
    if (!on_shape.is_none()) run_->add(std::make_unique<ShapeObserver<dim>>(on_shape, errors));
    const int degree = run_->study().model().degree;
    const auto end = [this] {
      run_.reset();
      commands_ = std::make_shared<CommandQueue>();
    };
    std::optional<RunResult<dim>> result;
    try {
      const Computing computing;
      result.emplace(run_->execute(*commands_));
    } catch (...) {
      end();
      throw;
    }
    end();
    signals.rethrow();
    errors.rethrow();
    return ended(*result, degree);
  }

  const std::string& folder() const { return folder_; }
  std::optional<int> resumed_after() const { return run_ ? run_->resumption().shape : std::nullopt; }

 private:
  static py::tuple ended(const RunResult<dim>& result, int degree) {
    py::list findings;
    for (const Finding& finding : result.findings)
      findings.append(py::make_tuple(finding.met(), finding.text()));
    std::string failure;
    if (!result.state && !result.failed_trials.empty() && result.failed_trials.back().failure)
      failure = to_string(*result.failed_trials.back().failure);
    return py::make_tuple(to_string(result.reason),
                          result.state ? py::object(py::bytes(state_file(*result.state))) : py::none(),
                          degree, findings, failure);
  }

  std::string folder_;
  std::optional<Run<dim>> run_;
  std::shared_ptr<CommandQueue> commands_ = std::make_shared<CommandQueue>();
};

}  // namespace

template <int dim>
void bind_run(py::module_& m) {
  using Held = HeldRun<dim>;
  py::class_<Held>(m, "Run")
      .def_property_readonly("dimension", [](const Held&) { return dim; })
      .def_static("begin", &Held::begun)
      .def_static("resume", &Held::resumed)
      .def("send", &Held::send)
      .def("execute", &Held::execute)
      .def_property_readonly("resumed_after", &Held::resumed_after)
      .def_property_readonly("folder", &Held::folder);
}

template void bind_run<2>(py::module_&);
template void bind_run<3>(py::module_&);

}  // namespace wheelwright::python
