#pragma once

#include "wheelwright/ring/cyclic_stiffness.h"

namespace wheelwright {

/// Fields of the core, displacements or loads, in all load cases (right-hand side and sector, numbered as the
/// columns of CyclicStiffness' boundary vectors). Far from the contact all cases look alike: they are
/// combinations of a few modes, and only modes are swept through the factor.
struct SectorFields {
  Matrix modes;    ///< one row a mode, one column an unknown in elimination order
  Matrix weights;  ///< one row a load case, one column a mode

  bool empty() const { return modes.rows() == 0; }
  double value(int load_case, int unknown) const {
    double sum = 0;
    for (int k = 0; k < modes.rows(); ++k) sum += weights(load_case, k) * modes(k, unknown);
    return sum;
  }
};

/// Loads in the core, in place as PartialCholesky::eliminate leaves them, to boundary loads of the ring.
template <int dim>
Matrix condense(const CyclicStiffness<dim>& ring, const PartialCholesky::Sweep& sweep, SectorFields& loads);

/// What bounds the remainder of a displacement on the sector's boundary that is left out of the modes,
/// relative to the largest.
constexpr double mode_tolerance = 1e-10;

/// The displacements for boundary displacements (n_boundary x load cases) and loads as condense() leaves them
/// (may be empty). Right in the unknowns that the sweep visits; zero in the interior ones that it does not.
/// With M the diagonal matrix of the load cases' multiplicities (> 0), the weights W are orthonormal, W^T M W
/// = 1, so that a quadratic form's sum over the load cases, each as often as it counts, is its sum over the
/// modes; and the columns of the loads' weights are combinations of those of W.
template <int dim>
SectorFields displacement_fields(const CyclicStiffness<dim>& ring, const PartialCholesky::Sweep& sweep,
                                 const Matrix& boundary, const SectorFields& eliminated_loads,
                                 std::span<const double> multiplicities);

/// Displacements without loads in the core, in all unknowns.
template <int dim>
SectorFields completed(const CyclicStiffness<dim>& ring, SectorFields displacements);

/// Through what the shape gradient and the loads need: the cells at the moving boundary, those of the ghost
/// penalty, and loaded unknowns.
template <int dim>
PartialCholesky::Sweep boundary_sweep(const CyclicStiffness<dim>& ring, const CutDomain<dim>& domain,
                                      const SectorFields& loads);

/// Rows of fields in the unknowns of a few nodes (zero for fixed ones, -1): `local` has one column a nodal
/// component.
template <int dim>
void gather(const CyclicStiffness<dim>& ring, std::span<const int> nodes, const Matrix& fields,
            Matrix& local);

/// The ghost penalty (81) applied to displacements, one a row.
template <int dim>
Matrix ghost_loads(const CyclicStiffness<dim>& ring, const Matrix& displacements);

/// The work of loads on displacements in every load case.
std::vector<double> work_by_case(const SectorFields& loads, const SectorFields& displacements);

/// How far the interior equations K v = loads are from equality, relative to their largest terms: those of
/// them that know only unknowns of the sweep, for one combination of all load cases. NaN if one of their
/// numbers is.
template <int dim>
double interior_residual(const CyclicStiffness<dim>& ring, const PartialCholesky::Sweep& sweep,
                         const SectorFields& displacements, const SectorFields& loads);

}  // namespace wheelwright
