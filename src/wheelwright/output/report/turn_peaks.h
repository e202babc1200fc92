#pragma once

#include <optional>

#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/output/report/solution_fields.h"

namespace wheelwright {

/// Where the ring fares worst in a turn, as tables tell it: the largest values at the quadrature points, in
/// sector 0. Nothing that is not known.
template <int dim>
struct TurnPeaks {
  std::optional<DrawnPeak<dim>> fatigue;      ///< of the utilization; under all load cases if that is known
  std::optional<DrawnPeak<dim>> temperature;  ///< [deg C]
};

template <int dim>
TurnPeaks<dim> turn_peaks(const std::optional<Expected<FatigueResults>>& fatigue,
                          const std::optional<Expected<FatigueDamage>>& damage,
                          const std::optional<Expected<HeatResults>>& heat);

/// Of a wheel under its load case.
template <int dim>
TurnPeaks<dim> turn_peaks(const DescribedWheel<dim>& wheel);

}  // namespace wheelwright
