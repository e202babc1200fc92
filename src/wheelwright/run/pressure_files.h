#pragma once

#include <string>

#include "wheelwright/run/observer.h"

namespace wheelwright {

/// Writes pressures_initial.csv and pressures_final.csv with their plots: the contact of all load positions.
/// In 2D: the files hold one coordinate along the ground.
class PressureFiles : public Observer<2> {
 public:
  void operator()(const Event<2>& event, const RunView<2>& run) override;
};

}  // namespace wheelwright
