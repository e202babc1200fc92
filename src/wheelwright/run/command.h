#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "wheelwright/base/expected.h"
#include "wheelwright/case/case.h"

namespace wheelwright {

/// Why a command was not obeyed: one line. It has then changed nothing.
struct Refusal {
  std::string reason;
};

/// What a command may do to a run, between two trial shapes.
class RunControl {
 public:
  virtual ~RunControl() = default;

  virtual const Case& current_case() const = 0;
  /// Number of the last accepted shape.
  virtual int iteration() const = 0;

  /// Saves the last accepted shape, unless it is saved.
  virtual void save() = 0;
  /// Ends the run, saved.
  virtual void stop() = 0;
  /// Waits for further commands, from now on or after so many more accepted shapes.
  virtual void pause(int after_shapes) = 0;
  virtual void go_on() = 0;
  /// Proceeds with another case: it is checked as a case file is, the current shape is evaluated under it,
  /// and the run's folder follows. `what` says what changes, for people and for history.csv.
  virtual std::optional<Refusal> change_case(const Case& changed, const std::string& what) = 0;
};

/// What was done, one line; empty where there is nothing to say.
using Obeyed = Expected<std::string, Refusal>;

/// Saves a checkpoint.
struct Save {
  Obeyed obey(RunControl& run) const;
};

/// Ends the run, saved. Interrupts the evaluation of a trial shape, but no command before it.
struct Stop {
  Obeyed obey(RunControl& run) const;
};

/// Waits until Continue, Step or Stop.
struct Pause {
  Obeyed obey(RunControl& run) const;
};

struct Continue {
  Obeyed obey(RunControl& run) const;
};

/// One more accepted shape, then a pause.
struct Step {
  Obeyed obey(RunControl& run) const;
};

/// Other weights of the objective's terms; weights that are absent do not change.
struct NewWeights {
  std::optional<double> strain_energy = {}, uniformity_annulus = {}, uniformity_dual = {}, uniformity_l2 = {};

  Obeyed obey(RunControl& run) const;
};

/// Another section `load` of the case.
struct NewLoad {
  Load load;

  Obeyed obey(RunControl& run) const;
};

/// A command from outside the program, such as a script or a test.
struct Custom {
  std::function<Obeyed(RunControl& run)> obey;
};

/// The commands that a run obeys. To add one: a struct with obey() as above, in a file of its own, and its
/// name in this list.
using Command = std::variant<Save, Stop, Pause, Continue, Step, NewWeights, NewLoad, Custom>;

}  // namespace wheelwright
