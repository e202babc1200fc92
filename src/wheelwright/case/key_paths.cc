#include "wheelwright/case/key_paths.h"

#include <fmt/format.h>

#include <vector>

#include "wheelwright/case/suggest.h"

namespace wheelwright {
namespace {

std::string in_table(const std::string& table, std::string_view name) {
  return table.empty() ? std::string(name) : fmt::format("{}.{}", table, name);
}

/// Calls visit(path, key) for all keys of a case.
void for_each_key(const Case& c, const std::function<void(const std::string&, const BoundKey&)>& visit) {
  const auto visit_table = [&](const std::string& table, const BoundKeys& keys) {
    for (const BoundKey& key : keys) visit(in_table(table, key.name), key);
  };
  for_each_section_of(c, [&](const auto& section) {
    if constexpr (requires { section.path(); }) {
      const auto& list = section.of(c);
      for (std::size_t i = 0; i < list.size(); ++i)
        visit_table(fmt::format("{}[{}]", section.path(), i + 1), bound(section.keys, list[i]));
    } else {
      visit_table(table_name(section), bound(section.keys, section.of(c)));
    }
  });
}

}  // namespace

void visit_key(const Case& c, const std::string& path, const std::function<void(const BoundKey&)>& visit) {
  for_each_key(c, [&](const std::string& other, const BoundKey& key) {
    if (other == path) visit(key);
  });
}

std::string unknown_key_text(const Case& c, const std::string& path) {
  std::vector<std::string> paths;
  for_each_key(c, [&](const std::string& other, const BoundKey&) { paths.push_back(other); });
  const auto near = did_you_mean(path, std::vector<std::string_view>(paths.begin(), paths.end()));
  return fmt::format("{} is not a key of this case{}", path,
                     near ? fmt::format("; did you mean {}?", *near) : "");
}

}  // namespace wheelwright
