#pragma once

#include "wheelwright/ring/tread_column.h"
#include "wheelwright/ring/harmonics.h"
#include "wheelwright/linalg/cyclic_chain.h"

namespace wheelwright {

/// The tread: the outermost rows of cells, condensed once a run. It hangs on the core's outer line, its base,
/// and is a ring of equal columns (one angular cell each), so that all about it is one column's response and
/// its rotations. See TreadColumn for the order of base and observations; a load is a combination of
/// observations. "Line c" are the nodes above the base on column c's first azimuth.
template <int dim>
class Tread {
 public:
  /// Fails with not_positive_definite when theta > 0 asks for a larger gamma_0.
  static Expected<Tread> condense(const ElementTable<dim>& table, const TreadGrid& grid,
                                  const ContactForm& form, int points_per_direction);

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

  /// Columns farther apart than this do not feel each other through the tread, to rounding.
  int reach() const { return reach_; }

  /// The equations of the lines above a base that is held fixed.
  const CyclicChain& lines() const { return *lines_; }

  /// Contact samples z = tau sigma(u)n - gamma u and tests it with theta/gamma sigma(v)n - v (dim rows a
  /// point, column frame). Samples, tests of column c + difference for a unit displacement of the base of
  /// column c; |difference| <= reach(). Tests transposed: the load that reaches the base of column c from a
  /// unit traction (times dS) on column c + difference.
  const Matrix& samples(int difference) const { return samples_[difference + reach_]; }
  const Matrix& tests(int difference) const { return tests_[difference + reach_]; }

  /// Samples of column c + difference for a unit test of column c, base held fixed; |difference| <= reach().
  const Matrix& compliance(int difference) const { return compliance_[difference + reach_]; }

  /// The tread's stiffness on the core's outer line for every harmonic of the sectors, in the order of
  /// CyclicStiffness.
  std::vector<ComplexMatrix> outer_stiffness(const SectorHarmonics& harmonics) const;

 private:
  TreadGrid grid_;
  ContactForm form_;
  TreadColumn<dim> column_;
  int degree_ = 0, n_columns_ = 0, columns_per_sector_ = 0, reach_ = 0;
  std::optional<CyclicChain> lines_;
  std::vector<Matrix> compliance_, samples_, tests_, base_stiffness_;
};

}  // namespace wheelwright
