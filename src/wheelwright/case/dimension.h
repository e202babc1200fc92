#pragma once

#include <type_traits>
#include <utility>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// Calls the visitor with the dimension in which a case is computed, as std::integral_constant<int, dim>: the
/// one place that decides it.
template <class Visitor>
decltype(auto) in_dimension_of(const Case& c, Visitor&& visitor) {
  if (c.wheel.dimension == 3) return std::forward<Visitor>(visitor)(std::integral_constant<int, 3>{});
  return std::forward<Visitor>(visitor)(std::integral_constant<int, 2>{});
}

}  // namespace wheelwright
