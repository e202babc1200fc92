#pragma once

#include "wheelwright/elasticity/element.h"
#include "wheelwright/elasticity/materials.h"
#include "wheelwright/elasticity/stencil_matrix.h"

namespace wheelwright {

/// Everything about the elements of a grid that no shape changes: elements, stiffness of full cells and ghost
/// penalty of faces, one a radial row. Built once a run.
template <int dim>
class ElementTable {
 public:
  ElementTable(const PolarGrid<dim>& grid, int degree, const Materials& materials, const GhostPenalty& ghost);

  const PolarGrid<dim>& grid() const { return grid_; }
  int degree() const { return degree_; }
  const Materials& materials() const { return materials_; }
  const GhostPenalty& ghost() const { return ghost_; }

  const ElasticElement<dim>& element(int radial) const { return elements_[radial]; }
  const Matrix& full_cell_stiffness(int radial) const { return stiffness_[radial]; }
  /// On the dofs (minus cell, plus cell); `radial` is the minus cell's row.
  const Matrix& face_ghost(int radial, int axis) const { return ghosts_[dim * radial + axis]; }

 private:
  PolarGrid<dim> grid_;
  int degree_;
  Materials materials_;
  GhostPenalty ghost_;
  std::vector<ElasticElement<dim>> elements_;
  std::vector<Matrix> stiffness_;
  std::vector<Matrix> ghosts_;
};

/// Stiffness of the core of one sector: bulk (2) and ghost penalty (81), rim fixed, sector faces free.
template <int dim>
struct SectorStiffness {
  SectorSpace<dim> space;
  SparseSymmetric matrix;

  /// A face that carries ghost penalty: its matrix on the dofs of `nodes` (minus cell, plus cell; -1 for
  /// fixed nodes).
  struct Ghost {
    std::vector<int> nodes;
    const Matrix* stiffness;
  };
  std::vector<Ghost> ghosts;
};

/// Assembles the sector; `table` must outlive the result.
template <int dim>
SectorStiffness<dim> sector_stiffness(const CutDomain<dim>& domain, const ElementTable<dim>& table,
                                      int core_rows);

}  // namespace wheelwright
