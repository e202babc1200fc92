#include "wheelwright/case/own_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "wheelwright/case/keys.h"

namespace wheelwright {

namespace {

bool is_in_word(unsigned char c) { return c < 0x80 && (std::isalnum(c) || c == '_'); }

/// Whether [load] or [[load.case]] has a built-in key or table of that name.
bool is_built_in(std::string_view name) {
  return name == load_case_sections().name || find_key(load_section().keys, name) ||
         find_key(load_case_sections().keys, name);
}

}  // namespace

void OwnLoadKeys::add(OwnLoadKey key) {
  if (key.name.empty() || !std::ranges::all_of(key.name, is_in_word))
    throw std::invalid_argument(
        fmt::format("the name of a key is a word of letters, digits and _, not '{}'", key.name));
  const auto has_its_name = [&](const auto& other) { return other->name == key.name; };
  if (is_built_in(key.name) || std::ranges::any_of(keys_, has_its_name))
    throw std::invalid_argument(fmt::format("there is already a key load.{}", key.name));
  keys_.push_back(std::make_shared<const OwnLoadKey>(std::move(key)));
}

std::vector<OwnValue<double>> OwnLoadKeys::usual_values() const {
  std::vector<OwnValue<double>> values;
  for (const auto& key : keys_) values.push_back({key, key->factor * key->usual});
  return values;
}

std::vector<OwnValue<std::optional<double>>> no_changes(const std::vector<OwnValue<double>>& values) {
  std::vector<OwnValue<std::optional<double>>> changes;
  for (const auto& [key, value] : values) changes.push_back({key, {}});
  return changes;
}

bool OwnLoadKeys::operator==(const OwnLoadKeys& other) const {
  return std::ranges::equal(
      keys_, other.keys_, {}, [](const auto& key) -> const auto& { return key->name; },
      [](const auto& key) -> const auto& { return key->name; });
}

}  // namespace wheelwright
