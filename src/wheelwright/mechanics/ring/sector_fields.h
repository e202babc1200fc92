#pragma once

#include "wheelwright/mechanics/ring/cyclic_stiffness.h"

namespace wheelwright {

/// Fields of the core, displacements or loads, in all load cases (right-hand side and sector, numbered as the
/// columns of CyclicStiffness' boundary vectors), in a low-rank basis. Far from the contact all load cases
/// are similar: they are combinations of a few modes, and only the modes are swept through the factor.
struct SectorFields {
  Matrix modes;    ///< one row per mode, one column per unknown in elimination order
  Matrix weights;  ///< one row per load case, one column per mode

  bool empty() const { return modes.rows() == 0; }
  double value(int load_case, int unknown) const {
    double sum = 0;
    for (int k = 0; k < modes.rows(); ++k) sum += weights(load_case, k) * modes(k, unknown);
    return sum;
  }
};

/// Condenses loads in the core to boundary loads of the ring, in place as in PartialCholesky::eliminate.
template <int dim>
Matrix condense(const CyclicStiffness<dim>& ring, const PartialCholesky::Sweep& sweep, SectorFields& loads);

/// Relative truncation tolerance of the basis: bound on the boundary displacement that the modes do not
/// represent, relative to the largest one.
constexpr double mode_tolerance = 1e-10;

/// The displacements for boundary displacements (n_boundary x load cases) and loads as returned by condense()
/// (may be empty). Valid only at unknowns visited by the sweep; zero at interior unknowns that it skips.
/// With M the diagonal matrix of the load cases' multiplicities (> 0), the weights W are orthonormal,
/// W^T M W = 1, so that the sum of a quadratic form over the load cases, weighted by multiplicity, is its sum
/// over the modes. The columns of the loads' weights are combinations of those of W.
template <int dim>
SectorFields displacement_fields(const CyclicStiffness<dim>& ring, const PartialCholesky::Sweep& sweep,
                                 const Matrix& boundary, const SectorFields& eliminated_loads,
                                 std::span<const double> multiplicities);

/// Displacements without loads in the core, in all unknowns.
template <int dim>
SectorFields completed(const CyclicStiffness<dim>& ring, SectorFields displacements);

/// The sweep through the unknowns that the shape gradient and the loads need: cells at the moving boundary,
/// cells of the ghost penalty, and loaded unknowns.
template <int dim>
PartialCholesky::Sweep boundary_sweep(const CyclicStiffness<dim>& ring, const CutDomain<dim>& domain,
                                      const SectorFields& loads);

/// Rows of fields at the unknowns of a few nodes (zero for fixed ones, -1); `local` has one column per nodal
/// component.
template <int dim>
void gather(const CyclicStiffness<dim>& ring, std::span<const int> nodes, const Matrix& fields,
            Matrix& local);

/// The ghost penalty (81) applied to displacements, one per row.
template <int dim>
Matrix ghost_loads(const CyclicStiffness<dim>& ring, const Matrix& displacements);

/// The work of loads on displacements in every load case.
std::vector<double> work_by_case(const SectorFields& loads, const SectorFields& displacements);

/// Residual of the interior equations K v = loads, relative to their largest terms, for one combination of
/// all load cases. Only equations are tested whose unknowns are all visited by the sweep. NaN if one of their
/// numbers is NaN.
template <int dim>
double interior_residual(const CyclicStiffness<dim>& ring, const PartialCholesky::Sweep& sweep,
                         const SectorFields& displacements, const SectorFields& loads);

}  // namespace wheelwright
