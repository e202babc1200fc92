#include "contact/tread_ring.h"

#include <algorithm>

namespace wheelwright {
namespace {

int wrap(int column, int n_columns) { return (column % n_columns + n_columns) % n_columns; }

/// The columns of `field` that hold something, for one right-hand side.
std::vector<int> loaded_columns(const Matrix& field, int first, int n_columns) {
  std::vector<int> loaded;
  for (int c = 0; c < n_columns; ++c) {
    const double* x = field.column(first + c);
    if (std::any_of(x, x + field.rows(), [](double v) { return v != 0; })) loaded.push_back(c);
  }
  return loaded;
}

/// result(:, c + d) += op(kernel(d)) field(:, c) for one right-hand side.
template <class Kernel>
void spread(const Kernel& kernel, Op op, int reach, int sign, const Matrix& field, int first, int n_columns,
            Matrix& result) {
  const auto loaded = loaded_columns(field, first, n_columns);
  if (loaded.empty()) return;
  Matrix source(field.rows(), static_cast<int>(loaded.size())), target(result.rows(), source.columns());
  for (int k = 0; k < source.columns(); ++k)
    std::copy_n(field.column(first + loaded[k]), field.rows(), source.column(k));
  for (int d = -reach; d <= reach; ++d) {
    multiply(1, kernel(d), op, source, Op::none, 0, target);
    for (int k = 0; k < source.columns(); ++k) {
      double* to = result.column(first + wrap(loaded[k] + sign * d, n_columns));
      const double* from = target.column(k);
      for (int i = 0; i < target.rows(); ++i) to[i] += from[i];
    }
  }
}

}  // namespace

template <int dim>
Matrix base_loads(const Tread<dim>& tread, const Matrix& observation_loads) {
  const int n = tread.n_columns(), n_base = tread.n_base(), per_column = tread.base_per_column();
  Matrix by_column(n_base, observation_loads.columns());
  const auto kernel = [&](int d) -> const Matrix& { return tread.transfer(d); };
  for (int first = 0; first < observation_loads.columns(); first += n)
    spread(kernel, Op::transpose, tread.reach(), -1, observation_loads, first, n, by_column);

  Matrix result(per_column, observation_loads.columns());
  for (int first = 0; first < result.columns(); first += n)
    for (int c = 0; c < n; ++c)
      for (int i = 0; i < n_base; ++i)
        result(i % per_column, first + wrap(c + i / per_column, n)) += by_column(i, first + c);
  return result;
}

namespace {

/// Responses of all columns to displacements of the outer line and observation loads.
template <int dim, class Transfer, class Compliance>
Matrix respond(const Tread<dim>& tread, const Transfer& transfer, const Compliance& compliance,
               const Matrix& outer_line, const Matrix& observation_loads) {
  const int n = tread.n_columns(), n_base = tread.n_base(), per_column = tread.base_per_column();
  Matrix base(n_base, outer_line.columns());
  for (int first = 0; first < base.columns(); first += n)
    for (int c = 0; c < n; ++c)
      for (int i = 0; i < n_base; ++i)
        base(i, first + c) = outer_line(i % per_column, first + wrap(c + i / per_column, n));

  Matrix result(transfer(0).rows(), outer_line.columns());
  for (int first = 0; first < result.columns(); first += n) {
    spread(transfer, Op::none, tread.reach(), 1, base, first, n, result);
    spread(compliance, Op::none, tread.reach(), 1, observation_loads, first, n, result);
  }
  return result;
}

}  // namespace

template <int dim>
Matrix observe(const Tread<dim>& tread, const Matrix& outer_line, const Matrix& observation_loads) {
  const auto transfer = [&](int d) -> const Matrix& { return tread.transfer(d); };
  const auto compliance = [&](int d) -> const Matrix& { return tread.compliance(d); };
  return respond(tread, transfer, compliance, outer_line, observation_loads);
}

template <int dim>
Matrix nodal_displacements(const Tread<dim>& tread, const Matrix& outer_line,
                           const Matrix& observation_loads) {
  const auto transfer = [&](int d) -> const Matrix& { return tread.nodal_transfer(d); };
  const auto compliance = [&](int d) -> const Matrix& { return tread.nodal_compliance(d); };
  return respond(tread, transfer, compliance, outer_line, observation_loads);
}

template Matrix base_loads(const Tread<2>&, const Matrix&);
template Matrix base_loads(const Tread<3>&, const Matrix&);
template Matrix observe(const Tread<2>&, const Matrix&, const Matrix&);
template Matrix observe(const Tread<3>&, const Matrix&, const Matrix&);
template Matrix nodal_displacements(const Tread<2>&, const Matrix&, const Matrix&);
template Matrix nodal_displacements(const Tread<3>&, const Matrix&, const Matrix&);

}  // namespace wheelwright
