#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/report/described_wheel.h"

namespace wheelwright {

/// A quantity of several wheels, in the unit that its label names.
struct ComparedRow {
  std::string label;
  std::vector<std::optional<double>> values;  ///< one per wheel; nothing where it has none
};

/// The numbers of wheels (wheel_numbers) that at least one of them has; then those that depend on the load
/// under every other load case.
template <int dim>
std::vector<ComparedRow> compared_rows(const std::vector<const DescribedWheel<dim>*>& wheels);

/// One line per quantity: the value of every wheel and, from the second wheel on, its relative change from
/// the first. A change that is not finite is left out.
std::string comparison_table(const std::vector<std::string>& wheels, const std::vector<ComparedRow>& rows);

}  // namespace wheelwright
