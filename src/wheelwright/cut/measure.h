#pragma once

#include <vector>

#include "wheelwright/cut/cut_domain.h"

namespace wheelwright {

/// Measure of {psi < 0} in one sector [m^2, or m^3 when dim = 3], by cut quadrature on the isoparametric
/// cells of the level set's own degree. NaN where psi is not finite or the quadrature of a cell fails.
template <int dim>
double material_measure(const LevelSet<dim>& psi);

/// The same from a shape's quadrature, on the isoparametric cells of degree `map_degree`.
template <int dim>
double material_measure(const CutDomain<dim>& domain, int map_degree);

/// Quadrature points of {psi = 0} in one sector: their weights add up to the boundary's measure; value is 1.
template <int dim>
std::vector<SurfaceSample<dim>> boundary_samples(const LevelSet<dim>& psi);

}  // namespace wheelwright
