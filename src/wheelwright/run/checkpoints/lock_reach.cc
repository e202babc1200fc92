#include "wheelwright/run/checkpoints/lock_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace wheelwright {
namespace {

/// One line of the mounts.
struct Mount {
  std::filesystem::path point;
  std::string type, options;
};

/// Spaces in paths are written as \040.
std::string with_spaces(std::string path) {
  for (std::size_t at = 0; (at = path.find("\\040", at)) != std::string::npos;) path.replace(at++, 4, " ");
  return path;
}

/// A number of optional fields ends with a dash; then follow type, source and options of the file system.
std::optional<Mount> parsed(const std::string& line) {
  std::istringstream words(line);
  std::string id, parent, device, root, point, word, source;
  Mount mount;
  if (!(words >> id >> parent >> device >> root >> point)) return {};
  while (words >> word && word != "-") {
  }
  if (!(words >> mount.type >> source >> mount.options)) return {};
  mount.point = with_spaces(point);
  return mount;
}

bool contains(const std::filesystem::path& point, const std::filesystem::path& folder) {
  const auto relative = folder.lexically_relative(point);
  return !relative.empty() && *relative.begin() != "..";
}

/// The file system of a folder: the deepest mount above it, and of several at one point the last.
Mount mount_of(const std::string& mounts, const std::filesystem::path& folder) {
  Mount deepest{"/", "", ""};
  std::istringstream lines(mounts);
  for (std::string line; std::getline(lines, line);)
    if (auto mount = parsed(line); mount && contains(mount->point, folder) &&
                                   mount->point.string().size() >= deepest.point.string().size())
      deepest = *std::move(mount);
  return deepest;
}

/// Options that make locks local, by the types of file systems.
struct LocalLocks {
  std::vector<std::string> types, options;
};

const std::vector<LocalLocks>& known_local_locks() {
  static const std::vector<LocalLocks> known{
      {{"nfs", "nfs4"}, {"nolock", "local_lock=flock", "local_lock=all"}},
      {{"lustre"}, {"localflock"}},
      {{"cifs", "smb3"}, {"nobrl"}}};
  return known;
}

}  // namespace

std::optional<std::string> why_locks_are_local(const std::string& mounts,
                                               const std::filesystem::path& folder) {
  const Mount mount = mount_of(mounts, folder);
  if (mount.type == "fuse.sshfs") return mount.type;
  const std::string options = "," + mount.options + ",";
  for (const LocalLocks& known : known_local_locks())
    if (std::ranges::find(known.types, mount.type) != known.types.end())
      for (const std::string& option : known.options)
        if (options.find("," + option + ",") != std::string::npos)
          return fmt::format("{}, mounted with {}", mount.type, option);
  return {};
}

}  // namespace wheelwright
