#include "wheelwright/case/key_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "wheelwright/case/bound_key.h"
#include "wheelwright/case/key_paths.h"
#include "wheelwright/case/toml_lines.h"
#include "wheelwright/case/write.h"

namespace wheelwright {
namespace {

/// A path as tables and a key: "holes.ring[2].radius" as {holes, ring [1]} and radius, counted from 0.
struct TablePlace {
  std::string name;
  std::optional<std::size_t> index;
};
struct KeyPlace {
  std::vector<TablePlace> tables;
  std::string key;
};

std::optional<TablePlace> table_place(const std::string& part) {
  const std::size_t bracket = part.find('[');
  if (bracket == std::string::npos) return TablePlace{part, {}};
  std::size_t end = 0;
  int number = 0;
  try {
    number = std::stoi(part.substr(bracket + 1), &end);
  } catch (const std::exception&) {
    return {};
  }
  if (number < 1 || part.substr(bracket + 1 + end) != "]") return {};
  return TablePlace{part.substr(0, bracket), static_cast<std::size_t>(number - 1)};
}

std::optional<KeyPlace> key_place(const std::string& path) {
  KeyPlace place;
  std::size_t begin = 0;
  for (std::size_t dot; (dot = path.find('.', begin)) != std::string::npos; begin = dot + 1) {
    const auto table = table_place(path.substr(begin, dot - begin));
    if (!table) return {};
    place.tables.push_back(*table);
  }
  place.key = path.substr(begin);
  return place;
}

/// The offset of a place in a text; columns count characters of UTF-8.
std::size_t offset(std::string_view text, const toml::source_position& place) {
  std::size_t at = 0;
  for (toml::source_index line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
  for (toml::source_index column = 1; column < place.column && at < text.size();) {
    ++at;
    if (at == text.size() || (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80) ++column;
  }
  return at;
}

/// The table in the text, and whether its array ends before it.
struct Found {
  const toml::table* table = nullptr;
  bool is_next = false;  ///< the table is the next one of an array, or no table of this name is there yet
};

Found find_table(const toml::table& root, const std::vector<TablePlace>& places) {
  Found found{&root};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [name, index] = places[i];
    const bool is_last = i + 1 == places.size();
    const toml::node* node = found.table->get(name);
    if (!index) {
      if (!node) return {nullptr, true};
      found.table = node->as_table();
    } else {
      const toml::array* array = node ? node->as_array() : nullptr;
      const std::size_t size = array ? array->size() : 0;
      if (*index >= size) return {nullptr, is_last && *index == size};
      found.table = (*array)[*index].as_table();
    }
    if (!found.table) return {};
  }
  return found;
}

/// The names of the keys that a key replaces, and its own.
std::vector<std::string> alternatives(const std::string& table, const std::string& name) {
  std::vector<std::string> names;
  for_each_section([&](const auto& section) {
    if (table_name(section) != table) return;
    const auto* key = find_key(section.keys, name);
    if (!key) return;
    for (const auto& other : section.keys)
      if (are_alternatives(other, *key)) names.emplace_back(other.name);
  });
  return names;
}

/// "holes.ring" of {holes, ring [1]}.
std::string joined_names(const std::vector<TablePlace>& tables) {
  std::string result;
  for (const TablePlace& table : tables) result += (result.empty() ? "" : ".") + table.name;
  return result;
}

std::string without_spaces(std::string text) {
  std::erase_if(text, [](char c) { return c == ' ' || c == '\t'; });
  return text;
}

/// The text without the lines from the key to the end of its value.
std::string without(std::string text, const toml::table& table, const std::string& name) {
  const auto entry = table.find(name);
  const std::size_t begin = offset(text, entry->first.source().begin),
                    end = offset(text, entry->second.source().end);
  return text.erase(begin, std::min(text.find('\n', end), text.size() - 1) + 1 - begin);
}

}  // namespace

Expected<std::string, KeyProblem> key_text(const Case& c, const std::string& path) {
  std::optional<std::string> found;
  visit_key(c, path, [&](const BoundKey& key) { found = value_text(key); });
  if (!found) return KeyProblem{unknown_key_text(c, path)};
  return *found;
}

Expected<std::string, KeyProblem> with_key(std::string_view text, const std::string& path,
                                           const std::string& value) {
  const auto place = key_place(path);
  if (!place) return KeyProblem{fmt::format("{} is not the path of a key, such as load.mass", path)};
  const std::string table_name = joined_names(place->tables);
  auto names = alternatives(table_name, place->key);
  if (value.empty()) std::erase_if(names, [&](const std::string& name) { return name != place->key; });
  if (names.empty()) return KeyProblem{unknown_key_text(Case(), path)};
  std::string result(text);
  if (!result.empty() && result.back() != '\n') result += '\n';
  for (const std::string& name : names) {
    const TomlLines toml = parse_toml_lines(result);
    const Found found = find_table(toml.root, place->tables);
    if (found.table && found.table->contains(name)) {
      if (name == place->key && !value.empty()) {
        const auto& source = found.table->get(name)->source();
        const std::size_t begin = offset(result, source.begin);
        result.replace(begin, offset(result, source.end) - begin, value);
      } else {
        result = without(std::move(result), *found.table, name);
      }
    }
  }
  const TomlLines toml = parse_toml_lines(result);
  const Found found = find_table(toml.root, place->tables);
  if (value.empty() || (found.table && found.table->contains(place->key))) return result;
  const std::string line = fmt::format("{} = {}\n", place->key, value);
  if (place->tables.empty()) return line + result;
  const bool is_array = place->tables.back().index.has_value();
  const std::string header = is_array ? fmt::format("[[{}]]", table_name) : fmt::format("[{}]", table_name);
  if (found.table) {
    const std::size_t begin = offset(result, found.table->source().begin), end = result.find('\n', begin);
    if (without_spaces(result.substr(begin, end - begin)).starts_with(header))
      return result.insert(end + 1, line);
  }
  const bool is_implied = found.table && !found.table->is_inline();
  if (!found.is_next && !is_implied)
    return KeyProblem{
        fmt::format("{}: there are fewer tables [[{}]], or not as tables of their own", path, table_name)};
  return fmt::format("{}\n{}\n{}", result, header, line);
}

}  // namespace wheelwright
