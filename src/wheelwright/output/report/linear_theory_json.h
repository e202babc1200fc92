#pragma once

#include <nlohmann/json.hpp>

#include "wheelwright/quantities/analysis/linear_theory_error.h"

namespace wheelwright {

/// The three parts of what linear theory neglects, as relative changes of the stiffness.
inline nlohmann::ordered_json to_json(const LinearTheoryError& error) {
  return {
      {"of_rotation", error.of_rotation}, {"of_strain", error.of_strain}, {"of_bending", error.of_bending}};
}

}  // namespace wheelwright
