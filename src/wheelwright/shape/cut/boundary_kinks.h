#pragma once

#include <functional>
#include <span>

#include "wheelwright/shape/cut/cut_domain.h"

namespace wheelwright {

/// The share of the kinks in the derivative of an integral int g ds over the moving boundary of psi, which
/// its curvature does not contain. The boundary is smooth inside of every cell and has a kink where it passes
/// a face between two of them. When the level set moves by dpsi, such a point (a line when dim = 3) adds
///   g N.(n_1 - n_2) dpsi / |grad psi in the face|,
/// with the normals n of the boundary in the two cells and the face's normal N out of the first one; where
/// the boundary ends at a side face, n_2 = 0. They are O(h^k) for a level set of degree k.
///
/// Returns densities at the given points of the boundary, which belong to psi's cells, in their order: with
/// the points' weights and the normal velocity -dpsi / |grad psi| their sum is the derivative for every dpsi
/// of psi's lattice. A kink belongs to the cell of the two that holds more of the boundary. `value`: g at a
/// point of the unit cell of a cell. `map_degree`: of the cells' geometry.
template <int dim>
std::vector<double> kink_densities(const LevelSet<dim>& psi, const CutDomain<dim>& domain, int map_degree,
                                   std::span<const SurfacePoint<dim>> points,
                                   const std::function<double(int cell, const Vec<dim>& xi)>& value);

/// Gauss points per direction in cut cells with which the boundary in a cell has as many points as there are
/// different polynomials of a degree on it. With fewer, kink_densities() cannot have the sums of all of them.
template <int dim>
int points_for_kinks(int degree);

}  // namespace wheelwright
