#pragma once

#include <vector>

#include "wheelwright/report/vtu.h"
#include "wheelwright/run/observer.h"

namespace wheelwright {

// Files of the shapes along the way. In 2D: the formats hold plane fields and pictures.

/// Writes shapes/shape_NNNN.vtu with the fields of the worst load position, as often as the case asks, and
/// shapes.pvd over all of them.
class ShapeFiles : public Observer<2> {
 public:
  void operator()(const Event<2>& event, const RunView<2>& run) override;

 private:
  /// Of a run that is resumed: the files that exist already. Later ones are dropped from shapes.pvd.
  void list_shapes(const std::filesystem::path& folder, int last_iteration);
  void write(const TrialDone<2>& done, const RunView<2>& run);

  std::vector<PvdEntry> shapes_;
};

/// Draws shapes/shape_NNNN_*.svg (wheel_pictures.h), as often as the case asks.
class ShapePictures : public Observer<2> {
 public:
  void operator()(const Event<2>& event, const RunView<2>& run) override;
};

}  // namespace wheelwright
