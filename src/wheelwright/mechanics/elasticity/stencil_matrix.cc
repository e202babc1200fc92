#include "wheelwright/mechanics/elasticity/stencil_matrix.h"

#include <algorithm>

namespace wheelwright {
namespace {

void clear_row_and_column(Matrix& a, int k) {
  for (int i = 0; i < a.rows(); ++i) a(i, k) = a(k, i) = 0;
}

}  // namespace

template <int dim>
StencilMatrix<dim>::StencilMatrix(Pattern pattern) : pattern_(std::move(pattern)) {
  const SectorSpace<dim>& space = *pattern_.space_;
  matrix_.size = space.n_dofs();
  matrix_.column_start.reserve(matrix_.size + 1);
  matrix_.column_start.push_back(0);
  for (int a = 0; a < space.n_nodes(); ++a) {
    int neighbours = 0;
    for (std::uint64_t word : pattern_.masks_[a]) neighbours += std::popcount(word);
    for (int c = 0; c < dim; ++c)
      matrix_.column_start.push_back(matrix_.column_start.back() + dim - c + dim * neighbours);
  }
  matrix_.rows.resize(matrix_.column_start.back());
  matrix_.values.assign(matrix_.column_start.back(), 0.0);

  const int reach = 2 * space.degree(), width = 2 * reach + 1;
  for (int a = 0; a < space.n_nodes(); ++a) {
    std::array<int, dim> next_entry;
    for (int c = 0; c < dim; ++c) {
      next_entry[c] = matrix_.column_start[space.dof(a, c)];
      for (int other = c; other < dim; ++other) matrix_.rows[next_entry[c]++] = space.dof(a, other);
    }
    for (int w = 0; w < static_cast<int>(pattern_.masks_[a].size()); ++w) {
      for (std::uint64_t word = pattern_.masks_[a][w]; word != 0; word &= word - 1) {
        int bit = 64 * w + std::countr_zero(word);
        auto p = space.position(a);
        p[0] += bit % width - reach;
        bit /= width;
        if constexpr (dim == 3) {
          p[2] += bit % width - reach;
          bit /= width;
        }
        p[1] += bit;
        const int b = space.number(p);
        for (int c = 0; c < dim; ++c)
          for (int other = 0; other < dim; ++other) matrix_.rows[next_entry[c]++] = space.dof(b, other);
      }
    }
  }
}

template <int dim>
bool StencilMatrix<dim>::holds_any(std::span<const int> nodes) const {
  return std::ranges::any_of(nodes, [&](int a) { return a >= 0 && pattern_.space_->is_held(a, dim - 1); });
}

template <int dim>
void StencilMatrix<dim>::hold(double stiffness) {
  const SectorSpace<dim>& space = *pattern_.space_;
  for (int a = 0; a < space.n_nodes(); ++a)
    for (int c = 0; c < dim; ++c)
      if (space.is_held(a, c) && space.position(a)[1] <= space.last_line())
        matrix_.values[matrix_.column_start[space.dof(a, c)]] = stiffness;
}

template <int dim>
void StencilMatrix<dim>::add(std::span<const int> nodes, const Matrix& given) {
  const int n = static_cast<int>(nodes.size());
  Matrix without_held;
  if (holds_any(nodes)) {
    without_held = given;
    for (int i = 0; i < n; ++i)
      for (int c = 0; c < dim; ++c)
        if (nodes[i] >= 0 && pattern_.space_->is_held(nodes[i], c))
          clear_row_and_column(without_held, SectorSpace<dim>::dof(i, c));
  }
  const Matrix& block = without_held.rows() > 0 ? without_held : given;
  const auto dof = SectorSpace<dim>::dof;
  for (int i = 0; i < n; ++i) {
    const int a = nodes[i];
    if (a < 0) continue;
    for (int j = 0; j < n; ++j) {
      const int b = nodes[j];
      if (b < a) continue;
      if (b == a) {
        for (int c = 0; c < dim; ++c)
          for (int other = c; other < dim; ++other)
            matrix_.values[matrix_.column_start[dof(a, c)] + other - c] += block(dof(j, other), dof(i, c));
        continue;
      }
      const int before = dim * couplings_before(a, slot(*pattern_.space_, a, b));
      for (int c = 0; c < dim; ++c) {
        double* entry = &matrix_.values[matrix_.column_start[dof(a, c)] + dim - c + before];
        for (int other = 0; other < dim; ++other) entry[other] += block(dof(j, other), dof(i, c));
      }
    }
  }
}

template class StencilMatrix<2>;
template class StencilMatrix<3>;

}  // namespace wheelwright
