#pragma once

#include <span>
#include <vector>

#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// Area of {psi < 0} in one sector [m^2], or its volume [m^3] when dim = 3, by cut quadrature on
/// isoparametric cells of the degree of the level set. NaN if psi is not finite or the quadrature of a cell
/// fails.
template <int dim>
double material_measure(const LevelSet<dim>& psi);

/// The same from a shape's quadrature, on the isoparametric cells of degree `map_degree`.
template <int dim>
double material_measure(const CutDomain<dim>& domain, int map_degree);

/// The parts of it in every annulus of rows: `annulus_of_row` gives the annulus of every radial row of cells,
/// from 0.
template <int dim>
std::vector<double> measures_by_annulus(const CutDomain<dim>& domain, int map_degree,
                                        std::span<const int> annulus_of_row);

/// Quadrature points on {psi = 0} in one sector, with the value 1. Their weights add up to the length of the
/// boundary [m], or to its area [m^2] when dim = 3.
template <int dim>
std::vector<SurfaceSample<dim>> boundary_samples(const LevelSet<dim>& psi);

}  // namespace wheelwright
