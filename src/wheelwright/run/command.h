#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/case/case.h"
#include "wheelwright/run/shape_edit.h"

namespace wheelwright {

/// Why a command was refused: one line. It has then changed nothing.
struct Refusal {
  std::string reason;
};

/// The operations that a command can perform on a run, between two trial shapes.
class RunControl {
 public:
  virtual ~RunControl() = default;

  virtual const Case& current_case() const = 0;
  /// Number of the last accepted shape.
  virtual int iteration() const = 0;

  /// Saves the last accepted shape, unless it is saved already.
  virtual void save() = 0;
  /// Saves and ends the run.
  virtual void stop() = 0;
  /// Waits for further commands, now or after this number of further accepted shapes.
  virtual std::optional<Refusal> pause(int after_shapes) = 0;
  /// Also of a run whose search has ended: searches for better shapes again.
  virtual std::optional<Refusal> continue_run() = 0;
  /// Continues with another case: it is checked like a case file, the current shape is evaluated under it,
  /// and the run's folder is updated. `what` describes the change, for display and for history.csv.
  virtual std::optional<Refusal> change_case(const Case& changed, const std::string& what) = 0;

  /// The edge of the hole that contains this point of the ring, as a closed polyline (Cartesian, body frame
  /// [m]); empty if the point is not in a hole, or in one that is not enclosed by material.
  virtual std::vector<Point> hole_at(const Point& point) const = 0;
  /// Draws strokes over the current shape, each over the earlier ones and in all sectors, and evaluates it.
  /// The run continues from there.
  virtual std::optional<Refusal> draw(std::span<const Stroke> strokes, const std::string& what) = 0;
  /// Replaces the shape by that in a file (files/level_set_file.h) of a wheel with the same radii, width and
  /// number of sectors, transferred to the run's grid. The run continues from there.
  virtual std::optional<Refusal> take_shape(const std::filesystem::path& file, const std::string& what) = 0;
  /// Returns to the initial shape, under the current case.
  virtual std::optional<Refusal> reset() = 0;
  /// Returns to the case and shape before the last change_case(), draw(), take_shape() or reset() that is not
  /// undone. Returns the description of that change.
  virtual Expected<std::string, Refusal> undo() = 0;
};

/// What was done, one line; empty if there is nothing to report.
using CommandResult = Expected<std::string, Refusal>;

/// Saves a checkpoint.
struct Save {
  CommandResult execute(RunControl& run) const;
};

/// Saves and ends the run. Interrupts the evaluation of a trial shape, but not an earlier command.
struct Stop {
  CommandResult execute(RunControl& run) const;
};

/// Waits until Continue, Step or Stop.
struct Pause {
  CommandResult execute(RunControl& run) const;
};

struct Continue {
  CommandResult execute(RunControl& run) const;
};

/// One more accepted shape, then a pause.
struct Step {
  CommandResult execute(RunControl& run) const;
};

/// New weights of the objective's terms; absent weights do not change.
struct NewWeights {
  std::optional<double> strain_energy = {}, uniformity_annulus = {}, uniformity_dual = {}, uniformity_l2 = {};

  CommandResult execute(RunControl& run) const;
};

/// A new load: the section `load` of a case with one load, or the load of a load case. Load cases share the
/// lateral force, the camber and the load positions, which it must not change.
struct NewLoad {
  Load load;                                  ///< complete; without load cases
  std::optional<std::string> load_case = {};  ///< its name

  CommandResult execute(RunControl& run) const;
};

/// A new target of the volume, as a fraction of the ring: the run approaches it by volume.rate per shape.
struct NewVolume {
  double target;

  CommandResult execute(RunControl& run) const;
};

/// New minimum widths of walls and gaps and minimum radius of internal corners [m]; 0 allows any. Absent
/// values do not change.
struct NewWidths {
  std::optional<double> minimum_wall = {}, minimum_gap = {}, minimum_radius = {};

  CommandResult execute(RunControl& run) const;
};

/// A new value of an existing bound, in the units of its `[[constraint]]`.
struct NewBound {
  int constraint;  ///< its index in the case
  std::optional<double> at_least = {}, at_most = {}, equals = {};

  CommandResult execute(RunControl& run) const;
};

/// Draws a line with a round brush in every sector, as a hole or material. A single point is a disc. A line
/// that is larger than the wheel or misses it is refused (edit_bounds.h).
struct Paint {
  Fill as = Fill::hole;
  std::vector<std::array<double, 2>> path;  ///< Cartesian, body frame [m]
  double radius = 0;                        ///< of the brush [m]

  CommandResult execute(RunControl& run) const;
};

/// Moves a hole and its images in the other sectors, and scales it about its centre by 0.01 to 100.
struct MoveHole {
  std::array<double, 2> at{};  ///< a point in the hole: Cartesian, body frame [m]
  std::array<double, 2> by{};  ///< [m]
  double scale = 1;

  CommandResult execute(RunControl& run) const;
};

/// Fills a hole, and its images in the other sectors, with material.
struct FillHole {
  std::array<double, 2> at{};  ///< a point in the hole: Cartesian, body frame [m]

  CommandResult execute(RunControl& run) const;
};

/// Replaces the shape by that of another run, e.g. of a design of a sweep.
struct TakeShape {
  std::string file;  ///< its level set

  CommandResult execute(RunControl& run) const;
};

/// Back to the initial shape.
struct Reset {
  CommandResult execute(RunControl& run) const;
};

/// Undoes the last change of case or shape by a command.
struct Undo {
  CommandResult execute(RunControl& run) const;
};

/// A command from outside the program, such as a script or a test.
struct Custom {
  std::function<CommandResult(RunControl& run)> execute;
};

/// The commands that a run executes. To add one, add a struct with execute() as above, its keys in
/// command_json.cc, and its name to this list.
using Command = std::variant<Save, Stop, Pause, Continue, Step, NewWeights, NewLoad, NewVolume, NewWidths,
                             NewBound, Paint, MoveHole, FillHole, TakeShape, Reset, Undo, Custom>;

}  // namespace wheelwright
