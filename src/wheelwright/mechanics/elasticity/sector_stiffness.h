#pragma once

#include "wheelwright/mechanics/elasticity/element.h"
#include "wheelwright/mechanics/elasticity/materials.h"
#include "wheelwright/mechanics/elasticity/stencil_matrix.h"

namespace wheelwright {

/// The stiffness of a part of a cell: cell_stiffness(), or another form in its place.
template <int dim>
using CellStiffness = Matrix(const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
                             std::span<const ReferencePoint<dim>> points);

/// The parts of the discretization that do not depend on the shape: one element, one stiffness of a full cell
/// and the ghost penalties of its faces per radial row. Built once per run.
template <int dim>
class ElementTable {
 public:
  ElementTable(const PolarGrid<dim>& grid, int degree, const Materials<dim>& materials,
               const GhostPenalty& ghost, CellStiffness<dim>* bulk = cell_stiffness<dim>,
               SideFaces sides = SideFaces::free, DilatationKind dilatation = DilatationKind::automatic);

  const PolarGrid<dim>& grid() const { return grid_; }
  int degree() const { return degree_; }
  const Materials<dim>& materials() const { return materials_; }
  const MaterialLaw<dim>& law(int radial) const { return materials_.in_row(grid_, radial); }
  const GhostPenalty& ghost() const { return ghost_; }
  SideFaces sides() const { return sides_; }
  DilatationKind dilatation() const { return dilatation_; }

  /// The stiffness of dofs fixed by the side faces: so large that they are zero up to rounding [N/m].
  double held_stiffness() const { return 1e20 * materials_.stiffest() * grid_.resolution(); }

  /// The stiffness of a part of a cell, which may be one of a refined grid.
  Matrix bulk_stiffness(const ElasticElement<dim>& element, const MaterialLaw<dim>& law,
                        std::span<const ReferencePoint<dim>> points) const {
    return bulk_(element, law, points);
  }

  const ElasticElement<dim>& element(int radial) const { return elements_[radial]; }
  /// Of a cell full of material, with the cords on its outer face.
  const Matrix& full_cell_stiffness(int radial) const { return stiffness_[radial]; }
  /// Of the cords on the outer face of the cells of a row; empty if there are none.
  const Matrix& cord_stiffness(int radial) const { return cords_[radial]; }
  /// The ghost penalty of a face on the dofs (minus cell, plus cell); `radial` is the row of the minus cell.
  const Matrix& face_ghost(int radial, int axis) const { return ghosts_[dim * radial + axis]; }
  /// The same of a face between two sectors, which lies in this radial row.
  const GhostHalves& divided_face_ghost(int radial) const { return divided_ghosts_[radial]; }
  /// In place of the ghost penalty across a face where two materials meet and derivatives jump: a millionth
  /// of the stiffness of a full cell, for the cut ones. It keeps parts of any size well conditioned, and is
  /// far below the discretization error.
  const Matrix& filling(int radial) const { return fillings_[radial]; }
  /// Half of that of a face whose plus cell is the mirror image of the minus cell, on the dofs of the minus
  /// cell; when dim = 3.
  const Matrix& ghost_at_middle(int radial) const { return ghosts_at_middle_[radial]; }

 private:
  PolarGrid<dim> grid_;
  int degree_;
  Materials<dim> materials_;
  GhostPenalty ghost_;
  CellStiffness<dim>* bulk_;
  SideFaces sides_;
  DilatationKind dilatation_;
  std::vector<ElasticElement<dim>> elements_;
  std::vector<Matrix> stiffness_, cords_;
  std::vector<Matrix> ghosts_, ghosts_at_middle_, fillings_;
  std::vector<GhostHalves> divided_ghosts_;
};

/// Stiffness of the core of one sector: bulk (2) and ghost penalty (81), with a fixed rim, free sector faces
/// and, when dim = 3, the table's side faces.
template <int dim>
struct SectorStiffness {
  SectorSpace<dim> space;
  SparseSymmetric matrix;

  /// A ghost penalty: `stiffness` acts on the dofs of `nodes`, with -1 for fixed nodes: the minus cell and
  /// the plus cell of a face; only one of them if the other is its mirror image or of another material; or
  /// one of these cells and the derivatives on the face if it is one between sectors.
  struct Ghost {
    std::vector<int> nodes;
    const Matrix* stiffness;
  };
  std::vector<Ghost> ghosts;
};

/// Assembles the stiffness of a sector. The result refers to `table`, which must outlive it.
template <int dim>
SectorStiffness<dim> sector_stiffness(const CutDomain<dim>& domain, const ElementTable<dim>& table,
                                      int core_rows);

}  // namespace wheelwright
