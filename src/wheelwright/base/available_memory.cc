#include "wheelwright/base/available_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "wheelwright/base/number_in_file.h"

namespace wheelwright {
namespace {

using Path = std::filesystem::path;

/// The names of a control group's files, whose values are in bytes.
struct GroupFiles {
  const char *limit, *used, *reclaimable_name;  ///< the last is a line of memory.stat
};
constexpr GroupFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"};
constexpr GroupFiles version_2{"memory.max", "memory.current", "inactive_file"};

/// The single number in a file; nothing for "max" or if there is no file.
std::optional<double> number_in(const Path& file) {
  double value;
  return std::ifstream(file) >> value ? std::optional(value) : std::nullopt;
}

void lower(std::optional<double>& minimum, std::optional<double> value) {
  if (value) minimum = std::min(minimum.value_or(*value), *value);
}

/// The memory left by a control group and its parent groups. A container may see its own group as the top
/// one, so missing folders are skipped.
std::optional<double> left_by_groups(const Path& top, const Path& group, const GroupFiles& files) {
  std::optional<double> minimum;
  for (Path path = group.relative_path();; path = path.parent_path()) {
    const Path folder = top / path;
    if (const auto limit = number_in(folder / files.limit)) {
      const double used = number_in(folder / files.used).value_or(0);
      const double reclaimable = number_of(folder / "memory.stat", files.reclaimable_name).value_or(0);
      lower(minimum, std::max(0.0, *limit - std::max(0.0, used - reclaimable)));
    }
    if (path.empty()) return minimum;
  }
}

/// Whether a comma-separated list contains a word.
bool lists(std::string_view list, std::string_view word) {
  return fmt::format(",{},", list).find(fmt::format(",{},", word)) != std::string::npos;
}

}  // namespace

std::optional<double> available_memory(const Path& root) {
  constexpr double kibibyte = 1024;
  std::optional<double> minimum = number_of(root / "proc/meminfo", "MemAvailable:");
  if (minimum) *minimum *= kibibyte;
  const Path top = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // number:controllers:path
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1),
                      group = line.substr(second + 1);
    if (controllers.empty())
      lower(minimum, left_by_groups(top, group, version_2));
    else if (lists(controllers, "memory"))
      lower(minimum, left_by_groups(top / "memory", group, version_1));
  }
  return minimum;
}

}  // namespace wheelwright
