#include "wheelwright/output/report/turn_peaks.h"

#include <algorithm>

namespace wheelwright {
namespace {

template <int dim>
DrawnPeak<dim> drawn(const Vec<3>& polar, double value) {
  Vec<dim> place{};
  std::copy_n(polar.begin(), dim, place.begin());
  return {cartesian<dim>(place), value};
}

}  // namespace

template <int dim>
TurnPeaks<dim> turn_peaks(const std::optional<Expected<FatigueResults>>& fatigue,
                          const std::optional<Expected<FatigueDamage>>& damage,
                          const std::optional<Expected<HeatResults>>& heat) {
  TurnPeaks<dim> peaks;
  const auto worst = [](const FatigueResults::Worst& of) { return drawn<dim>(of.place, of.utilization); };
  if (damage && *damage)
    peaks.fatigue = worst((*damage)->worst);
  else if (fatigue && *fatigue)
    peaks.fatigue = worst((*fatigue)->worst);
  if (heat && *heat) peaks.temperature = drawn<dim>((*heat)->peak.place, (*heat)->peak.temperature);
  return peaks;
}

template <int dim>
TurnPeaks<dim> turn_peaks(const DescribedWheel<dim>& wheel) {
  if (!wheel.loaded) return {};
  return turn_peaks<dim>(wheel.loaded->fatigue, wheel.damage, wheel.loaded->heat);
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                      \
  template TurnPeaks<dim> turn_peaks<dim>(const std::optional<Expected<FatigueResults>>&, \
                                          const std::optional<Expected<FatigueDamage>>&,  \
                                          const std::optional<Expected<HeatResults>>&);   \
  template TurnPeaks<dim> turn_peaks<dim>(const DescribedWheel<dim>&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
