#pragma once

#include "wheelwright/run/observer.h"

namespace wheelwright {

/// Writes the result of a run that ended by itself: shape.svg for cutting, comparison.svg and the pictures of
/// wheel_pictures.h to look at, and rolling.pvd with the fields of every load position. In 2D: pictures and
/// VTU files are plane.
class ResultFiles : public Observer<2> {
 public:
  void operator()(const Event<2>& event, const RunView<2>& run) override;
};

}  // namespace wheelwright
