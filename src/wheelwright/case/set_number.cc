#include "wheelwright/case/set_number.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "wheelwright/case/key_value.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/number_text.h"
#include "wheelwright/case/suggest.h"
#include "wheelwright/case/unit_text.h"

namespace wheelwright {

namespace {

/// One overload per kind of field; returns whether the field accepts the number.
template <class Struct, class Field>
std::optional<std::string> set_field(Struct& out, const Key<Struct>& key, const Field& field, double value) {
  if constexpr (
      !requires { field.range; } || requires { field.member.in(out) = std::array<double, 2>{}; } ||
      requires { field.member.in(out).push_back({}); }) {
    return fmt::format("{} is not a number", key.name);
  } else {
    if (!field.range.contains(value))
      return fmt::format("{} = {} is out of range: {}{}{}", key.name, number_text(value), field.range.text(),
                         key.unit.empty() ? "" : " ", key.unit);
    if constexpr (requires { field.factor; }) {
      field.member.in(out) = value * field.factor;
    } else {
      if (value != std::round(value))
        return fmt::format("{} = {} must be a whole number", key.name, number_text(value));
      field.member.in(out) = static_cast<int>(value);
    }
    return {};
  }
}

/// The value in the unit of the key in a case file; nothing if the given unit does not fit.
template <class Struct>
std::optional<double> in_unit_of_key(const Struct& table, const Key<Struct>& key, const ValueWithUnit& given,
                                     const Wheel& wheel) {
  if (given.unit.empty()) return given.value;
  if constexpr (requires { table.quantity; })
    if (key.unit == unit_of_quantity)
      return in_file_unit(given, kind(table.quantity), wheel.dimension, wheel.width);
  return converted(given, key.unit);
}

template <class Struct>
std::vector<std::string_view> fitting_units(const Struct& table, const Key<Struct>& key) {
  if constexpr (requires { table.quantity; })
    if (key.unit == unit_of_quantity) return units_like(unit<3>(kind(table.quantity)));
  return units_like(key.unit);
}

/// Nothing if the table has no such key.
template <class Struct>
std::optional<std::optional<std::string>> set_in_table(Struct& out, const std::vector<Key<Struct>>& keys,
                                                       const std::string& name, const ValueWithUnit& given,
                                                       const Wheel& wheel) {
  const Key<Struct>* key = find_key(keys, name);
  if (!key) return {};
  const auto in_unit = in_unit_of_key(out, *key, given, wheel);
  if (!in_unit)
    return fmt::format("{} is not a unit of {}; units that fit: {}", given.unit, name,
                       fmt::join(fitting_units(out, *key), ", "));
  const double value = *in_unit;
  auto problem =
      std::visit([&](const auto& field) { return set_field(out, *key, field, value); }, key->field);
  if (!problem) reset_alternatives(out, keys, *key);
  return problem;
}

/// All paths of numbers, for suggestions.
std::vector<std::string> known_paths(Case& c) {
  std::vector<std::string> paths;
  for_each_section_of(c, [&](const auto& section) {
    for (const auto& key : section.keys) {
      if constexpr (requires { section.path(); }) {
        for (std::size_t i = 0; i < section.in(c).size(); ++i)
          paths.push_back(fmt::format("{}[{}].{}", section.path(), i + 1, key.name));
      } else if (!section.name.empty()) {
        paths.push_back(fmt::format("{}.{}", section.name, key.name));
      }
    }
  });
  return paths;
}

}  // namespace

std::optional<std::string> set_number(Case& c, const std::string& path, double value,
                                      const std::string& unit) {
  const ValueWithUnit given{value, unit};
  std::optional<std::optional<std::string>> outcome;
  const auto dot = path.rfind('.');
  const std::string table = dot == std::string::npos ? "" : path.substr(0, dot), name = path.substr(dot + 1);
  for_each_section_of(c, [&](const auto& section) {
    if constexpr (requires { section.path(); }) {
      auto& list = section.in(c);
      for (std::size_t i = 0; i < list.size(); ++i)
        if (table == fmt::format("{}[{}]", section.path(), i + 1))
          outcome = set_in_table(list[i], section.keys, name, given, c.wheel);
    } else if (table == section.name && !outcome) {
      outcome = set_in_table(section.in(c), section.keys, name, given, c.wheel);
    }
  });
  if (outcome) return *outcome;
  const auto paths = known_paths(c);
  const auto near = did_you_mean(path, std::vector<std::string_view>(paths.begin(), paths.end()));
  return fmt::format("{} is not a key of this case{}", path,
                     near ? fmt::format("; did you mean {}?", *near) : "");
}

}  // namespace wheelwright
