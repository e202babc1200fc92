#include "wheelwright/quantities/functionals/peak_pressure.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {

template <int dim>
FunctionalValue<dim> PeakPressure<dim>::evaluate(const StateSolver<dim>&, const LevelSet<dim>&,
                                                 const State<dim>& state, const Matrix&) const {
  FunctionalValue<dim> value;
  for (const ContactPatch<dim>& contact : state.contacts()) {
    double peak = 0, integral = 0;
    for (const auto& point : contact.points) peak = std::max(peak, -point.traction[0]);
    for (const auto& point : contact.points)
      integral += point.weight * std::pow(std::max(-point.traction[0], 0.0) / peak, norm_.exponent);
    const auto [correction, norm] = norm_.value(peak, integral, peak);
    std::vector<Vec<dim>> by_traction;
    for (const auto& point : contact.points) {
      const double share = std::max(-point.traction[0], 0.0) / peak;
      by_traction.push_back(
          {-correction * norm / (peak * integral) * point.weight * std::pow(share, norm_.exponent - 1)});
    }
    value.by_position.push_back(correction * norm);
    value.derivative.tractions.push_back(std::move(by_traction));
  }
  return value;
}

template class PeakPressure<2>;
template class PeakPressure<3>;

}  // namespace wheelwright
