#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "wheelwright/run/commands/command.h"

namespace wheelwright {

/// Saves a checkpoint.
struct Save {
  static constexpr const char *name = "save", *meaning = "saves a checkpoint";
  CommandResult execute(RunControl& run) const;
};

/// Saves and ends the run. Interrupts the evaluation of a trial shape, but not an earlier command.
struct Stop {
  static constexpr const char *name = "stop", *meaning = "saves and ends the run";
  CommandResult execute(RunControl& run) const;
};

/// Waits until Continue, Step or Stop.
struct Pause {
  static constexpr const char *name = "pause", *meaning = "waits until continue, step or stop";
  CommandResult execute(RunControl& run) const;
};

struct Continue {
  static constexpr const char *name = "continue",
                              *meaning =
                                  "ends a pause; if the search has ended, searches for better shapes again";
  CommandResult execute(RunControl& run) const;
};

/// One more accepted shape, then a pause.
struct Step {
  static constexpr const char *name = "step", *meaning = "one more accepted shape, then a pause";
  CommandResult execute(RunControl& run) const;
};

/// New weights of the objective's terms; absent weights do not change.
struct NewWeights {
  static constexpr const char *name = "weights", *meaning = "new weights of the objective's terms";
  std::optional<double> strain_energy = {}, uniformity_annulus = {}, uniformity_dual = {}, uniformity_l2 = {};

  CommandFields fields() {
    return {{"strain_energy", "absent: unchanged", &strain_energy},
            {"uniformity_annulus", "absent: unchanged", &uniformity_annulus},
            {"uniformity_dual", "absent: unchanged", &uniformity_dual},
            {"uniformity_l2", "absent: unchanged", &uniformity_l2}};
  }
  CommandResult execute(RunControl& run) const;
};

/// A new load: the section `load` of a case with one load, or the load of a load case. Load cases share the
/// lateral force, the camber and the load positions, which it must not change.
struct NewLoad {
  static constexpr const char *name = "load", *meaning = "a new load, or that of a load case";
  Load load;                                  ///< complete; without load cases
  std::optional<std::string> load_case = {};  ///< its name

  CommandFields fields();
  CommandResult execute(RunControl& run) const;
};

/// A new target of the volume, as a fraction of the ring: the run approaches it by volume.rate per shape.
struct NewVolume {
  static constexpr const char *name = "volume",
                              *meaning = "a new target of the volume, approached by volume.rate per shape";
  double target;

  CommandFields fields() { return {{"target", "as a fraction of the ring", &target}}; }
  CommandResult execute(RunControl& run) const;
};

/// New minimum widths of walls and gaps and minimum radius of internal corners [m]; 0 allows any. Absent
/// values do not change.
struct NewWidths {
  static constexpr const char *name = "widths", *meaning = "new minimum widths; 0 allows any";
  std::optional<double> minimum_wall = {}, minimum_gap = {}, minimum_radius = {};

  CommandFields fields() {
    return {{"minimum_wall_m", "absent: unchanged", &minimum_wall},
            {"minimum_gap_m", "absent: unchanged", &minimum_gap},
            {"minimum_radius_m", "of internal corners; absent: unchanged", &minimum_radius}};
  }
  CommandResult execute(RunControl& run) const;
};

/// A new value of an existing bound, in the units of its `[[constraint]]`.
struct NewBound {
  static constexpr const char *name = "bound", *meaning = "a new value of an existing bound";
  int constraint;  ///< its index in the case
  std::optional<double> at_least = {}, at_most = {}, equals = {};

  CommandFields fields() {
    return {{"constraint", "its number in the case, from 0", &constraint},
            {"at_least", "in the unit of its quantity; absent: unchanged", &at_least},
            {"at_most", "likewise", &at_most},
            {"equals", "likewise", &equals}};
  }
  CommandResult execute(RunControl& run) const;
};

/// Draws a line with a round brush in every sector, as a hole or material. A single point is a disc. A line
/// that is larger than the wheel or misses it is refused (edit_bounds.h).
struct Paint {
  static constexpr const char *name = "paint", *meaning = "draws a line with a round brush in every sector";
  Fill as = Fill::hole;
  std::vector<std::array<double, 2>> path;  ///< Cartesian, body frame [m]
  double radius = 0;                        ///< of the brush [m]

  CommandFields fields() {
    return {{"as", "hole or material", &as},
            {"path_m", "points [x, y]: Cartesian, body frame", &path},
            {"radius_m", "of the brush", &radius}};
  }
  CommandResult execute(RunControl& run) const;
};

/// Moves a hole and its images in the other sectors, and scales it about its centre by 0.01 to 100.
struct MoveHole {
  static constexpr const char *name = "move_hole", *meaning = "moves and scales a hole in every sector";
  std::array<double, 2> at{};  ///< a point in the hole: Cartesian, body frame [m]
  std::array<double, 2> by{};  ///< [m]
  double scale = 1;

  CommandFields fields() {
    return {{"at_m", "a point [x, y] in the hole: Cartesian, body frame", &at},
            {"by_m", "[x, y]", &by},
            {"scale", "about its centre, 0.01 to 100", &scale}};
  }
  CommandResult execute(RunControl& run) const;
};

/// Fills a hole, and its images in the other sectors, with material.
struct FillHole {
  static constexpr const char *name = "fill_hole", *meaning = "fills a hole in every sector";
  std::array<double, 2> at{};  ///< a point in the hole: Cartesian, body frame [m]

  CommandFields fields() { return {{"at_m", "a point [x, y] in the hole: Cartesian, body frame", &at}}; }
  CommandResult execute(RunControl& run) const;
};

/// Replaces the shape by that of another run, e.g. of a design of a sweep.
struct TakeShape {
  static constexpr const char *name = "take_shape", *meaning = "replaces the shape by that of another run";
  std::string file;  ///< its level set

  CommandFields fields() { return {{"file", "its level set", &file}}; }
  CommandResult execute(RunControl& run) const;
};

/// Back to the initial shape.
struct Reset {
  static constexpr const char *name = "reset", *meaning = "back to the initial shape";
  CommandResult execute(RunControl& run) const;
};

/// Undoes the last change of case or shape by a command.
struct Undo {
  static constexpr const char *name = "undo",
                              *meaning = "undoes the last change of case or shape by a command";
  CommandResult execute(RunControl& run) const;
};

/// The fields of a load, without its load cases.
CommandFields load_fields(Load& load);

/// The kinds of commands above, with loads that have these own keys. A program adds its own:
/// kinds.push_back(command_kind<ItsCommand>()).
CommandKinds commands_of_every_run(const OwnLoadKeys& own = {});

}  // namespace wheelwright
