#include "wheelwright/run/checkpoints/checkpoint_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/written_files.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view prefix = "shape_", extension = ".checkpoint";
constexpr std::size_t most_kept = 2;

/// Nothing if the file is not a checkpoint.
std::optional<int> iteration_of(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.starts_with(prefix) || !name.ends_with(extension)) return {};
  const char *first = name.data() + prefix.size(), *last = name.data() + name.size() - extension.size();
  int iteration = 0;
  const auto [end, error] = std::from_chars(first, last, iteration);
  return error == std::errc{} && end == last ? std::optional(iteration) : std::nullopt;
}

/// Folders and links with the name of a checkpoint do not count.
bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type() == fs::file_type::regular;
}

/// Empty if there is no such folder.
std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> result;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
    result.push_back(it->path());
  return result;
}

}  // namespace

std::vector<fs::path> CheckpointFolder::files() const {
  std::vector<fs::path> result = entries(folder_);
  std::erase_if(result, [](const fs::path& file) { return !iteration_of(file) || !is_file(file); });
  std::ranges::sort(result, std::greater{}, iteration_of);
  return result;
}

void CheckpointFolder::keep(const fs::path& good) {
  const auto all = files();
  const auto found = std::ranges::find(all, good);
  good_.assign(found, all.end());
  good_.resize(std::min(good_.size(), most_kept));
}

void CheckpointFolder::save(int iteration, std::string_view bytes) {
  make_subfolder(folder_);
  const fs::path file = folder_ / fmt::format("{}{:06}{}", prefix, iteration, extension);
  write_atomically(file, bytes);
  if (good_.empty() || good_.front() != file) good_.insert(good_.begin(), file);
  good_.resize(std::min(good_.size(), most_kept));
  remove_all_but_good();
}

/// Errors are ignored, because extra files do no harm. Only files written by the program are removed.
void CheckpointFolder::remove_all_but_good() const {
  const WrittenFiles written(folder_);
  std::error_code ignored;
  for (const fs::path& file : entries(folder_)) {
    const std::string name = file.filename().string();
    const bool is_checkpoint = name.starts_with(prefix) && is_file(file) && written.is_own(name);
    if (is_checkpoint && std::ranges::find(good_, file) == good_.end()) fs::remove(file, ignored);
  }
}

}  // namespace wheelwright
