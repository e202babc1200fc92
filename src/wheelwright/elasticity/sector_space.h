#pragma once

#include <array>
#include <vector>

#include "wheelwright/cut/cut_domain.h"
#include "wheelwright/elasticity/side_faces.h"

namespace wheelwright {

/// The dof map of one sector: numbers the displacement dofs of the core, which is the radial rows below the
/// tread. The nodes lie on the lattice of the sector, extended by one cell past its last face, because ghost
/// faces couple the last cells with the first cells of the next sector. Nodes on the rim, which are fixed,
/// and nodes that belong to no active cell have no dofs. The dofs of a node are its polar components,
/// numbered by dof().
template <int dim>
class SectorSpace {
 public:
  /// `degree` is that of the displacement, 1 or 2; `core_rows` is the number of radial rows of cells in the
  /// core.
  SectorSpace(const CutDomain<dim>& domain, int degree, int core_rows, SideFaces sides);

  const PolarGrid<dim>& grid() const { return lattice_.grid(); }
  int degree() const { return lattice_.degree(); }
  int core_rows() const { return core_rows_; }
  int n_nodes() const { return static_cast<int>(positions_.size()); }
  int n_dofs() const { return dim * n_nodes(); }
  static constexpr int dof(int node, int component) { return dim * node + component; }

  /// Lattice position of a node. Its azimuth may lie past the last face. Nodes are numbered in ascending
  /// order of their lattice position, with the azimuth varying slowest.
  const std::array<int, dim>& position(int node) const { return positions_[node]; }

  /// Number of the node at an extended lattice position; -1 if it has no dofs.
  int number(const std::array<int, dim>& position) const { return numbers_[extended_index(position)]; }

  /// Whether the side faces hold a component of a node's displacement: that dof is zero.
  bool is_held(int node, int component) const {
    return wheelwright::is_held<dim>(sides_, positions_[node][dim - 1], lattice_.nodes()[dim - 1] - 1,
                                     component);
  }

  /// Numbers of the nodes of a cell in the order of its local nodes, -1 for nodes without dofs.
  /// `sectors_ahead` = 1 stands for the image of the cell in the next sector.
  std::vector<int> cell_nodes(int cell, int sectors_ahead = 0) const;

  /// Whether the plus cell of a ghost face lies in the next sector.
  bool wraps(const GhostFace& face) const {
    return face.axis == 1 && grid().cell_position(face.minus)[1] == grid().cells[1] - 1;
  }

  /// Whether both cells of a ghost face belong to the core.
  bool holds(const GhostFace& face) const { return grid().cell_position(face.plus)[0] < core_rows_; }

 private:
  int extended_index(const std::array<int, dim>& p) const;
  /// Extended lattice position of a local node of a cell, or of its image in the next sector.
  std::array<int, dim> cell_node(int cell, int local_node, int sectors_ahead) const;

  Lattice<dim> lattice_;
  int core_rows_;
  SideFaces sides_;
  std::vector<int> numbers_;
  std::vector<std::array<int, dim>> positions_;
};

}  // namespace wheelwright
