#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace wheelwright {

/// The files checkpoints/shape_NNNNNN.checkpoint of a run's folder, named by their shape.
class CheckpointFolder {
 public:
  /// `folder` is the run's. Does not access any file.
  explicit CheckpointFolder(const std::filesystem::path& folder) : folder_(folder / "checkpoints") {}

  /// All checkpoints, the newest first.
  std::vector<std::filesystem::path> files() const;

  /// Whether any checkpoint has been written.
  bool exists() const { return !files().empty(); }

  /// Marks a file as good after it was read: the next save() keeps it and the one before it.
  void keep(const std::filesystem::path& good);

  /// Writes a checkpoint, then removes all others except the last good one of another shape. A good one
  /// exists at all times. Throws OutputError.
  void save(int iteration, std::string_view bytes);

 private:
  void remove_all_but_good() const;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> good_;  ///< at most two, the newest first
};

}  // namespace wheelwright
