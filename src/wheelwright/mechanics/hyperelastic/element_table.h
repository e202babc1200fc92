#pragma once

#include <vector>

#include "wheelwright/base/expected.h"
#include "wheelwright/mechanics/elasticity/materials.h"
#include "wheelwright/mechanics/hyperelastic/element.h"

namespace wheelwright {

/// How a material law deforms by large amounts: a HyperelasticLaw by its energy, an isotropic law of linear
/// elasticity by Hooke's law, for layers that hardly deform.
struct LargeStrainLaw {
  StoredEnergy energy;
  Material small_strains;  ///< the constants of Hooke's law
};
/// Fails with unsupported_model for other laws, and for plane stress when dim = 3.
template <int dim>
Expected<LargeStrainLaw> large_strain_law(const MaterialLaw<dim>& law);

/// The materials of linear elasticity to which laws of large strains tend for small ones; others stay as they
/// are.
template <int dim>
Materials<dim> for_small_strains(const Materials<dim>& materials);

/// The parts of the discretization of large deformation that do not depend on the shape: an element, the
/// quadrature of a full cell and the ghost penalties of its faces per radial row. Built once per run.
template <int dim>
class HyperelasticTable {
 public:
  /// Fails as large_strain_law() does, and with unsupported_model if there are cords.
  static Expected<HyperelasticTable> create(const PolarGrid<dim>& grid, int degree,
                                            const Materials<dim>& materials, const GhostPenalty& ghost,
                                            DilatationKind dilatation = DilatationKind::automatic);

  const PolarGrid<dim>& grid() const { return grid_; }
  int degree() const { return degree_; }
  const GhostPenalty& ghost() const { return ghost_; }
  const HyperelasticElement<dim>& element(int row) const { return elements_[row]; }
  const typename HyperelasticElement<dim>::Points& full_cell(int row) const { return full_cells_[row]; }
  /// Of a face on the dofs (minus cell, plus cell); `row` is that of the minus cell.
  const Matrix& face_ghost(int row, int axis) const { return ghosts_[dim * row + axis]; }
  /// In place of the ghost penalty across a face where two materials meet and derivatives jump: a millionth
  /// of the stiffness E grad u : grad v of a full cell, for the cut ones (ElementTable::filling()).
  const Matrix& filling(int row) const { return fillings_[row]; }
  bool is_interface(int row) const { return interfaces_[row]; }  ///< between the row and the next one outside

 private:
  HyperelasticTable() = default;

  PolarGrid<dim> grid_;
  int degree_ = 2;
  GhostPenalty ghost_;
  std::vector<HyperelasticElement<dim>> elements_;
  std::vector<typename HyperelasticElement<dim>::Points> full_cells_;
  std::vector<Matrix> ghosts_, fillings_;
  std::vector<bool> interfaces_;
};

}  // namespace wheelwright
