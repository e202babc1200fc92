#pragma once

#include <filesystem>
#include <vector>

#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/output/report/tread_contact.h"
#include "wheelwright/output/report/vtu.h"

namespace wheelwright {

/// Writes the wheel, its tread and the ground in every load position to the folder rolling of a run.
template <int dim>
class RollingFiles {
 public:
  /// Makes the folder.
  RollingFiles(std::filesystem::path run, const LevelSet<dim>& shape, const StateSolver<dim>& solver,
               const State<dim>& solution);

  void write(int position, const PositionFields<dim>& fields);

  /// rolling.pvd: the written positions, at the azimuth of the contact in degrees.
  void write_collection() const;

 private:
  std::filesystem::path run_;
  VtuMesh<dim> mesh_;
  std::vector<TreadContact<dim>> treads_;
  std::vector<PvdEntry> entries_;
};

}  // namespace wheelwright
