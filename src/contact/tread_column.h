#pragma once

#include "contact/tread.h"

namespace wheelwright {

/// One column of the tread with its inner unknowns condensed. Retained unknowns: base (see Tread), then the
/// nodes above the base on the column's first azimuth line, then those on its last.
template <int dim>
struct TreadColumn {
  std::vector<TreadPoint<dim>> points;
  int n_base, n_line;
  Matrix stiffness;         ///< retained x retained
  Matrix observation;       ///< observations x retained
  Matrix compliance;        ///< observations x observations, retained unknowns fixed
  Matrix nodal;             ///< the column's own nodes (see Tread::nodal_transfer) x retained
  Matrix nodal_compliance;  ///< the column's own nodes x observations, retained unknowns fixed
};

/// Assembles and condenses a column of `rows` cells below the outer radius.
template <int dim>
Expected<TreadColumn<dim>> tread_column(const ElementTable<dim>& table, int rows, const ContactForm& form,
                                        int points_per_direction);

}  // namespace wheelwright
