#include "wheelwright/ring/cyclic_stiffness.h"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/periodic.h"
#include "wheelwright/ring/nested_dissection.h"

namespace wheelwright {
namespace {

/// The boundary nodes of a sector, at their positions in the sector's own period, and its interior nodes.
template <int dim>
struct BoundaryLayout {
  std::vector<std::array<int, dim>> interface_nodes;  ///< not on the outer line
  std::vector<int> interior_nodes, trailing_nodes;    ///< node numbers
};

template <int dim>
BoundaryLayout<dim> boundary_layout(const SectorSpace<dim>& space) {
  const int period = space.degree() * space.grid().cells[1], outer = space.degree() * space.core_rows();
  std::vector<char> trailing(space.n_nodes(), 0);
  BoundaryLayout<dim> layout;
  for (int node = 0; node < space.n_nodes(); ++node) {
    auto p = space.position(node);
    if (p[0] == outer) trailing[node] = 1;
    if (p[1] < period) continue;
    trailing[node] = 1;
    p[1] %= period;
    if (p[0] == outer) continue;
    layout.interface_nodes.push_back(p);
    if (const int own = space.number(p); own >= 0) trailing[own] = 1;
  }
  for (int node = 0; node < space.n_nodes(); ++node)
    (trailing[node] ? layout.trailing_nodes : layout.interior_nodes).push_back(node);
  return layout;
}

template <class Scalar>
DenseMatrix<Scalar> stacked(const DenseMatrix<Scalar>& top, const DenseMatrix<Scalar>& bottom) {
  auto result = DenseMatrix<Scalar>::unfilled(top.rows() + bottom.rows(), top.columns());
  for (int j = 0; j < top.columns(); ++j) {
    std::copy_n(top.column(j), top.rows(), result.column(j));
    std::copy_n(bottom.column(j), bottom.rows(), result.column(j) + top.rows());
  }
  return result;
}

}  // namespace

template <int dim>
CyclicStiffness<dim>::CyclicStiffness(SectorStiffness<dim> sector, PartialCholesky sector_factor,
                                      const SectorHarmonics& harmonics)
    : sector_(std::move(sector)), sector_factor_(std::move(sector_factor)), harmonics_(harmonics) {}

template <int dim>
Expected<CyclicStiffness<dim>> CyclicStiffness<dim>::factor(SectorStiffness<dim> sector,
                                                            std::span<const ComplexMatrix> outer_stiffness,
                                                            const SectorHarmonics& harmonics) {
  const BoundaryLayout<dim> layout = boundary_layout(sector.space);
  std::vector<int> nodes = nested_dissection(sector, layout.interior_nodes);
  nodes.insert(nodes.end(), layout.trailing_nodes.begin(), layout.trailing_nodes.end());
  auto factored =
      PartialCholesky::factor(sector.matrix, dim, nodes, static_cast<int>(layout.trailing_nodes.size()));
  if (!factored) return factored.failure();
  CyclicStiffness ring(std::move(sector), *std::move(factored), harmonics);
  ring.row_.resize(dim * nodes.size());
  for (int k = 0; k < static_cast<int>(nodes.size()); ++k)
    for (int c = 0; c < dim; ++c) ring.row_[dim * nodes[k] + c] = dim * k + c;

  const SectorSpace<dim>& own_space = ring.sector_.space;
  const PolarGrid<dim>& grid = own_space.grid();
  const int period = own_space.degree() * grid.cells[1], outer = own_space.degree() * own_space.core_rows();
  int axial_nodes = 1;
  if constexpr (dim == 3) axial_nodes = own_space.degree() * grid.cells[2] + 1;
  std::map<std::array<int, dim>, int> interface_index;
  for (const auto& p : layout.interface_nodes)
    interface_index.emplace(p, static_cast<int>(interface_index.size()));
  const int n_interface = dim * static_cast<int>(interface_index.size());
  ring.n_outer_ = dim * period * axial_nodes;
  ring.n_boundary_ = n_interface + ring.n_outer_;
  for (int node : layout.trailing_nodes) {
    auto p = own_space.position(node);
    const int shift = p[1] / period;
    p[1] %= period;
    int first;
    if (p[0] == outer) {
      int line = p[1];
      if constexpr (dim == 3) line = line * axial_nodes + p[2];
      first = n_interface + dim * line;
    } else {
      first = dim * interface_index.at(p);
    }
    for (int c = 0; c < dim; ++c) ring.trailing_.push_back({first + c, shift});
  }

  const CoupledSectors coupled = ring.couple_sectors();
  ComplexMatrix outer_inverse(ring.n_outer_ * ring.n_outer_, harmonics.n_harmonics());
  std::vector<std::optional<TwoBlockCholesky>> factors(harmonics.n_harmonics());
  parallel_for(harmonics.n_harmonics(), [&](int h) {
    ComplexMatrix k = coupled.of_harmonic(harmonics, h);
    for (int j = 0; j < ring.n_outer_; ++j)
      for (int i = j; i < ring.n_outer_; ++i) k(n_interface + i, n_interface + j) += outer_stiffness[h](i, j);
    factors[h] = TwoBlockCholesky::factor(std::move(k), n_interface);
    if (!factors[h]) return;
    const ComplexMatrix inverse = factors[h]->last_block_of_inverse();
    std::copy(inverse.entries().begin(), inverse.entries().end(), outer_inverse.column(h));
  });
  for (int h = 0; h < harmonics.n_harmonics(); ++h) {
    if (!factors[h])
      return Failure{FailureReason::not_positive_definite,
                     fmt::format("the ring's stiffness is not positive definite for harmonic {}", h)};
    ring.harmonic_factors_.push_back(*std::move(factors[h]));
  }
  for (auto& x : outer_inverse.entries()) x /= harmonics.n_sectors();
  const Matrix by_difference = harmonics.backward(outer_inverse);
  for (int d = 0; d < harmonics.n_sectors(); ++d) {
    Matrix block(ring.n_outer_, ring.n_outer_);
    std::copy_n(by_difference.column(d), block.entries().size(), block.data());
    ring.outer_compliance_.push_back(std::move(block));
  }
  return ring;
}

/// The condensed stiffness of a sector, split by the number of sectors that the second unknown is ahead of
/// the first.
template <int dim>
typename CyclicStiffness<dim>::CoupledSectors CyclicStiffness<dim>::couple_sectors() const {
  int farthest = 0;
  for (const Trailing& t : trailing_) farthest = std::max(farthest, t.shift);
  CoupledSectors coupled{farthest, std::vector<Matrix>(2 * farthest + 1, Matrix(n_boundary_, n_boundary_))};
  const Matrix& schur = sector_factor_.schur();
  for (int j = 0; j < schur.columns(); ++j)
    for (int i = 0; i < schur.rows(); ++i)
      coupled.by_difference[trailing_[j].shift - trailing_[i].shift + farthest](
          trailing_[i].boundary, trailing_[j].boundary) += schur(i, j);
  return coupled;
}

/// The lower triangle of the ring's stiffness for one harmonic.
template <int dim>
ComplexMatrix CyclicStiffness<dim>::CoupledSectors::of_harmonic(const SectorHarmonics& harmonics,
                                                                int harmonic) const {
  const int n = by_difference.front().rows();
  ComplexMatrix k(n, n);
  for (int d = -farthest; d <= farthest; ++d) {
    const std::complex<double> phase = harmonics.phase(harmonic, d);
    const Matrix& real = by_difference[d + farthest];
    for (int j = 0; j < n; ++j)
      for (int i = j; i < n; ++i) k(i, j) += phase * real(i, j);
  }
  return k;
}

template <int dim>
const Matrix& CyclicStiffness<dim>::outer_compliance(int difference) const {
  const int n = n_sectors();
  return outer_compliance_[wrap(difference, n)];
}

template <int dim>
Matrix CyclicStiffness<dim>::boundary_loads(const Matrix& trailing_loads) const {
  const int n = n_sectors();
  Matrix boundary(n_boundary_, trailing_loads.rows());
  parallel_for(boundary.columns() / n, [&](int rhs) {
    for (size_t t = 0; t < trailing_.size(); ++t) {
      const double* load = trailing_loads.column(static_cast<int>(t)) + rhs * n;
      for (int s = 0; s < n; ++s)
        boundary(trailing_[t].boundary, rhs * n + (s + trailing_[t].shift) % n) += load[s];
    }
  });
  return boundary;
}

template <int dim>
typename CyclicStiffness<dim>::EliminatedInterface CyclicStiffness<dim>::eliminate_interface(
    const Matrix& boundary_loads) const {
  const int n_interface = n_boundary_ - n_outer_;
  EliminatedInterface result{harmonics_.forward_each(boundary_loads), {}};
  std::vector<ComplexMatrix> outer(harmonics_.n_harmonics());
  parallel_for(harmonics_.n_harmonics(), [&](int h) {
    ComplexMatrix& loads = result.interface[h];
    harmonic_factors_[h].eliminate(loads);
    outer[h] = block(loads, n_interface, 0, n_outer_, loads.columns());
    loads = block(loads, 0, 0, n_interface, loads.columns());
  });
  result.outer = harmonics_.backward_each(outer);
  return result;
}

template <int dim>
Matrix CyclicStiffness<dim>::outer_displacements(const Matrix& condensed_loads) const {
  std::vector<ComplexMatrix> outer = harmonics_.forward_each(condensed_loads);
  parallel_for(harmonics_.n_harmonics(), [&](int h) { harmonic_factors_[h].solve_last(outer[h]); });
  return harmonics_.backward_each(outer);
}

template <int dim>
Matrix CyclicStiffness<dim>::boundary_displacements(const Matrix& outer,
                                                    const std::vector<ComplexMatrix>& interface) const {
  const int n_interface = n_boundary_ - n_outer_;
  std::vector<ComplexMatrix> x = harmonics_.forward_each(outer);
  parallel_for(harmonics_.n_harmonics(), [&](int h) {
    x[h] = stacked(interface.empty() ? ComplexMatrix(n_interface, x[h].columns()) : interface[h], x[h]);
    harmonic_factors_[h].substitute(x[h]);
    x[h] = block(x[h], 0, 0, n_interface, x[h].columns());
  });
  return stacked(harmonics_.backward_each(x), outer);
}

template <int dim>
Matrix CyclicStiffness<dim>::trailing_displacements(const Matrix& boundary) const {
  const int n = n_sectors();
  auto trailing = Matrix::unfilled(boundary.columns(), static_cast<int>(trailing_.size()));
  parallel_for(boundary.columns() / n, [&](int rhs) {
    for (size_t t = 0; t < trailing_.size(); ++t) {
      double* displacement = trailing.column(static_cast<int>(t)) + rhs * n;
      for (int s = 0; s < n; ++s)
        displacement[s] = boundary(trailing_[t].boundary, rhs * n + (s + trailing_[t].shift) % n);
    }
  });
  return trailing;
}

template class CyclicStiffness<2>;
template class CyclicStiffness<3>;

}  // namespace wheelwright
