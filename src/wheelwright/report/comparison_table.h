#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/report/described_wheel.h"

namespace wheelwright {

/// A quantity of several wheels, in the unit that its label names.
struct ComparedRow {
  std::string label;
  std::vector<std::optional<KnownNumber>> values;  ///< one per wheel; nothing where it has none
};

/// The numbers of wheels (wheel_numbers) that at least one of them has or should have; then those that depend
/// on the load under every other load case.
template <int dim>
std::vector<ComparedRow> compared_rows(const std::vector<const DescribedWheel<dim>*>& wheels);

/// The numbers that could not be computed: of which wheels, which ones, and why; one line per reason.
std::vector<std::string> missing_lines(const std::vector<std::string>& wheels,
                                       const std::vector<ComparedRow>& rows);

/// One line per quantity: the value of every wheel and, from the second wheel on, its relative change from
/// the first. A change that is not finite is left out. The missing_lines are below.
std::string comparison_table(const std::vector<std::string>& wheels, const std::vector<ComparedRow>& rows);

}  // namespace wheelwright
