#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "wheelwright/linalg/sparse_symmetric.h"
#include "wheelwright/mechanics/equilibrium/ring_space.h"
#include "wheelwright/mechanics/hyperelastic/element_table.h"

namespace wheelwright {

/// The stored energy of a shape's ring and its ghost penalty, with their derivatives with respect to the dofs
/// of RingSpace.
template <int dim>
class RingForms {
 public:
  /// Refers to both, which must outlive it.
  RingForms(const CutDomain<dim>& domain, const HyperelasticTable<dim>& table);

  const RingSpace<dim>& space() const { return space_; }
  const CutDomain<dim>& domain() const { return domain_; }
  const HyperelasticTable<dim>& table() const { return table_; }

  /// A cell of the sector that has material.
  struct Cell {
    int cell, row;
    const typename HyperelasticElement<dim>::Points* points;
  };
  const std::vector<Cell>& cells() const { return cells_; }
  const HyperelasticElement<dim>& element(const Cell& cell) const { return table_.element(cell.row); }

  /// The stored energy of the material; infinite if it is turned inside out somewhere [J/m or J].
  double energy(const std::vector<double>& v) const;

  /// The energies, and their first derivatives.
  struct Forces {
    double energy;                 ///< the stored energy
    double ghost_energy;           ///< 1/2 v^T G v
    std::vector<double> internal;  ///< derivative of the stored energy
    std::vector<double> ghost;     ///< G v
    bool admissible() const { return std::isfinite(energy); }
  };
  Forces forces(const std::vector<double>& v) const;

  /// The second derivative of both, beside the first.
  Forces tangent(const std::vector<double>& v, SparseSymmetric& matrix) const;

  /// The cells in which nodes are coupled by ghost penalties, of one sector and the first column of the next:
  /// minus cell and plus cell, the same where one cell alone is penalized.
  struct Coupling {
    int minus, plus;
    bool into_next_sector;
    const Matrix* stiffness;
  };
  const std::vector<Coupling>& couplings() const { return couplings_; }

 private:
  void build_pattern();
  /// The place of node b among the neighbours of node a < b.
  int neighbour_index(int a, int b) const;
  void add_block(std::span<const int> nodes, const double* block, int stride,
                 std::vector<double>& values) const;
  std::vector<int> coupled_nodes(const Coupling& coupling, int sector) const;
  void add_ghost_forces(const std::vector<double>& v, Forces& forces) const;

  const CutDomain<dim>& domain_;
  const HyperelasticTable<dim>& table_;
  RingSpace<dim> space_;
  std::vector<typename HyperelasticElement<dim>::Points> cut_;
  std::vector<Cell> cells_;
  std::vector<Coupling> couplings_;

  // The pattern, by nodes: the coupled nodes with larger numbers, ascending.
  std::vector<int> neighbour_start_, neighbours_;
  SparseSymmetric ghost_matrix_;  ///< with the pattern of the tangent
};

}  // namespace wheelwright
