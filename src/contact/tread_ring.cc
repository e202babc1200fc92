#include "contact/tread_ring.h"

#include <algorithm>

#include "base/periodic.h"

namespace wheelwright {
namespace {

/// Rows of a column's retained unknowns: its base, its first line, its last line, by ring column.
Matrix retained(const Matrix& base, const Matrix& lines, int n_columns) {
  const int n_base = base.rows(), n_line = lines.rows();
  Matrix result(n_base + 2 * n_line, base.columns());
  for (int first = 0; first < base.columns(); first += n_columns)
    for (int c = 0; c < n_columns; ++c) {
      double* to = result.column(first + c);
      std::copy_n(base.column(first + c), n_base, to);
      std::copy_n(lines.column(first + c), n_line, to + n_base);
      std::copy_n(lines.column(first + wrap(c + 1, n_columns)), n_line, to + n_base + n_line);
    }
  return result;
}

/// Sums loads on columns' first and last lines into loads on lines.
template <int dim>
Matrix collect_line_loads(const Tread<dim>& tread, const Matrix& retained_loads) {
  const int n = tread.n_columns(), n_base = tread.n_base(), n_line = tread.n_line();
  Matrix result(n_line, retained_loads.columns());
  for (int first = 0; first < result.columns(); first += n)
    for (int c = 0; c < n; ++c)
      for (int side = 0; side < 2; ++side)
        for (int i = 0; i < n_line; ++i)
          result(i, first + wrap(c + side, n)) += retained_loads(n_base + side * n_line + i, first + c);
  return result;
}

/// The part of vectors on the outer line that belongs to an angular cell: column = rhs * n_columns + ring
/// column.
template <class OuterLine>
auto column_part(OuterLine& outer, int column, int per_column) {
  return outer.data() + size_t(column) * per_column;
}

}  // namespace

template <int dim>
Matrix base_loads(const Tread<dim>& tread, const Matrix& observation_loads) {
  const int n = tread.n_columns(), n_base = tread.n_base(), per_column = tread.base_per_column();
  const TreadColumn<dim>& column = tread.column();
  Matrix loads = product(column.observation, Op::transpose, observation_loads, Op::none);
  const Matrix lines = tread.lines().solve(collect_line_loads(tread, loads));
  // The base feels its own loads less what it takes to hold it while the lines move.
  const Matrix moved = retained(Matrix(n_base, loads.columns()), lines, n);
  multiply(-1, column.stiffness, Op::none, moved, Op::none, 1, loads);
  const int period = tread.columns_per_sector();
  Matrix result(period * per_column, loads.columns() / period);
  for (int first = 0; first < loads.columns(); first += n)
    for (int c = 0; c < n; ++c)
      for (int i = 0; i < n_base; ++i)
        column_part(result, first + wrap(c + i / per_column, n), per_column)[i % per_column] +=
            loads(i, first + c);
  return result;
}

template <int dim>
TreadField tread_field(const Tread<dim>& tread, const Matrix& outer, const Matrix& observation_loads) {
  const int n = tread.n_columns(), n_base = tread.n_base(), per_column = tread.base_per_column();
  const TreadColumn<dim>& column = tread.column();
  const int n_fields = outer.columns() * tread.columns_per_sector();
  TreadField field{Matrix(n_base, n_fields), {}, {}};
  for (int first = 0; first < n_fields; first += n)
    for (int c = 0; c < n; ++c)
      for (int i = 0; i < n_base; ++i)
        field.base(i, first + c) =
            column_part(outer, first + wrap(c + i / per_column, n), per_column)[i % per_column];

  Matrix loads = product(column.observation, Op::transpose, observation_loads, Op::none);
  const Matrix held = retained(field.base, Matrix(tread.n_line(), n_fields), n);
  multiply(-1, column.stiffness, Op::none, held, Op::none, 1, loads);
  field.lines = tread.lines().solve(collect_line_loads(tread, loads));
  field.observations = product(column.observation, Op::none, retained(field.base, field.lines, n), Op::none);
  multiply(1, column.compliance, Op::none, observation_loads, Op::none, 1, field.observations);
  return field;
}

template <int dim>
Matrix nodal_displacements(const Tread<dim>& tread, const TreadField& field,
                           const Matrix& observation_loads) {
  Matrix result =
      product(tread.column().nodal, Op::none, retained(field.base, field.lines, tread.n_columns()), Op::none);
  multiply(1, tread.column().nodal_compliance, Op::none, observation_loads, Op::none, 1, result);
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                \
  template Matrix base_loads(const Tread<dim>&, const Matrix&);                     \
  template TreadField tread_field(const Tread<dim>&, const Matrix&, const Matrix&); \
  template Matrix nodal_displacements(const Tread<dim>&, const TreadField&, const Matrix&);
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
