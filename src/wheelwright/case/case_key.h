#pragma once

#include <concepts>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "wheelwright/case/keys.h"

namespace wheelwright {

/// A table of a case or one of its keys, as messages name it.
struct CaseKey {
  std::string table;  ///< e.g. "load" or "holes.ring[2]"; empty: the top of the file
  /// All names for the same member, such as `force` and `mass`, first the one that a resolved case has;
  /// empty: the table itself.
  std::vector<std::string_view> names = {};

  /// E.g. "load.force"; of the first name.
  std::string path() const;
  /// The same for each name.
  std::vector<std::string> paths() const;
  bool operator==(const CaseKey&) const = default;
};

using CaseKeys = std::vector<CaseKey>;

/// The names of the keys that set the value at this place of a table, the last declared one first.
template <class Struct>
std::vector<std::string_view> names_of(const std::vector<Key<Struct>>& keys, const Struct& table,
                                       const void* value) {
  std::vector<std::string_view> names;
  for (const Key<Struct>& key : keys)
    if (place(key, table) == value) names.insert(names.begin(), key.name);
  if (names.empty()) throw std::logic_error("a member without a key");
  return names;
}

/// The same of a member of the table's type or of its base.
template <class Struct, class Base, class Value>
std::vector<std::string_view> names_of(const std::vector<Key<Struct>>& keys, Value Base::*member) {
  const Struct sample{};
  return names_of(keys, sample, &(sample.*member));
}

/// The key of a table `[name]` that sets this member, e.g. key_of(&Wheel::sectors).
template <class Struct, class Value>
CaseKey key_of(Value Struct::*member) {
  const auto& section = section_of<Struct>();
  return {std::string(section.name), names_of(section.keys, member)};
}

/// Table i, counted from 0, of an array: "holes.ring[1]" for 0.
template <class Struct>
CaseKey table_of(std::size_t i) {
  return {section_of<Struct>().path() + "[" + std::to_string(i + 1) + "]"};
}

/// The key of table i, counted from 0, of an array that sets this member, e.g. key_of(&HoleRing::radius, 0).
template <class Struct, class Value>
CaseKey key_of(Value Struct::*member, std::size_t i) {
  return {table_of<Struct>(i).table, names_of(section_of<Struct>().keys, member)};
}

/// One list after the other.
CaseKeys joined(std::initializer_list<CaseKeys> lists);

}  // namespace wheelwright
