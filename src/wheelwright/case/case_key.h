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

/// The names of the keys that set a member of a struct or of its base, the last declared one first.
template <class Struct, class Base, class Value>
std::vector<std::string_view> names_of(const std::vector<Key<Struct>>& keys, Value Base::*member) {
  const Struct sample{};
  std::vector<std::string_view> names;
  for (const Key<Struct>& key : keys)
    if (place(key, sample) == &(sample.*member)) names.insert(names.begin(), key.name);
  if (names.empty()) throw std::logic_error("a member without a key");
  return names;
}

template <class SomeSection>
struct StructOf;
template <class Struct>
struct StructOf<Section<Struct>> {
  using type = Struct;
};
template <class Struct>
struct StructOf<SectionArray<Struct>> {
  using type = Struct;
};

/// Calls visit(section) for the section of the case file that sets the members of Struct, or of a struct
/// derived from it.
template <class Struct, class Visitor>
void for_section_of(Visitor&& visit) {
  for_each_section([&](const auto& section) {
    using Of = typename StructOf<std::decay_t<decltype(section)>>::type;
    if constexpr (std::derived_from<Of, Struct>) visit(section);
  });
}

/// The key of a table `[name]` that sets this member, e.g. key_of(&Wheel::sectors).
template <class Struct, class Value>
CaseKey key_of(Value Struct::*member) {
  CaseKey key;
  for_section_of<Struct>([&](const auto& section) {
    key = {std::string(section.name), names_of(section.keys, member)};
  });
  return key;
}

/// Table i, counted from 0, of an array: "holes.ring[1]" for 0.
template <class Struct>
CaseKey table_of(std::size_t i) {
  CaseKey key;
  for_section_of<Struct>(
      [&](const auto& section) { key.table = section.path() + "[" + std::to_string(i + 1) + "]"; });
  return key;
}

/// The key of table i, counted from 0, of an array that sets this member, e.g. key_of(&HoleRing::radius, 0).
template <class Struct, class Value>
CaseKey key_of(Value Struct::*member, std::size_t i) {
  CaseKey key = table_of<Struct>(i);
  for_section_of<Struct>([&](const auto& section) { key.names = names_of(section.keys, member); });
  return key;
}

/// One list after the other.
CaseKeys joined(std::initializer_list<CaseKeys> lists);

}  // namespace wheelwright
