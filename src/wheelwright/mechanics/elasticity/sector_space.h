#pragma once

#include <array>
#include <vector>

#include "wheelwright/mechanics/elasticity/ghost_penalty.h"
#include "wheelwright/mechanics/elasticity/side_faces.h"
#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// The dof map of one sector: numbers the displacement dofs of the core, which is the radial rows below the
/// tread. The nodes lie on the lattice of the sector. Nodes on the rim, which are fixed, and nodes that
/// belong to no active cell have no dofs. Where a ghost penalty acts on a face between two sectors, the
/// derivatives of the displacement across it are unknowns too (divided_ghost_stiffness()), so that a sector
/// shares with its neighbours what is on their faces and nothing else. They have nodes of their own on the
/// lines before the first azimuth and after the last: the derivative of order k is at -k and at k past the
/// last azimuth. The dofs of a node are its polar components, numbered by dof().
template <int dim>
class SectorSpace {
 public:
  /// `degree` is that of the displacement, 1 or 2; `core_rows` is the number of radial rows of cells in the
  /// core.
  SectorSpace(const CutDomain<dim>& domain, int degree, int core_rows, SideFaces sides,
              const GhostPenalty& ghost);

  const PolarGrid<dim>& grid() const { return lattice_.grid(); }
  int degree() const { return lattice_.degree(); }
  int core_rows() const { return core_rows_; }
  int n_nodes() const { return static_cast<int>(positions_.size()); }
  int n_dofs() const { return dim * n_nodes(); }
  static constexpr int dof(int node, int component) { return dim * node + component; }

  /// Lattice position of a node, or the line that stands for a derivative on a face. Nodes are numbered in
  /// ascending order of their position, with the azimuth varying slowest.
  const std::array<int, dim>& position(int node) const { return positions_[node]; }
  /// The line of the last azimuth.
  int last_line() const { return degree() * grid().cells[1]; }

  /// Number of the node at such a position; -1 if it has no dofs.
  int number(const std::array<int, dim>& position) const { return numbers_[index(position)]; }

  /// Whether the side faces fix a component of a node's displacement: that dof is zero.
  bool is_held(int node, int component) const {
    return wheelwright::is_held<dim>(sides_, positions_[node][dim - 1], lattice_.nodes()[dim - 1] - 1,
                                     component);
  }

  /// Numbers of the nodes of a cell in the order of its local nodes, -1 for nodes without dofs.
  std::vector<int> cell_nodes(int cell) const;

  enum class Face { first, last };
  /// The same and then the nodes of the derivatives on the sector's first or last face, to which the cell is
  /// next, in the order of divided_ghost_stiffness().
  std::vector<int> cell_and_face_nodes(int cell, Face face) const;

  /// Whether a ghost penalty acts on this face of the core.
  bool penalizes(const GhostFace& face) const {
    return grid().cell_position(face.plus)[0] < core_rows_ &&
           (ghost_.kind == GhostPenaltyKind::full || face.crossed);
  }

  /// Whether the plus cell of a ghost face lies in the next sector.
  bool wraps(const GhostFace& face) const {
    return face.axis == 1 && grid().cell_position(face.minus)[1] == grid().cells[1] - 1;
  }

 private:
  static constexpr int most_derivatives = 2;
  int index(const std::array<int, dim>& p) const;
  /// The positions of the derivatives, in their order, on a face of the sector to which a cell is next.
  std::vector<std::array<int, dim>> face_positions(int cell, Face face) const;

  Lattice<dim> lattice_;
  int core_rows_;
  SideFaces sides_;
  GhostPenalty ghost_;
  std::vector<int> numbers_;
  std::vector<std::array<int, dim>> positions_;
};

}  // namespace wheelwright
