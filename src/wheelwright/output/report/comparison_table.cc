#include "wheelwright/output/report/comparison_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheelwright/output/report/value_with_error.h"
#include "wheelwright/output/report/within_errors.h"

namespace wheelwright {
namespace {

constexpr std::size_t value_width = 12, change_width = 12;

using Value = std::optional<KnownNumber>;

bool is_known(const Value& value) { return value && *value; }
bool is_missing(const Value& value) { return value && !*value; }

/// Empty if the first value is negligible compared with the other.
std::string change(const ComparedRow& row, std::size_t wheel) {
  constexpr double max_percents = 1e5;
  if (!is_known(row.values[0]) || !is_known(row.values[wheel])) return "";
  const double first = **row.values[0], value = **row.values[wheel];
  // The zero of its unit is arbitrary.
  if (row.kind == UnitKind::temperature) return fmt::format("{:+.2f} K", value - first);
  const double percents = 100 * (value / first - 1);
  if (!(std::abs(percents) < max_percents)) return "";
  if (std::abs(percents) < 0.005) return "0 %";
  return fmt::format("{:+.2f} %", percents);
}

std::string without_leading_spaces(const std::string& text) {
  return text.substr(text.find_first_not_of(' '));
}

std::string shortened(const std::string& name, std::size_t width) {
  return name.size() < width ? name : name.substr(0, width - 3) + "..";
}

std::optional<double> error_of(const ComparedRow& row, std::size_t wheel) {
  return wheel < row.errors.size() ? row.errors[wheel] : std::nullopt;
}

constexpr const char* within_errors = " ~";

/// Whether the difference to the first value is smaller than the errors that are known of the two.
bool is_within_errors(const ComparedRow& row, std::size_t wheel) {
  if (!is_known(row.values[0]) || !is_known(row.values[wheel])) return false;
  return differ_within_errors({**row.values[0], error_of(row, 0).value_or(0)},
                              {**row.values[wheel], error_of(row, wheel).value_or(0)});
}

std::string text(const UndecidedNumbers& undecided, const std::vector<std::string>& wheels,
                 const std::vector<ComparedRow>& rows) {
  std::vector<std::string> names;
  for (const std::size_t wheel : undecided.wheels) names.push_back(wheels[wheel]);
  std::string text = listed(names) + " differ by less than their errors in";
  for (const std::size_t row : undecided.rows)
    text += (row == undecided.rows.front() ? " " : ", ") + without_leading_spaces(rows[row].label);
  return text;
}

/// Whether a value without an error is that of rounding, by the errors of the others in its row: for example
/// a harmonic that symmetry forbids.
bool is_rounding(const ComparedRow& row, std::size_t wheel) {
  constexpr double share = 1e-6;
  double largest = 0;
  for (const auto& error : row.errors) largest = std::max(largest, error.value_or(0));
  return !error_of(row, wheel) && std::abs(**row.values[wheel]) < share * largest;
}

std::string value_text(const ComparedRow& row, std::size_t wheel) {
  if (!is_known(row.values[wheel])) return "-";
  if (is_rounding(row, wheel)) return "0";
  return text_with_error(**row.values[wheel], error_of(row, wheel).value_or(0), row.kind);
}

/// The numbers that are missing of some wheels for one reason.
struct MissingNumbers {
  std::string wheels, reason;
  std::vector<std::string> labels;
};

std::vector<MissingNumbers> missing_numbers(const std::vector<std::string>& wheels,
                                            const std::vector<ComparedRow>& rows) {
  std::vector<MissingNumbers> result;
  for (const ComparedRow& row : rows) {
    std::vector<std::pair<std::string, std::string>> of_reason;  // the reason, the wheels
    for (std::size_t k = 0; k < row.values.size(); ++k) {
      if (!is_missing(row.values[k])) continue;
      const std::string& reason = row.values[k]->failure();
      if (const auto known =
              std::ranges::find(of_reason, reason, &std::pair<std::string, std::string>::first);
          known != of_reason.end())
        known->second += ", " + wheels[k];
      else
        of_reason.emplace_back(reason, wheels[k]);
    }
    for (const auto& [reason, names] : of_reason) {
      const auto same =
          std::ranges::find_if(result, [&reason = reason, &names = names](const MissingNumbers& one) {
            return one.reason == reason && one.wheels == names;
          });
      MissingNumbers& group =
          same != result.end() ? *same : result.emplace_back(MissingNumbers{names, reason, {}});
      group.labels.push_back(without_leading_spaces(row.label));
    }
  }
  return result;
}

std::string text(const MissingNumbers& missing) {
  constexpr std::size_t max_named = 4;
  const auto& labels = missing.labels;
  std::string names;
  for (std::size_t k = 0; k < std::min(labels.size(), max_named); ++k)
    names += (k > 0 ? ", " : "") + labels[k];
  if (labels.size() > max_named) names += fmt::format(" and {} more", labels.size() - max_named);
  return fmt::format("not computed ({}): {}: {}", missing.wheels, names, missing.reason);
}

/// Null wheels have no values.
template <int dim>
void add_row(const WheelNumber<dim>& number, const std::string& in_case,
             const std::vector<const DescribedWheel<dim>*>& wheels, std::vector<ComparedRow>& rows) {
  const double factor = number.shown().factor;
  ComparedRow row{.label = fmt::format("{}{} [{}]", number.label, in_case, number.shown().name),
                  .values = {},
                  .key = number.key + in_case,
                  .kind = number.kind};
  for (const DescribedWheel<dim>* wheel : wheels) {
    const auto value = wheel ? number.value(*wheel) : std::nullopt;
    row.values.push_back(is_known(value) ? Value(**value * factor) : value);
    const auto error = wheel ? error_of(number, *wheel) : std::nullopt;
    row.errors.push_back(is_known(error) ? std::optional(**error * factor) : std::nullopt);
  }
  if (std::ranges::any_of(row.values, [](const auto& value) { return value.has_value(); }))
    rows.push_back(std::move(row));
}

/// The names of the wheels' other load cases, in the order in which they first come.
template <int dim>
std::vector<std::string> other_load_cases(const std::vector<const DescribedWheel<dim>*>& wheels) {
  std::vector<std::string> names;
  for (const DescribedWheel<dim>* wheel : wheels)
    for (const DescribedWheel<dim>& other : wheel->others)
      if (std::ranges::find(names, other.load_case) == names.end()) names.push_back(other.load_case);
  return names;
}

}  // namespace

template <int dim>
std::vector<ComparedRow> compared_rows(const std::vector<const DescribedWheel<dim>*>& wheels) {
  std::vector<ComparedRow> rows;
  const auto numbers = numbers_of(*wheels.front());
  for (const WheelNumber<dim>& number : numbers) add_row(number, "", wheels, rows);
  for (const std::string& load_case : other_load_cases(wheels)) {
    std::vector<const DescribedWheel<dim>*> others;
    for (const DescribedWheel<dim>* wheel : wheels) others.push_back(under_load_case(*wheel, load_case));
    for (const WheelNumber<dim>& number : numbers)
      if (!number.is_of_shape) add_row(number, " in " + load_case, others, rows);
  }
  return rows;
}

template decltype(compared_rows<2>) compared_rows<2>;
template decltype(compared_rows<3>) compared_rows<3>;

std::vector<UndecidedNumbers> undecided_numbers(const std::vector<ComparedRow>& rows) {
  std::vector<UndecidedNumbers> result;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::vector<EstimatedValue> estimated;
    std::vector<std::size_t> wheels;
    for (std::size_t wheel = 0; wheel < rows[k].values.size(); ++wheel)
      if (const auto error = error_of(rows[k], wheel); error && is_known(rows[k].values[wheel])) {
        estimated.push_back({**rows[k].values[wheel], *error});
        wheels.push_back(wheel);
      }
    for (std::vector<std::size_t> group : groups_within_errors(estimated)) {
      for (std::size_t& member : group) member = wheels[member];
      std::ranges::sort(group);
      const auto same = std::ranges::find(result, group, &UndecidedNumbers::wheels);
      (same != result.end() ? *same : result.emplace_back(UndecidedNumbers{group, {}})).rows.push_back(k);
    }
  }
  return result;
}

