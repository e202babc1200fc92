#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "wheelwright/case/keys.h"

namespace wheelwright {

// The numbers, points and words of a struct by their keys: what copies, compares or sends all of them visits
// the declarations.

/// In SI units and radians, as the member has it.
using KeyValue =
    std::variant<int, double, std::array<double, 2>, std::vector<std::array<double, 2>>, std::string>;

/// The member of a key, if it is a number, a point, points or a word, passed to visit(); it may be optional.
template <class Struct, class SomeStruct, class Visitor>
void visit_value(const Key<Struct>& key, SomeStruct& s, Visitor&& visit) {
  std::visit(
      [&]<class Field>(const Field& field) {
        if constexpr (std::is_same_v<Field, NumberField<Struct>> ||
                      std::is_same_v<Field, OptionalNumberField<Struct>> ||
                      std::is_same_v<Field, IntegerField<Struct>> ||
                      std::is_same_v<Field, OptionalIntegerField<Struct>> ||
                      std::is_same_v<Field, PointField<Struct>> ||
                      std::is_same_v<Field, OptionalPointField<Struct>> ||
                      std::is_same_v<Field, PointsField<Struct>> ||
                      std::is_same_v<Field, WordField<Struct>> ||
                      std::is_same_v<Field, OptionalWordField<Struct>>)
          visit(field.member.in(s));
      },
      key.field);
}

template <class Value>
std::optional<KeyValue> key_value(const Value& value) {
  return KeyValue(value);
}
template <class Value>
std::optional<KeyValue> key_value(const std::optional<Value>& value) {
  return value ? std::optional(KeyValue(*value)) : std::nullopt;
}

/// No points are no value.
inline std::optional<KeyValue> key_value(const std::vector<std::array<double, 2>>& points) {
  return points.empty() ? std::nullopt : std::optional(KeyValue(points));
}

/// The value of a key; nothing if it is absent, or of another kind.
template <class Struct>
std::optional<KeyValue> value(const Key<Struct>& key, const Struct& s) {
  std::optional<KeyValue> result;
  visit_value(key, s, [&](const auto& member) { result = key_value(member); });
  return result;
}

template <class Value>
void assign(Value& member, const std::optional<KeyValue>& value) {
  if (value) member = std::get<Value>(*value);
}
template <class Value>
void assign(std::optional<Value>& member, const std::optional<KeyValue>& value) {
  member = value ? std::optional(std::get<Value>(*value)) : std::nullopt;
}

inline void assign(std::vector<std::array<double, 2>>& member, const std::optional<KeyValue>& value) {
  member =
      value ? std::get<std::vector<std::array<double, 2>>>(*value) : std::vector<std::array<double, 2>>{};
}

/// Sets the member of a key to a value of its type. An absent value changes optional members and points only.
template <class Struct>
void set_value(const Key<Struct>& key, Struct& s, const std::optional<KeyValue>& value) {
  visit_value(key, s, [&](auto& member) { assign(member, value); });
}

/// Resets the optional keys that another one replaces.
template <class Struct>
void reset_alternatives(Struct& s, const std::vector<Key<Struct>>& keys, const Key<Struct>& given) {
  for (const Key<Struct>& key : keys) {
    if (place(key, s) == place(given, s) || !are_alternatives(key, given)) continue;
    if (const auto* field = std::get_if<OptionalNumberField<Struct>>(&key.field)) field->member.in(s).reset();
  }
}

/// Whether a later alternative of the key has a value, and so is in force.
template <class Struct>
bool is_superseded(const std::vector<Key<Struct>>& keys, const Key<Struct>& key, const Struct& s) {
  auto later = std::ranges::find(keys, key.name, &Key<Struct>::name);
  if (later != keys.end()) ++later;
  return std::any_of(later, keys.end(), [&](const Key<Struct>& other) {
    return are_alternatives(other, key) && value(other, s);
  });
}

}  // namespace wheelwright
