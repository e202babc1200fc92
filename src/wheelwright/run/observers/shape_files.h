#pragma once

#include <vector>

#include "wheelwright/output/report/vtu.h"
#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

// Files of intermediate shapes.

/// Writes shapes/shape_NNNN.vtu with the fields of the most stressed load position, as often as the case
/// says, and shapes.pvd for all of them.
template <int dim>
class ShapeFiles : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  /// Lists the existing files of a resumed run in shapes.pvd, without later ones.
  void list_shapes(const std::filesystem::path& folder, int last_iteration);
  void write(const TrialDone<dim>& done, const RunView<dim>& run);

  std::vector<PvdEntry> shapes_;
};

/// Draws shapes/shape_NNNN_*.svg (wheel_pictures.h), as often as the case says.
template <int dim>
class ShapePictures : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
};

}  // namespace wheelwright
