#pragma once

#include "contact/contact_law.h"
#include "cyclic/harmonics.h"
#include "elasticity/sector_stiffness.h"

namespace wheelwright {

/// A quadrature point of the tread Gamma_C, in its column.
template <int dim>
struct TreadPoint {
  Vec<dim>
      position;   ///< in the column's frame: Cartesian axes, the first radial at the column's first azimuth
  double weight;  ///< dS
  double gamma;   ///< gamma_0 E / h_T [Pa/m]
};

/// The tread: the outermost rows of cells, which no shape cuts, condensed once a run. It hangs on the core's
/// outer line ("base" below), and is a ring of equal columns (one angular cell each), so that everything
/// about it is one column's response and its rotations.
///
/// Its unknowns are condensed away; what remains are, in every column, observations and the base.
/// Observations: for every TreadPoint first the displacement u, then the traction sigma(u)n on Gamma_C
/// (2 * dim rows a point, Cartesian in the column's frame), as linear functionals of the displacement; a load
/// is a combination of the same functionals. Base: the displacements of the base nodes of the column's degree
/// + 1 azimuth lines (line major, then axial node, then polar component).
///
/// Nitsche's term -theta/gamma sigma(u)n.sigma(v)n of (28) does not depend on the load position; it is part
/// of the tread's stiffness.
template <int dim>
class Tread {
 public:
  /// Fails with not_positive_definite when theta > 0 asks for a larger gamma_0.
  static Expected<Tread> condense(const ElementTable<dim>& table, int rows, const ContactForm& form,
                                  int points_per_direction);

  const std::vector<TreadPoint<dim>>& points() const { return points_; }
  int n_observations() const { return 2 * dim * static_cast<int>(points_.size()); }
  int n_base() const { return n_base_; }
  int base_per_column() const { return degree_ * base_per_line_; }  ///< the outer line's unknowns of a column
  int n_columns() const { return n_columns_; }
  const ContactForm& form() const { return form_; }

  /// Columns farther apart than this do not feel each other through the tread, to rounding.
  int reach() const { return reach_; }

  /// Observations in column c + difference for a unit load on an observation of column c, base held fixed.
  const Matrix& compliance(int difference) const { return compliance_[slot(difference)]; }

  /// Observations in column c + difference for a unit displacement of the base of column c. Transposed: the
  /// load that reaches the base of column c from a unit load on an observation of column c + difference.
  const Matrix& transfer(int difference) const { return transfer_[slot(difference)]; }

  /// As transfer() and compliance(), for the displacements of the nodes above the base on the column's first
  /// azimuth line and inside the column (line major, then axial node, then radial node, then polar
  /// component).
  const Matrix& nodal_transfer(int difference) const { return nodal_transfer_[slot(difference)]; }
  const Matrix& nodal_compliance(int difference) const { return nodal_compliance_[slot(difference)]; }
  int rows() const { return rows_; }  ///< radial cells

  /// The tread's stiffness on the core's outer line for one harmonic of the sectors, in the order of
  /// CyclicStiffness.
  std::vector<ComplexMatrix> outer_stiffness(const SectorHarmonics& harmonics) const;

 private:
  int slot(int difference) const { return difference + reach_; }

  ContactForm form_;
  int rows_ = 0, degree_ = 0, n_base_ = 0, n_columns_ = 0, base_per_line_ = 0, columns_per_sector_ = 0,
      reach_ = 0;
  std::vector<TreadPoint<dim>> points_;
  std::vector<Matrix> compliance_, transfer_, base_stiffness_, nodal_transfer_, nodal_compliance_;
};

}  // namespace wheelwright
