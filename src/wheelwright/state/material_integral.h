#pragma once

#include "wheelwright/state/state.h"

namespace wheelwright {

/// int M(u_i) dx over the material of the whole ring, tread included, of every position that was solved for.
/// With MaterialRule's points and the strains of Displacement::strains().
template <int dim>
std::vector<double> material_integral(const StateSolver<dim>& solver, const State<dim>& state,
                                      const MaterialDensity<dim>& density);

/// Calls visit(position, weight [m^2, or m^3 when dim = 3], law, strain) for every point of the same
/// quadrature in the rows of cells that the density covers, in all sectors.
template <int dim>
using StrainVisitor = std::function<void(int, double, const MaterialLaw<dim>&, const Voigt<dim>&)>;
template <int dim>
void for_each_strain(const StateSolver<dim>& solver, const State<dim>& state,
                     const MaterialDensity<dim>& covered, const StrainVisitor<dim>& visit);

/// Calls visit(load case, point of the cell, strain) for some points of a cell; load case = position *
/// n_sectors
/// + sector.
template <int dim, class Visit>
void for_each_strain(const Matrix& strains, Visit visit) {
  for (int load_case = 0; load_case < strains.columns(); ++load_case)
    for (int q = 0; q < strains.rows() / n_strains<dim>; ++q) {
      Voigt<dim> strain;
      std::copy_n(strains.column(load_case) + n_strains<dim> * q, n_strains<dim>, strain.begin());
      visit(load_case, q, strain);
    }
}

}  // namespace wheelwright
