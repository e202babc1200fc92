#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/case/case.h"
#include "wheelwright/run/commands/shape_edit.h"

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
  /// undone. A shape that was replaced by the same shape is not a change. Returns the description of the
  /// change.
  virtual Expected<std::string, Refusal> undo() = 0;
};

}  // namespace wheelwright
