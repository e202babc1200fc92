#pragma once

#include <string>
#include <vector>

namespace wheelwright {

/// A quantity of several wheels, in the unit that its label names.
struct ComparedRow {
  std::string label;
  std::vector<double> values;  ///< one per wheel
};

/// One line per quantity: the value of every wheel and, from the second wheel on, its relative change from
/// the first. A change that is not finite is left out.
std::string comparison_table(const std::vector<std::string>& wheels, const std::vector<ComparedRow>& rows);

}  // namespace wheelwright
