#pragma once

#include "wheelwright/linalg/cyclic_chain.h"
#include "wheelwright/mechanics/ring/harmonics.h"
#include "wheelwright/mechanics/ring/tread_column.h"

namespace wheelwright {

/// The tread: the outermost rows of cells, eliminated by static condensation once per run. It is attached to
/// the core along its base, the core's outer line. It is a ring of equal columns (one angular cell each), so
/// that the response of one column and its rotations describe it completely. See TreadColumn for the order of
/// base and observations; a load is a combination of observations. "Line c" consists of the nodes above the
/// base on column c's first azimuth. "Seam c" is column c's own part of the base, then line c: a column meets
/// the rest of the ring in its own seam and the next one alone, however fine it is inside.
template <int dim>
class Tread {
 public:
  /// `traced`: components of the traces, the first ones of the column frame. Fails with not_positive_definite
  /// if theta > 0 needs a larger gamma_0.
  static Expected<Tread> condense(const ElementTable<dim>& table, const TreadGrid& grid,
                                  const ContactForm& form, int points_per_direction, int traced = dim);

  const TreadColumn<dim>& column() const { return column_; }
  const TreadSurface<dim>& surface() const { return column_.surface; }
  const std::vector<TreadPoint<dim>>& points() const { return column_.surface.points; }
  ObservationRows<dim> observation_rows() const { return column_.surface.rows(); }
  int n_observations() const { return column_.observation.rows(); }
  int n_base() const { return column_.n_base; }
  int n_line() const { return column_.n_line; }
  int base_per_column() const {
    return degree_ * column_.n_base / (degree_ + 1);
  }  ///< not shared with the next
  int n_columns() const { return n_columns_; }
  int columns_per_sector() const { return columns_per_sector_; }
  int rows() const { return grid_.rows; }  ///< radial cells of the level set's grid
  const ContactForm& form() const { return form_; }

  /// Columns farther apart than this do not interact through the tread, up to rounding errors.
  int reach() const { return reach_; }

  /// The equations of the lines above a fixed base.
  const CyclicChain& lines() const { return *lines_; }

  int n_seam() const { return base_per_column() + column_.n_line; }

  /// Trial traces z = tau sigma(u)n - gamma u ("samples") and test traces theta/gamma sigma(v)n - v
  /// ("tests") of unit displacements of a column's own seam and of the next one: of every component of the
  /// column frame that is traced, one row per point. Transposed tests: the loads on the seams from a unit
  /// traction (times dS) on the column.
  int traced_components() const { return traced_; }
  const std::vector<Matrix>& samples() const { return samples_; }
  const std::vector<Matrix>& tests() const { return tests_; }

  /// Samples of component i of a column for unit tractions of component j on it, its seams fixed.
  const Matrix& compliance(int i, int j) const { return compliance_[traced_ * i + j]; }

  /// Displacements of line c + difference for unit loads on line c, base fixed; |difference| <= reach().
  const Matrix& line_compliance(int difference) const { return line_compliance_[difference + reach_]; }

  /// Displacements of line c for displacements of the base, by the parts of the columns c - base_reach() to c
  /// + base_reach(). Transposed: the loads on the base from loads on the line.
  int base_reach() const { return reach_ + 1; }
  const Matrix& line_of_base() const { return line_of_base_; }

  /// The tread's stiffness on the core's outer line for one harmonic of the sectors, as
  /// CyclicStiffness::OuterStiffness.
  ComplexMatrix outer_stiffness(const SectorHarmonics& harmonics, int harmonic) const;

 private:
  TreadGrid grid_;
  ContactForm form_;
  TreadColumn<dim> column_;
  int degree_ = 0, n_columns_ = 0, columns_per_sector_ = 0, reach_ = 0, traced_ = dim;
  std::optional<CyclicChain> lines_;
  std::vector<Matrix> samples_, tests_, compliance_, line_compliance_;
  Matrix line_of_base_;
  /// Between the base lines' own parts (base_per_column() unknowns) of columns that differ by -reach - 1 to
  /// reach + 1: rows for the later column.
  std::vector<Matrix> line_stiffness_;
};

}  // namespace wheelwright
