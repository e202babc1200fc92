#include "wheelwright/app/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "wheelwright/base/number_in_file.h"
#include "wheelwright/run/study/problem_size.h"

namespace wheelwright {

using Path = std::filesystem::path;

std::optional<double> address_space_left(const Path& root) {
  constexpr double kibibyte = 1024;
  constexpr std::string_view limit_name = "Max address space";
  std::ifstream limits(root / "proc/self/limits");
  for (std::string line; std::getline(limits, line);) {
    if (!line.starts_with(limit_name)) continue;
    double limit;
    if (!(std::istringstream(line.substr(limit_name.size())) >> limit)) return {};  // unlimited
    return std::max(0.0, limit - number_of(root / "proc/self/status", "VmSize:").value_or(0) * kibibyte);
  }
  return {};
}

std::optional<std::string> lack_of_address_space(const Case& c, int n_threads, std::optional<double> left) {
  constexpr double per_thread = 200e6;  // stack, own heap, buffers of BLAS
  const double needed = estimated_memory(problem_size(c)) + per_thread * n_threads;
  if (!left || needed <= *left) return {};
  return fmt::format(
      "it may need {:.0f} MB of address space on {} threads, but `ulimit -v` leaves {:.0f} MB; raise that "
      "limit, or use fewer --threads",
      needed / 1e6, n_threads, *left / 1e6);
}

std::optional<std::string> lack_of_memory(const Case& c, std::optional<double> available) {
  const double needed = estimated_memory(problem_size(c));
  if (!available || needed <= *available) return {};
  return fmt::format(
      "it needs about {:.0f} MB of memory, but only {:.0f} MB are available; use fewer cells or load "
      "positions, or more sectors",
      needed / 1e6, *available / 1e6);
}

}  // namespace wheelwright
