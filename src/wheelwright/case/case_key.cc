#include "wheelwright/case/case_key.h"

namespace wheelwright {

namespace {

std::string path_of(const std::string& table, std::string_view name) {
  return table.empty() ? std::string(name) : table + "." + std::string(name);
}

}  // namespace

std::string CaseKey::path() const { return names.empty() ? table : path_of(table, names.front()); }

std::vector<std::string> CaseKey::paths() const {
  if (names.empty()) return {table};
  std::vector<std::string> paths;
  for (const std::string_view name : names) paths.push_back(path_of(table, name));
  return paths;
}

CaseKeys joined(std::initializer_list<CaseKeys> lists) {
  CaseKeys all;
  for (const CaseKeys& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace wheelwright
