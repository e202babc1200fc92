#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wheelwright {

/// The shortest decimal number that reads back to the same double, whatever the locale; empty for NaN.
std::string csv_number(double value);

/// Cells joined by commas, with a newline at the end; cells with commas, quotes or newlines are quoted (RFC
/// 4180).
std::string csv_line(const std::vector<std::string>& cells);

/// The cells of a line without its newline; the inverse of csv_line() for cells without newlines.
std::vector<std::string> csv_cells(std::string_view line);

}  // namespace wheelwright
