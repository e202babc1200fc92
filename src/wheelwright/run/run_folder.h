#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wheelwright/run/model.h"
#include "wheelwright/run/checkpoint.h"
#include "wheelwright/report/vtu.h"

namespace wheelwright {

/// Writes everything of a run but its history and checkpoints. All paths stay inside the folder; throws
/// OutputError.
class RunFolder {
 public:
  /// Makes the folder and writes case.toml, the resolved case with the versions that computed it. A run that
  /// goes on at a shape names it: later ones are dropped from shapes.pvd.
  RunFolder(std::filesystem::path folder, const Case& c, std::optional<int> resumed_at = {});

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path history() const { return folder_ / "history.csv"; }

  /// shapes/shape_NNNN.vtu with the fields of the worst load position, and shapes.pvd over all shapes so far.
  void write_shape(const RollingProblem<2>& problem, const OptimizationState<2>& state);

  /// shapes/shape_NNNN_*.svg: the pictures of this shape (wheel_pictures.h).
  void write_pictures(const RollingProblem<2>& problem, const OptimizationState<2>& state) const;

  /// pressures_NAME.csv and its plot: the contact of all positions.
  void write_pressures(const RollingProblem<2>& problem, const RollingSolution<2>& solution,
                       const std::string& name) const;

  /// The result: shape.svg for cutting, comparison.svg and the pictures of
  /// wheel_pictures.h to look at, rolling.pvd with the fields
  /// of every load position.
  void write_result(const RollingProblem<2>& problem, const InitialShape<2>& initial,
                    const OptimizationState<2>& final_state) const;

 private:
  std::string title() const;
  void list_shapes(int last_iteration);
  void write_list_of_shapes() const;

  std::filesystem::path folder_;
  Case case_;
  std::vector<PvdEntry> shapes_;
};

}  // namespace wheelwright
