#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheelwright/output/report/described_wheel.h"

namespace wheelwright {

/// A quantity of several wheels, in the unit named by its label.
struct ComparedRow {
  std::string label;
  std::vector<std::optional<KnownNumber>> values;  ///< one per wheel; nothing if it has none
  /// Estimates of the errors of known values; nothing where there is none. Empty: of no wheel.
  std::vector<std::optional<double>> errors = {};
  std::string key = {};  ///< for programs
  UnitKind kind = UnitKind::energy;
};

/// Numbers in which some wheels differ by less than their errors, if those of all of them are known.
struct UndecidedNumbers {
  std::vector<std::size_t> wheels;  ///< two or more, by index
  std::vector<std::size_t> rows;    ///< by index
};

/// Each group of wheels once.
std::vector<UndecidedNumbers> undecided_numbers(const std::vector<ComparedRow>& rows);

/// The numbers (numbers_of the first one) that at least one of the wheels has or should have; then, for every
/// other load case, those that depend on the load.
template <int dim>
std::vector<ComparedRow> compared_rows(const std::vector<const DescribedWheel<dim>*>& wheels);

/// The numbers that could not be computed, with wheels and reason; one line per reason.
std::vector<std::string> missing_lines(const std::vector<std::string>& wheels,
                                       const std::vector<ComparedRow>& rows);

/// One line per quantity: the value of every wheel, with its error if that is known, and, from the second
/// wheel on, its relative change from the first. A change that is not finite is omitted; one that the errors
/// of the two values may explain is marked, and a line tells so. Followed by a line for each of the
/// undecided_numbers, and the missing_lines.
std::string comparison_table(const std::vector<std::string>& wheels, const std::vector<ComparedRow>& rows);

}  // namespace wheelwright
