#pragma once

#include <array>
#include <vector>

#include "wheelwright/cut/cut_domain.h"

namespace wheelwright {

/// Numbering of the displacement unknowns of the core (the radial rows below the tread) in one sector. Nodes
/// lie on the sector's lattice extended by one cell past its last face, for a ghost face there couples the
/// first cells of the next sector. Nodes on the rim are fixed and carry no unknown; so do nodes without
/// material. Unknown = dim * node number + polar component.
template <int dim>
class SectorSpace {
 public:
  /// `core_rows`: radial cells that belong to the core; `degree` of the displacement, 1 or 2.
  SectorSpace(const CutDomain<dim>& domain, int degree, int core_rows);

  const PolarGrid<dim>& grid() const { return lattice_.grid(); }
  int degree() const { return lattice_.degree(); }
  int core_rows() const { return core_rows_; }
  int n_nodes() const { return static_cast<int>(positions_.size()); }
  int n_dofs() const { return dim * n_nodes(); }

  /// Lattice position of a numbered node; its azimuth may lie past the last face. Ascending: azimuth slowest.
  const std::array<int, dim>& position(int node) const { return positions_[node]; }

  /// Number of the node at an extended lattice position, -1 when it carries no unknown.
  int number(const std::array<int, dim>& position) const { return numbers_[extended_index(position)]; }

  /// Node numbers of a cell, local node order; `sectors_ahead` = 1 for the next sector's copy of the cell.
  std::vector<int> cell_nodes(int cell, int sectors_ahead = 0) const;

  /// Whether the plus cell of this face lies in the next sector.
  bool wraps(const GhostFace& face) const {
    return face.axis == 1 && grid().cell_position(face.minus)[1] == grid().cells[1] - 1;
  }

  /// Whether both cells of a ghost face belong to the core.
  bool holds(const GhostFace& face) const { return grid().cell_position(face.plus)[0] < core_rows_; }

 private:
  int extended_index(const std::array<int, dim>& p) const;

  Lattice<dim> lattice_;
  int core_rows_;
  std::vector<int> numbers_;
  std::vector<std::array<int, dim>> positions_;
};

}  // namespace wheelwright
