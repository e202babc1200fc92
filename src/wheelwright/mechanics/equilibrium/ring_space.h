#pragma once

#include <array>
#include <vector>

#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// The numbering of the displacement on the whole ring, without the rim's motion: of the nodes of all cells
/// with material, of all sectors, but for those on the rim, which are fixed. A node's dofs are its polar
/// components. All sectors have the same numbers, n_nodes_of_sector() apart.
template <int dim>
class RingSpace {
 public:
  RingSpace(const CutDomain<dim>& domain, int degree);

  const PolarGrid<dim>& grid() const { return lattice_.grid(); }
  const Lattice<dim>& lattice() const { return lattice_; }
  int degree() const { return lattice_.degree(); }
  int n_nodes_of_sector() const { return static_cast<int>(positions_.size()); }
  int n_nodes() const { return n_nodes_of_sector() * grid().n_sectors; }
  int n_dofs() const { return dim * n_nodes(); }
  static constexpr int dof(int node, int component) { return dim * node + component; }

  /// Number of the node at a position of the lattice, whose azimuth counts around the ring; -1 if it has no
  /// dofs.
  int number(std::array<int, dim> position) const;

  /// Position of a node in its sector, the azimuth from there.
  const std::array<int, dim>& position_in_sector(int node) const {
    return positions_[node % n_nodes_of_sector()];
  }

  /// Numbers of the nodes of a cell of a sector in the order of its local nodes, -1 for those on the rim.
  std::vector<int> cell_nodes(int cell, int sector) const;

  /// The dofs of a cell of a sector out of those of the ring.
  void gather(int cell, int sector, const double* ring, double* of_cell) const;
  /// Adds numbers on the dofs of a cell to those on the ring.
  void scatter(int cell, int sector, const double* of_cell, double* ring) const;

 private:
  Lattice<dim> lattice_;
  std::vector<int> numbers_;  ///< of the nodes of the lattice of one sector
  std::vector<std::array<int, dim>> positions_;
};

}  // namespace wheelwright
