#pragma once

#include <functional>
#include <optional>
#include <string>

#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Receives an event of a run as one line of JSON, without the line's end.
using WriteLine = std::function<void(const std::string& line)>;

/// Tells a program what happens in a run: an object of JSON for every event. docs/driving.md explains them,
/// and docs/schema/event.schema.json defines them. Numbers are in SI units; in 2D forces, energies and masses
/// are those of one metre of width, as in history.csv.
template <int dim>
class EventLines : public Observer<dim> {
 public:
  explicit EventLines(WriteLine write) : write_(std::move(write)) {}

  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
  /// Called while the checkpointer, which every run notifies first, handles the event that is next here.
  void add_to(Checkpoint<dim>& checkpoint) override { saved_ = checkpoint.state.iteration; }

 private:
  WriteLine write_;
  std::optional<int> saved_;  ///< shape of a checkpoint that was not told of
};

/// The last line: how the program ends. `reason`: why the run ended; empty if none began. `meaning` of the
/// exit code.
std::string end_line(const std::optional<StopReason>& reason, int exit_code, const std::string& meaning);

}  // namespace wheelwright
