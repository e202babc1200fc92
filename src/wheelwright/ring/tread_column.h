#pragma once

#include "wheelwright/elasticity/contact_form.h"
#include "wheelwright/elasticity/sector_stiffness.h"

namespace wheelwright {

/// The outermost rows of cells, which no shape cuts, and their grid, halved `levels` times towards the tread.
/// The lower half of the rows is halved once, the next quarter twice and so on; the last part is halved
/// `levels` times. Hanging nodes are constrained to the coarser cells.
struct TreadGrid {
  int rows = 1;            ///< radial cells of the level set's grid
  int levels = 0;          ///< L
  int annulus_points = 0;  ///< Gauss points per direction and cell at which sigma(u)n is observed; 0: none
};

/// A quadrature point on the tread Gamma_C, in its column.
template <int dim>
struct TreadPoint {
  Vec<dim>
      position;   ///< in the column's frame: Cartesian axes, the first radial at the column's first azimuth
  double weight;  ///< dS
  double gamma;   ///< gamma_0 E / h_T [Pa/m], where h_T is the diameter of the cell at the tread
};

/// A quadrature point of the annulus Gamma_C^epsilon (60), which is the tread itself.
struct AnnulusPoint {
  double weight;  ///< dx
};

/// One column of the tread (one angular cell of the level set's grid) as a substructure (superelement): its
/// inner unknowns are eliminated by static condensation.
/// Retained unknowns: base (the nodes of the core's outer line on the column's degree + 1 azimuth lines; line
/// major, then axial node, then polar component), then the nodes above the base on the column's first
/// azimuth, then those on its last. Observations: for every point first the displacement u, then the traction
/// sigma(u)n on Gamma_C, Cartesian in the column's frame: 2 * dim rows per point. After them, if wanted, for
/// every AnnulusPoint sigma(u)n with radial n: dim rows per point. Last the integral of u over the column:
/// dim rows, on which body forces act. Nitsche's term -theta/gamma sigma(u)n.sigma(v)n of (28) does not
/// depend on the load position; it is part of the stiffness.
template <int dim>
struct TreadColumn {
  std::vector<TreadPoint<dim>> points;
  std::vector<AnnulusPoint> annulus;
  /// Index of each observation's mirror image in the column; an observation here is a vector of dim rows.
  std::vector<int> mirror_images;
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
