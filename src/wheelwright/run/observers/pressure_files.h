#pragma once

#include <string>

#include "wheelwright/run/observers/observer.h"

namespace wheelwright {

/// Writes pressures_initial.csv and pressures_final.csv: the contact of all load positions; in 2D with their
/// plots over the ground.
template <int dim>
class PressureFiles : public Observer<dim> {
 public:
  void operator()(const Event<dim>& event, const RunView<dim>& run) override;
};

}  // namespace wheelwright
