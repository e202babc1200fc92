#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/case.h"

namespace wheelwright {

/// A key without which a quantity has no meaning.
struct Need {
  const char* key;
  const char* problem;
};

/// Those that the case does not meet.
std::vector<Need> unmet_needs(const Case& c, const Quantity& quantity);

/// Why a quantity is the same for every wheel, so that it can neither be minimized nor be bounded.
struct Constancy {
  std::string key, problem, remedy;
};

/// Nothing if the quantity differs between wheels.
std::optional<Constancy> constancy(const Case& c, const Quantity& quantity);

}  // namespace wheelwright
