#include "given_case.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "wheelwright/case/read.h"
#include "wheelwright/case/set_number.h"

namespace wheelwright::bench {

std::optional<Case> given_case(const char* path, std::span<char* const> changes) {
  auto read = read_case(path);
  for (const auto& problem : read.problems) fmt::print(stderr, "{}\n", problem.text());
  if (!read.value) return {};
  for (const std::string change : changes) {
    const auto equals = change.find('=');
    if (equals == std::string::npos) {
      fmt::print(stderr, "{}: KEY=NUMBER is missing its =\n", change);
      return {};
    }
    if (const auto problem =
            set_number(*read.value, change.substr(0, equals), std::atof(change.c_str() + equals + 1))) {
      fmt::print(stderr, "{}\n", *problem);
      return {};
    }
  }
  return read.value;
}

}  // namespace wheelwright::bench
