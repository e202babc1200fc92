#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/case/single_load.h"

namespace wheelwright {

/// A key without which a quantity has no meaning.
struct Need {
  CaseKey key;
  const char* problem;
};

/// Those that the case does not meet under this load.
std::vector<Need> unmet_needs(const SingleLoad& single, const Quantity& quantity);

/// The unmet needs that no load changes: constants of the materials and of the cooling.
std::vector<Need> unmet_needs_of_materials(const Case& c, const Quantity& quantity);

/// Why a quantity is the same for every wheel, so that it can neither be minimized nor be bounded.
struct Constancy {
  CaseKey key;
  std::string problem, remedy;
};

/// Nothing if the quantity differs between wheels under this load.
std::optional<Constancy> constancy(const SingleLoad& single, const Quantity& quantity);

}  // namespace wheelwright
