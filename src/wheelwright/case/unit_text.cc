#include "wheelwright/case/unit_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace wheelwright {

namespace {

/// A unit as a fraction of the first of its kind: two whole numbers give decimals without rounding errors.
struct Unit {
  std::string_view name;
  double numerator = 1, denominator = 1;
};

using UnitsOfKind = std::vector<Unit>;

const std::vector<UnitsOfKind>& known_units() {
  static const std::vector<UnitsOfKind> kinds{
      {{"m"}, {"cm", 1, 100}, {"mm", 1, 1000}, {"in", 254, 10000}},
      {{"Pa"}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}, {"N/mm^2", 1e6}},
      {{"N"}, {"kN", 1e3}},
      {{"kg"}, {"g", 1, 1000}},
      {{"N m"}, {"N mm", 1, 1000}, {"kN m", 1e3}},
      {{"m/s"}, {"km/h", 10, 36}},
      {{"kg/m^3"}, {"g/cm^3", 1000}},
      {{"N/m^3"}, {"N/mm^3", 1e9}},
      {{"deg"}, {"rad", 180, std::numbers::pi}},
      {{"s"}, {"min", 60}, {"h", 3600}},
      {{"J"}, {"kJ", 1e3}, {"mJ", 1, 1000}},
      {{"N/m"}, {"N/mm", 1e3}, {"kN/mm", 1e6}, {"kN/m", 1e3}},
      {{"N m/rad"}, {"N m/deg", 180, std::numbers::pi}},
      {{"J/m"}},
      {{"kg/m"}},
      {{"N/m^2"}},
      {{"N/rad"}},
      {{"m^2"}},
      {{"m^3"}, {"mm^3", 1, 1e9}},
      {{"deg C"}, {"\u00b0C"}},
      {{"W/(m K)"}},
      {{"W/(m^2 K)"}},
      {{"turns below a cell"}},
      {{"-"}, {"%", 1, 100}}};
  return kinds;
}

/// E.g. "kg/m3" for "kg/m^3".
std::string without_carets(std::string_view name) {
  std::string result(name);
  std::erase(result, '^');
  return result;
}

const Unit* find(const UnitsOfKind& kind, std::string_view name) {
  const auto found = std::ranges::find_if(
      kind, [&](const Unit& unit) { return without_carets(unit.name) == without_carets(name); });
  return found == kind.end() ? nullptr : &*found;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<ValueWithUnit> value_with_unit(std::string_view text) {
  text = trimmed(text);
  ValueWithUnit result{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result.value);
  if (error != std::errc() || !std::isfinite(result.value)) return {};
  result.unit = trimmed(text.substr(end - text.data()));
  if (result.unit.empty()) return {};
  return result;
}

std::optional<double> converted(const ValueWithUnit& value, std::string_view unit) {
  for (const UnitsOfKind& kind : known_units()) {
    const Unit *from = find(kind, value.unit), *to = find(kind, unit);
    if (from && to)
      return value.value * (from->numerator * to->denominator) / (from->denominator * to->numerator);
  }
  return {};
}

std::optional<double> in_file_unit(const ValueWithUnit& value, UnitKind kind, int dimension, double width) {
  if (const auto whole = converted(value, unit<3>(kind)))
    return *whole / (is_per_width(kind) ? whole_width(dimension, width) : 1);
  return converted(value, unit(kind, dimension));
}

std::vector<std::string_view> units_like(std::string_view unit) {
  std::vector<std::string_view> names;
  for (const UnitsOfKind& kind : known_units())
    if (find(kind, unit))
      for (const Unit& known : kind) names.push_back(known.name);
  return names;
}

}  // namespace wheelwright
