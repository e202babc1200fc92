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

  /// The edge of the hole that this point of the ring is in, as a closed polyline round it (Cartesian, body
  /// frame [m]); empty where the point is in no hole, or in one that is not enclosed by material.
  virtual std::vector<Point> hole_at(const Point& point) const = 0;
  /// Draws strokes over the current shape, each over those before it and in all sectors, and evaluates it.
  /// The run proceeds from there.
  virtual std::optional<Refusal> draw(std::span<const Stroke> strokes, const std::string& what) = 0;
  /// Takes the shape in a file (files/level_set_file.h) of a wheel of the same radii, width and number of
  /// sectors, on the run's own grid. The run proceeds from there.
  virtual std::optional<Refusal> take_shape(const std::filesystem::path& file, const std::string& what) = 0;
  /// Back to the initial shape, under the case as it is.
  virtual std::optional<Refusal> reset() = 0;
  /// Back to the case and the shape before the last change_case(), draw(), take_shape() or reset() that is
  /// not undone. Returns what that change was, as it was told.
  virtual Expected<std::string, Refusal> undo() = 0;
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

/// Another load: the section `load` of a case with one load, or that of a load case. Load cases share the
/// lateral force, the camber and the load positions, which it must not change there.
struct NewLoad {
  Load load;                                  ///< complete; without load cases of its own
  std::optional<std::string> load_case = {};  ///< its name

  Obeyed obey(RunControl& run) const;
};

/// Another target of the volume, as a fraction of the ring: the run moves there by volume.rate per shape.
struct NewVolume {
  double target;

  Obeyed obey(RunControl& run) const;
};

/// Another thinnest wall, narrowest gap and smallest radius of internal corners [m]; 0 allows any. What is
/// absent does not change.
struct NewWidths {
  std::optional<double> minimum_wall = {}, minimum_gap = {}, minimum_radius = {};

  Obeyed obey(RunControl& run) const;
};

/// Another value of a bound that the case has, in the units of its `[[constraint]]`.
struct NewBound {
  int constraint;  ///< its place in the case, from 0
  std::optional<double> at_least = {}, at_most = {}, equals = {};

  Obeyed obey(RunControl& run) const;
};

/// Draws a line with a round tip, as with a brush, in every sector: a hole or material. A single point is a
/// disc. What is larger than the wheel or misses it is refused (edit_bounds.h).
struct Paint {
  Fill as = Fill::hole;
  std::vector<std::array<double, 2>> path;  ///< Cartesian, body frame [m]
  double radius = 0;                        ///< of the tip [m]

  Obeyed obey(RunControl& run) const;
};

/// Moves a hole, and its images in the other sectors, and multiplies its size about its centre, by 0.01 to
/// 100.
struct MoveHole {
  std::array<double, 2> at{};  ///< a point in the hole: Cartesian, body frame [m]
  std::array<double, 2> by{};  ///< [m]
  double scale = 1;

  Obeyed obey(RunControl& run) const;
};

/// Fills a hole, and its images in the other sectors, with material.
struct FillHole {
  std::array<double, 2> at{};  ///< a point in the hole: Cartesian, body frame [m]

  Obeyed obey(RunControl& run) const;
};

/// Takes the shape of another run, e.g. of a design of a sweep.
struct TakeShape {
  std::string file;  ///< its level set

  Obeyed obey(RunControl& run) const;
};

/// Back to the initial shape.
struct Reset {
  Obeyed obey(RunControl& run) const;
};

/// Back to what was before the last change of case or shape by a command.
struct Undo {
  Obeyed obey(RunControl& run) const;
};

/// A command from outside the program, such as a script or a test.
struct Custom {
  std::function<Obeyed(RunControl& run)> obey;
};

/// The commands that a run obeys. To add one: a struct with obey() as above, in a file of its own, and its
/// name in this list.
using Command = std::variant<Save, Stop, Pause, Continue, Step, NewWeights, NewLoad, NewVolume, NewWidths,
                             NewBound, Paint, MoveHole, FillHole, TakeShape, Reset, Undo, Custom>;

}  // namespace wheelwright
