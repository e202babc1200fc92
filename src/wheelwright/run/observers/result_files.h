#pragma once

#include <optional>

#include "wheelwright/run/observers/observer.h"
#include "wheelwright/run/results/rolling_files.h"

namespace wheelwright {

/// Writes the result of a run that ended by itself: the shape for the workshop (in 2D shape.svg for cutting,
/// in 3D the closed surface shape.stl), comparison.svg and the pictures of wheel_pictures.h, and rolling.pvd
/// with the fields of every load position unless output.vtu_every is 0; in 3D also surface.vtp, the surface
/// with the fields of the most stressed position.
template <int dim>
class ResultFiles : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;

 private:
  void write(const PositionShown<dim>& shown, const RunView<dim>& run);

  std::optional<RollingFiles<dim>> rolling_;  ///< while the positions are being received
};

}  // namespace wheelwright
