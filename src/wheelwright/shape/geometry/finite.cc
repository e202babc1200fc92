#include "wheelwright/shape/geometry/finite.h"

#include <fmt/format.h>

#include "wheelwright/shape/geometry/place.h"

namespace wheelwright {

template <int dim>
std::optional<Failure> check_finite(const Lattice<dim>& lattice, std::span<const double> values,
                                    std::string_view what) {
  const auto first =
      std::find_if_not(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if (first == values.end()) return {};
  const auto place = lattice.polar_point(static_cast<int>(first - values.begin()));
  return Failure{FailureReason::not_finite,
                 fmt::format("{} is {} at {}", what, *first, place_text<dim>(place))};
}

template decltype(check_finite<2>) check_finite<2>;
template decltype(check_finite<3>) check_finite<3>;

}  // namespace wheelwright
