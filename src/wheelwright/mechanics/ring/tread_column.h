#pragma once

#include "wheelwright/mechanics/elasticity/sector_stiffness.h"
#include "wheelwright/mechanics/state/rolling_model.h"
#include "wheelwright/mechanics/state/tread_surface.h"

namespace wheelwright {

/// One column of the tread (one angular cell of the level set's grid) as a substructure (superelement): its
/// inner unknowns are eliminated by static condensation.
/// Retained unknowns: base (the nodes of the core's outer line on the column's degree + 1 azimuth lines; line
/// major, then axial node, then polar component), then the nodes above the base on the column's first
/// azimuth, then those on its last. Observations are those of ObservationRows. Nitsche's term -theta/gamma
/// sigma(u)n.sigma(v)n of (28) does not depend on the load position; it is part of the stiffness.
template <int dim>
struct TreadColumn {
  TreadSurface<dim> surface;
  double volume;    ///< int dx
  Vec<dim> moment;  ///< int x dx, in the column's frame
  int n_base, n_line;
  Matrix stiffness;    ///< retained x retained
  Matrix observation;  ///< observations x retained
  Matrix compliance;   ///< observations x observations, retained unknowns fixed
  /// Displacements at the grid's own nodes above the base, on the column's first degree azimuth lines (line
  /// major, then axial node, then radial node, then polar component).
  Matrix nodal;             ///< x retained
  Matrix nodal_compliance;  ///< x observations, retained unknowns fixed
};

/// Fails with not_positive_definite if theta > 0 needs a larger gamma_0.
template <int dim>
Expected<TreadColumn<dim>> tread_column(const ElementTable<dim>& table, const TreadGrid& tread,
                                        const ContactForm& form, int points_per_direction);

}  // namespace wheelwright
