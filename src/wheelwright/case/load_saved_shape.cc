#include "wheelwright/case/load_saved_shape.h"

#include <fmt/format.h>

#include "wheelwright/case/case_key.h"
#include "wheelwright/files/level_set_file.h"

namespace wheelwright {

namespace {

namespace fs = std::filesystem;
using Kind = Diagnostic::Kind;

constexpr std::size_t most_bytes = std::size_t{1} << 28;

Expected<SavedLevelSet, FormatError> parsed(const std::string& bytes) {
  if (auto solid = parse_level_set_file<3>(bytes)) return SavedLevelSet(*std::move(solid));
  auto plane = parse_level_set_file<2>(bytes);
  if (!plane) return plane.failure();
  return SavedLevelSet(*std::move(plane));
}

}  // namespace

std::vector<FileProblem> load_saved_shape(Case& c, const fs::path& folder) {
  SavedShape& saved = c.saved_shape;
  if (saved.from.empty()) return {};
  const std::string key = key_of(&SavedShape::from).path();
  std::vector<FileProblem> problems;
  fs::path file = folder / saved.from;
  std::error_code error;
  if (fs::is_directory(file, error)) {
    file /= saved_shape_file;
    if (!fs::exists(file, error))
      return {{Kind::unreadable, key, "", 0,
               fmt::format("the folder {} contains no saved shape, {}", (folder / saved.from).string(),
                           saved_shape_file),
               "set the folder of a run that has saved a shape; `wheelwright resume` continues one that has "
               "not"}};
  }
  const auto bytes = read_named_file(file, key, most_bytes, problems);
  if (!bytes) return problems;
  // The blocks of such a file end in their own checksums, which makes the checksum of the whole file
  // independent of their contents. Read backwards it is not.
  check_checksum(saved.checksum, {bytes->rbegin(), bytes->rend()}, key_of(&SavedShape::checksum).path(),
                 problems);
  auto shape = parsed(*bytes);
  if (shape)
    saved.shape.contents = std::make_shared<const SavedLevelSet>(*std::move(shape));
  else
    problems.push_back({Kind::unreadable, key, "", 0,
                        fmt::format("{} cannot be used: {}: {}", file.string(),
                                    to_string(shape.failure().fault), shape.failure().detail),
                        fmt::format("set the folder of a run, or its file {}", saved_shape_file)});
  return problems;
}

}  // namespace wheelwright
