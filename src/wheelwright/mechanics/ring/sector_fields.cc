#include "wheelwright/mechanics/ring/sector_fields.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/linalg/column_basis.h"

namespace wheelwright {
namespace {

/// (a, scale b), side by side.
Matrix side_by_side(const Matrix& a, double scale, const Matrix& b) {
  Matrix result(a.rows(), a.columns() + b.columns());
  std::copy(a.entries().begin(), a.entries().end(), result.data());
  std::transform(b.entries().begin(), b.entries().end(), result.column(a.columns()),
                 [&](double x) { return scale * x; });
  return result;
}

/// One combination of all load cases, by unknowns. An error of one case, or of one harmonic of the sectors,
/// does not cancel in it, as it would in their sum.
Matrix combined(const SectorFields& fields) {
  Matrix combination(fields.weights.rows(), 1);
  for (int j = 0; j < combination.rows(); ++j) combination(j, 0) = std::cos(j);
  const Matrix weights = product(fields.weights, Op::transpose, combination, Op::none);
  return product(fields.modes, Op::transpose, weights, Op::none);
}

/// The larger of two numbers; NaN if one of them is.
double larger(double a, double b) { return a >= b || std::isnan(a) ? a : b; }

}  // namespace

template <int dim>
Matrix condense(const CyclicStiffness<dim>& ring, const PartialCholesky::Sweep& sweep, SectorFields& loads) {
  const PartialCholesky& factor = ring.sector_factor();
  factor.eliminate(sweep, loads.modes);
  const Matrix trailing = block(loads.modes, 0, factor.n_interior(), loads.modes.rows(), factor.n_trailing());
  return ring.boundary_loads(product(loads.weights, Op::none, trailing, Op::none));
}

template <int dim>
SectorFields displacement_fields(const CyclicStiffness<dim>& ring, const PartialCholesky::Sweep& sweep,
                                 const Matrix& boundary, const SectorFields& eliminated_loads,
                                 std::span<const double> multiplicities) {
  const PartialCholesky& factor = ring.sector_factor();
  const int n_interior = factor.n_interior(), n_trailing = factor.n_trailing();
  std::vector<double> roots, inverse_roots;
  for (const double m : multiplicities) {
    roots.push_back(std::sqrt(m));
    inverse_roots.push_back(1 / roots.back());
  }
  const Matrix trailing = scaled_rows(roots, ring.trailing_displacements(boundary));
  const Matrix load_weights = scaled_rows(roots, eliminated_loads.weights);
  const double scale = eliminated_loads.empty() ? 1 : largest_entry(trailing) / largest_entry(load_weights);
  ColumnBasis basis = column_basis(
      eliminated_loads.empty() ? trailing : side_by_side(trailing, scale, load_weights), mode_tolerance);

  SectorFields fields{Matrix(basis.coordinates.rows(), factor.size()),
                      scaled_rows(inverse_roots, std::move(basis.basis))};
  if (!eliminated_loads.empty()) {
    Matrix coordinates =
        block(basis.coordinates, 0, n_trailing, basis.coordinates.rows(), load_weights.columns());
    multiply(1 / scale, coordinates, Op::none, eliminated_loads.modes, Op::none, 0, fields.modes);
  }
  std::copy_n(basis.coordinates.data(), size_t(fields.modes.rows()) * n_trailing,
              fields.modes.column(n_interior));
  factor.substitute(sweep, fields.modes);
  return fields;
}

template <int dim>
SectorFields completed(const CyclicStiffness<dim>& ring, SectorFields displacements) {
  const PartialCholesky& factor = ring.sector_factor();
  Matrix& modes = displacements.modes;
  std::fill_n(modes.data(), size_t(modes.rows()) * factor.n_interior(), 0.0);
  factor.substitute(factor.full_sweep(), modes);
  return displacements;
}

template <int dim>
PartialCholesky::Sweep boundary_sweep(const CyclicStiffness<dim>& ring, const CutDomain<dim>& domain,
                                      const SectorFields& loads) {
  std::vector<char> marked(ring.sector_factor().size(), 0);
  const auto mark = [&](std::span<const int> nodes) {
    for (const int node : nodes)
      for (int c = 0; c < dim && node >= 0; ++c) marked[ring.row(dim * node + c)] = 1;
  };
  for (const CutCell<dim>& cut : domain.cut) mark(ring.sector().space.cell_nodes(cut.cell));
  for (const auto& ghost : ring.sector().ghosts) mark(ghost.nodes);
  for (const int loaded : nonzero_columns(loads.modes)) marked[loaded] = 1;
  return ring.sector_factor().sweep_through(marked);
}

template <int dim>
void gather(const CyclicStiffness<dim>& ring, std::span<const int> nodes, const Matrix& fields,
            Matrix& local) {
  for (size_t a = 0; a < nodes.size(); ++a)
    for (int c = 0; c < dim; ++c) {
      double* to = local.column(dim * static_cast<int>(a) + c);
      if (nodes[a] < 0)
        std::fill_n(to, fields.rows(), 0.0);
      else
        std::copy_n(fields.column(ring.row(dim * nodes[a] + c)), fields.rows(), to);
    }
}

template <int dim>
Matrix ghost_loads(const CyclicStiffness<dim>& ring, const Matrix& displacements) {
  const int n = displacements.rows();
  Matrix result(n, displacements.columns());
  Matrix local, applied;
  for (const auto& ghost : ring.sector().ghosts) {
    const int n_local = dim * static_cast<int>(ghost.nodes.size());
    if (local.columns() != n_local) local = applied = Matrix(n, n_local);
    gather(ring, ghost.nodes, displacements, local);
    multiply(1, local, Op::none, *ghost.stiffness, Op::none, 0, applied);
    for (int i = 0; i < n_local; ++i) {
      const int node = ghost.nodes[i / dim];
      if (node < 0) continue;
      double* to = result.column(ring.row(dim * node + i % dim));
      const double* from = applied.column(i);
      for (int k = 0; k < n; ++k) to[k] += from[k];
    }
  }
  return result;
}

std::vector<double> work_by_case(const SectorFields& loads, const SectorFields& displacements) {
  const auto loaded = nonzero_columns(loads.modes);
  const Matrix work_of_modes = product(selected_columns(loads.modes, loaded), Op::none,
                                       selected_columns(displacements.modes, loaded), Op::transpose);
  const Matrix on_modes = product(loads.weights, Op::none, work_of_modes, Op::none);
  std::vector<double> work(on_modes.rows(), 0.0);
  for (int k = 0; k < on_modes.columns(); ++k)
    for (int j = 0; j < on_modes.rows(); ++j) work[j] += on_modes(j, k) * displacements.weights(j, k);
  return work;
}

template <int dim>
double interior_residual(const CyclicStiffness<dim>& ring, const PartialCholesky::Sweep& sweep,
                         const SectorFields& displacements, const SectorFields& loads) {
  const SparseSymmetric& k = ring.sector().matrix;
  const Matrix field = combined(displacements);
  const Matrix load = loads.empty() ? Matrix(field.rows(), 1) : combined(loads);
  std::vector<double> x(k.size), force(k.size, 0.0);
  std::vector<char> is_known(k.size);
  double largest_displacement = 0, largest_stiffness = 0;
  for (int dof = 0; dof < k.size; ++dof) {
    const int row = ring.row(dof);
    x[dof] = field(row, 0);
    is_known[dof] = row < ring.sector_factor().n_interior() && sweep.visited[row];
    largest_displacement = larger(largest_displacement, std::abs(x[dof]));
    largest_stiffness = larger(largest_stiffness, k.values[k.column_start[dof]]);
  }
  for (int j = 0; j < k.size; ++j)
    for (int e = k.column_start[j]; e < k.column_start[j + 1]; ++e) {
      const int i = k.rows[e];
      if (!sweep.visited[ring.row(i)]) is_known[j] = 0;
      if (!sweep.visited[ring.row(j)]) is_known[i] = 0;
    }
  k.add_product(x.data(), force.data());
  double largest_force = 0;
  for (int dof = 0; dof < k.size; ++dof) {
    if (!is_known[dof]) continue;
    largest_force = larger(largest_force, std::abs(force[dof] - load(ring.row(dof), 0)));
  }
  return largest_force / (largest_stiffness * largest_displacement);
}

template decltype(condense<2>) condense<2>;
template decltype(displacement_fields<2>) displacement_fields<2>;
template decltype(completed<2>) completed<2>;
template decltype(boundary_sweep<2>) boundary_sweep<2>;
template decltype(gather<2>) gather<2>;
template decltype(ghost_loads<2>) ghost_loads<2>;
template decltype(interior_residual<2>) interior_residual<2>;
template decltype(condense<3>) condense<3>;
template decltype(displacement_fields<3>) displacement_fields<3>;
template decltype(completed<3>) completed<3>;
template decltype(boundary_sweep<3>) boundary_sweep<3>;
template decltype(gather<3>) gather<3>;
template decltype(ghost_loads<3>) ghost_loads<3>;
template decltype(interior_residual<3>) interior_residual<3>;

}  // namespace wheelwright
