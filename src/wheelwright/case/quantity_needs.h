#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// A key required by a quantity.
struct Need {
  std::vector<Quantity> quantities;
  const char* key;
  bool is_given;
  const char* problem;
};

/// Those that the case does not meet.
std::vector<Need> unmet_needs(const Case& c, Quantity quantity);

/// Why a quantity is the same for every wheel, so that it can neither be minimized nor be bounded.
struct Constancy {
  std::string key, problem, remedy;
};

/// Nothing if the quantity differs between wheels.
std::optional<Constancy> constancy(const Case& c, Quantity quantity);

/// The remedy for quantities without a derivative; empty for the others.
std::string_view without_derivative(Quantity quantity);

}  // namespace wheelwright
