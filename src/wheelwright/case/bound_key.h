#pragma once

#include <functional>
#include <string_view>
#include <variant>
#include <vector>

#include "wheelwright/case/keys.h"

namespace wheelwright {

// The keys of one table of a case with the places of their values. What reads, writes and sets keys sees only
// these: it is compiled once, not for every kind of table.

/// In place of a table's type. Bound keys know where the values are.
struct BoundTable {};

template <class Value>
class Place<BoundTable, Value> {
 public:
  explicit constexpr Place(Value& value) : value_(&value) {}

  Value& value() const { return *value_; }
  const Value& in(const BoundTable&) const { return *value_; }
  Value& in(BoundTable&) const { return *value_; }

 private:
  Value* value_;
};

template <>
struct ChoiceField<BoundTable> {
  std::vector<std::string_view> words;
  std::function<int(const BoundTable&)> get;
  std::function<void(BoundTable&, int)> set;
  std::function<const void*(const BoundTable&)> place;
};

using BoundKey = Key<BoundTable>;
using BoundKeys = std::vector<BoundKey>;

/// The keys and the table must outlive the result. Keys of the unit unit_of_quantity accept the values_of()
/// the quantity that the table has now.
template <class Struct>
BoundKeys bound(const std::vector<Key<Struct>>& keys, Struct& table);

/// Of a table that is only read: nobody may set a key of the result.
template <class Struct>
BoundKeys bound(const std::vector<Key<Struct>>& keys, const Struct& table) {
  return bound(keys, const_cast<Struct&>(table));
}

}  // namespace wheelwright
