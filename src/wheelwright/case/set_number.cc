#include "wheelwright/case/set_number.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <vector>

#include "wheelwright/case/bound_key.h"
#include "wheelwright/case/key_paths.h"
#include "wheelwright/case/key_value.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/number_text.h"
#include "wheelwright/case/unit_text.h"

namespace wheelwright {

namespace {

/// The keys of a table, and its quantity if it has one.
struct BoundTableOfQuantity {
  BoundKeys keys;
  const Quantity* quantity = nullptr;
};

template <class Struct>
BoundTableOfQuantity bound_table(Struct& table, const std::vector<Key<Struct>>& keys) {
  if constexpr (requires { table.quantity; })
    return {bound(keys, table), &table.quantity};
  else
    return {bound(keys, table)};
}

/// One overload per kind of field; returns whether the field accepts the number.
template <class Field>
std::optional<std::string> set_field(const BoundKey& key, const Field& field, double value) {
  if constexpr (
      !requires { field.range; } || requires { field.member.value() = std::array<double, 2>{}; } ||
      requires { field.member.value().push_back({}); }) {
    return fmt::format("{} is not a number", key.name);
  } else {
    if (!field.range.contains(value))
      return fmt::format("{} = {} is out of range: {}{}{}", key.name, number_text(value), field.range.text(),
                         key.unit.empty() ? "" : " ", key.unit);
    if constexpr (requires { field.factor; }) {
      field.member.value() = value * field.factor;
    } else {
      if (value != std::round(value))
        return fmt::format("{} = {} must be a whole number", key.name, number_text(value));
      field.member.value() = static_cast<int>(value);
    }
    return {};
  }
}

/// The value in the unit of the key in a case file; nothing if the given unit does not fit.
std::optional<double> in_unit_of_key(const BoundTableOfQuantity& table, const BoundKey& key,
                                     const ValueWithUnit& given, const Wheel& wheel) {
  if (given.unit.empty()) return given.value;
  if (table.quantity && key.unit == unit_of_quantity)
    return in_file_unit(given, kind(*table.quantity), wheel.dimension, wheel.width);
  return converted(given, key.unit);
}

std::vector<std::string_view> fitting_units(const BoundTableOfQuantity& table, const BoundKey& key) {
  if (table.quantity && key.unit == unit_of_quantity) return units_like(unit<3>(kind(*table.quantity)));
  return units_like(key.unit);
}

/// Nothing if the table has no such key.
std::optional<std::optional<std::string>> set_in_table(const BoundTableOfQuantity& table,
                                                       const std::string& name, const ValueWithUnit& given,
                                                       const Wheel& wheel) {
  const BoundKey* key = find_key(table.keys, name);
  if (!key) return {};
  const auto in_unit = in_unit_of_key(table, *key, given, wheel);
  if (!in_unit)
    return fmt::format("{} is not a unit of {}; units that fit: {}", given.unit, name,
                       fmt::join(fitting_units(table, *key), ", "));
  const double value = *in_unit;
  auto problem = std::visit([&](const auto& field) { return set_field(*key, field, value); }, key->field);
  BoundTable any;
  if (!problem) reset_alternatives(any, table.keys, *key);
  return problem;
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
          outcome = set_in_table(bound_table(list[i], section.keys), name, given, c.wheel);
    } else if (table == section.name && !outcome) {
      outcome = set_in_table(bound_table(section.in(c), section.keys), name, given, c.wheel);
    }
  });
  if (outcome) return *outcome;
  return unknown_key_text(c, path);
}

}  // namespace wheelwright