std::vector<std::string> missing_lines(const std::vector<std::string>& wheels,
                                       const std::vector<ComparedRow>& rows) {
  std::vector<std::string> lines;
  for (const MissingNumbers& missing : missing_numbers(wheels, rows)) lines.push_back(text(missing));
  return lines;
}

std::string comparison_table(const std::vector<std::string>& wheels, const std::vector<ComparedRow>& rows) {
  std::size_t label_width = 0;
  std::vector<std::size_t> widths(wheels.size(), value_width);
  for (const ComparedRow& row : rows) {
    label_width = std::max(label_width, row.label.size());
    for (std::size_t k = 0; k < wheels.size(); ++k)
      widths[k] = std::max(widths[k], value_text(row, k).size() + 2);
  }
  const auto cells = [&](std::size_t k, const std::string& value, const std::string& relative) {
    std::string text = fmt::format("{:>{}}", value, widths[k]);
    return k > 0 ? text + fmt::format("{:>{}}", relative, change_width) : text;
  };
  std::string table(label_width, ' ');
  for (std::size_t k = 0; k < wheels.size(); ++k)
    table += cells(k, shortened(wheels[k], widths[k]), "change");
  table += '\n';
  bool has_small_change = false;
  for (const ComparedRow& row : rows) {
    if (std::ranges::none_of(row.values, is_known)) continue;
    table += fmt::format("{:<{}}", row.label, label_width);
    for (std::size_t k = 0; k < row.values.size(); ++k) {
      const bool is_small = k > 0 && is_within_errors(row, k);
      has_small_change = has_small_change || is_small;
      table += cells(k, value_text(row, k), change(row, k) + (is_small ? within_errors : ""));
    }
    table += '\n';
  }
  if (has_small_change) table += "~ the change is smaller than the discretization errors\n";
  for (const UndecidedNumbers& undecided : undecided_numbers(rows))
    table += text(undecided, wheels, rows) + '\n';
  for (const std::string& line : missing_lines(wheels, rows)) table += line + '\n';
  return table;
}

}  // namespace wheelwright
