#include "wheelwright/mechanics/ring/tread_ring.h"

#include <cassert>
#include <functional>
#include <numeric>

#include "wheelwright/base/parallel.h"

namespace wheelwright {
namespace {

/// The ring column after this one, of the same right-hand side.
int next_column(int column, int n_columns) {
  return (column + 1) % n_columns == 0 ? column + 1 - n_columns : column + 1;
}

/// Positions in outer-line vectors of an angular cell's own part and of the part of the next cell, with which
/// its base shares nodes.
template <int dim, class OuterLine>
auto base_parts(const Tread<dim>& tread, OuterLine& outer, int column) {
  const int per_column = tread.base_per_column();
  return std::pair(outer.data() + size_t(column) * per_column,
                   outer.data() + size_t(next_column(column, tread.n_columns())) * per_column);
}

/// Displacements of the first and last lines of a range of columns.
Matrix both_lines(const Matrix& lines, int first, int n, int n_columns) {
  const int n_line = lines.rows();
  auto result = Matrix::unfilled(2 * n_line, n);
  for (int c = 0; c < n; ++c) {
    std::copy_n(lines.column(first + c), n_line, result.column(c));
    std::copy_n(lines.column(next_column(first + c, n_columns)), n_line, result.column(c) + n_line);
  }
  return result;
}

/// Displacements of some columns' retained unknowns: base, first line, last line.
Matrix retained(const TreadField& field, std::span<const int> columns, int n_columns) {
  const int n_base = field.base.rows(), n_line = field.lines.rows();
  auto result = Matrix::unfilled(n_base + 2 * n_line, static_cast<int>(columns.size()));
  for (int k = 0; k < result.columns(); ++k) {
    double* to = result.column(k);
    std::copy_n(field.base.column(columns[k]), n_base, to);
    std::copy_n(field.lines.column(columns[k]), n_line, to + n_base);
    std::copy_n(field.lines.column(next_column(columns[k], n_columns)), n_line, to + n_base + n_line);
  }
  return result;
}

std::vector<int> iota(int first, int n) {
  std::vector<int> numbers(n);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

/// Adds loads on the first and last lines of `columns` (2 n_line rows from `first_row` on) to loads on lines.
void add_line_loads(const Matrix& loads, int first_row, std::span<const int> columns, int n_columns,
                    Matrix& line_loads) {
  const int n_line = line_loads.rows();
  for (int k = 0; k < loads.columns(); ++k) {
    const double* from = loads.column(k) + first_row;
    double *first = line_loads.column(columns[k]),
           *last = line_loads.column(next_column(columns[k], n_columns));
    for (int i = 0; i < n_line; ++i) first[i] += from[i];
    for (int i = 0; i < n_line; ++i) last[i] += from[n_line + i];
  }
}

/// Adds what loads (one column per entry of loads.columns) do, the retained unknowns fixed, to what is
/// observed in `columns`.
void add_response(const Matrix& compliance, Op op, const TreadLoads& loads, const Matrix& values,
                  std::span<const int> columns, Matrix& observed) {
  if (values.columns() == 0) return;
  std::vector<int> loaded, places;
  for (int k = 0; k < observed.columns(); ++k) {
    const auto found = std::lower_bound(loads.columns.begin(), loads.columns.end(), columns[k]);
    if (found == loads.columns.end() || *found != columns[k]) continue;
    loaded.push_back(static_cast<int>(found - loads.columns.begin()));
    places.push_back(k);
  }
  const Matrix response = product(compliance, op, selected_columns(values, loaded), Op::none);
  for (size_t k = 0; k < places.size(); ++k)
    for (int i = 0; i < response.rows(); ++i) observed(i, places[k]) += response(i, static_cast<int>(k));
}

/// Calls f(first, n) for ranges of n columns that are small enough for the cache.
void for_blocks(int n_columns, const std::function<void(int, int)>& f) {
  constexpr int size = 2048;
  parallel_for((n_columns + size - 1) / size,
               [&](int b) { f(b * size, std::min(size, n_columns - b * size)); });
}

}  // namespace

template <int dim>
TreadLoads tread_loads(const Tread<dim>& tread, const Matrix& observation_loads) {
  TreadLoads loads{.n_fields = observation_loads.columns(),
                   .columns = nonzero_columns(observation_loads),
                   .on_observations = {},
                   .on_nodes = {},
                   .on_retained = {}};
  const int n_loaded = static_cast<int>(loads.columns.size());
  loads.on_observations = selected_columns(observation_loads, loads.columns);
  loads.on_retained = Matrix::unfilled(tread.column().observation.columns(), n_loaded);
  for_blocks(n_loaded, [&](int first, int n) {
    multiply_columns(1, tread.column().observation, Op::transpose, loads.on_observations.column(first), n, 0,
                     loads.on_retained.column(first));
  });
  return loads;
}

template <int dim>
TreadLoads tread_loads(const Tread<dim>& tread, const TreadForces& forces) {
  if (forces.on_nodes.columns() == 0) return tread_loads(tread, forces.on_observations);
  const TreadColumn<dim>& column = tread.column();
  const int n_fields = forces.on_nodes.columns();
  TreadLoads loads{.n_fields = n_fields,
                   .columns = iota(0, n_fields),
                   .on_observations = forces.on_observations,
                   .on_nodes = forces.on_nodes,
                   .on_retained = product(column.nodal, Op::transpose, forces.on_nodes, Op::none)};
  if (loads.on_observations.columns() > 0)
    multiply(1, column.observation, Op::transpose, loads.on_observations, Op::none, 1, loads.on_retained);
  for (int c = 0; c < n_fields; ++c)
    for (int i = 0; i < column.n_base; ++i) loads.on_retained(i, c) += forces.on_base(i, c);
  return loads;
}

template <int dim>
Matrix base_loads(const Tread<dim>& tread, const TreadLoads& loads) {
  const int n_columns = tread.n_columns(), n_base = tread.n_base(), n_line = tread.n_line(),
            n_fields = loads.n_fields, period = tread.columns_per_sector();
  Matrix line_loads(n_line, n_fields);
  add_line_loads(loads.on_retained, n_base, loads.columns, n_columns, line_loads);
  const Matrix lines = tread.lines().solve(line_loads);

  // The load on the base is its own load minus the force that holds it while the lines move.
  const Matrix to_base = block(tread.column().stiffness, 0, n_base, n_base, 2 * n_line);
  auto on_base = Matrix::unfilled(n_base, n_fields);
  for_blocks(n_fields, [&](int first, int n) {
    multiply_columns(-1, to_base, Op::none, both_lines(lines, first, n, n_columns).data(), n, 0,
                     on_base.column(first));
  });
  for (size_t k = 0; k < loads.columns.size(); ++k)
    for (int i = 0; i < n_base; ++i)
      on_base(i, loads.columns[k]) += loads.on_retained(i, static_cast<int>(k));

  Matrix result(period * tread.base_per_column(), n_fields / period);
  for (int c = 0; c < n_fields; ++c) {
    const double* from = on_base.column(c);
    const auto [to, shared] = base_parts(tread, result, c);
    for (int i = 0; i < tread.base_per_column(); ++i) to[i] += *from++;
    for (int i = 0; i < n_base - tread.base_per_column(); ++i) shared[i] += *from++;
  }
  return result;
}

template <int dim>
TreadField tread_field(const Tread<dim>& tread, const Matrix& outer, const TreadLoads& loads) {
  const int n_columns = tread.n_columns(), n_base = tread.n_base(), n_line = tread.n_line(),
            per_column = tread.base_per_column(), n_fields = loads.n_fields;
  const Matrix to_lines = block(tread.column().stiffness, n_base, 0, 2 * n_line, n_base);
  auto base = Matrix::unfilled(n_base, n_fields), of_base = Matrix::unfilled(2 * n_line, n_fields);
  for_blocks(n_fields, [&](int first, int n) {
    for (int c = first; c < first + n; ++c) {
      const auto [from, shared] = base_parts(tread, outer, c);
      std::copy_n(shared, n_base - per_column, std::copy_n(from, per_column, base.column(c)));
    }
    multiply_columns(-1, to_lines, Op::none, base.column(first), n, 0, of_base.column(first));
  });
  Matrix line_loads(n_line, n_fields);
  add_line_loads(of_base, 0, iota(0, n_fields), n_columns, line_loads);
  add_line_loads(loads.on_retained, n_base, loads.columns, n_columns, line_loads);
  return {std::move(base), tread.lines().solve(line_loads)};
}

template <int dim>
Matrix observations(const Tread<dim>& tread, const TreadField& field, const TreadLoads& loads,
                    std::span<const int> columns) {
  Matrix result =
      product(tread.column().observation, Op::none, retained(field, columns, tread.n_columns()), Op::none);
  add_response(tread.column().compliance, Op::none, loads, loads.on_observations, columns, result);
  add_response(tread.column().nodal_compliance, Op::transpose, loads, loads.on_nodes, columns, result);
  return result;
}

template <int dim>
Matrix observations(const Tread<dim>& tread, const TreadField& field, const TreadLoads& loads) {
  auto result = Matrix::unfilled(tread.n_observations(), loads.n_fields);
  for_blocks(loads.n_fields, [&](int first, int n) {
    const Matrix part = observations(tread, field, loads, iota(first, n));
    std::copy(part.entries().begin(), part.entries().end(), result.column(first));
  });
  return result;
}

template <int dim>
Matrix nodal_displacements(const Tread<dim>& tread, const TreadField& field, const TreadLoads& loads) {
  assert(loads.on_nodes.columns() == 0);
  const auto columns = iota(0, loads.n_fields);
  Matrix result =
      product(tread.column().nodal, Op::none, retained(field, columns, tread.n_columns()), Op::none);
  add_response(tread.column().nodal_compliance, Op::none, loads, loads.on_observations, columns, result);
  return result;
}

#define WHEELWRIGHT_INSTANTIATE(dim)                                                     \
  template TreadLoads tread_loads(const Tread<dim>&, const Matrix&);                     \
  template TreadLoads tread_loads(const Tread<dim>&, const TreadForces&);                \
  template decltype(base_loads<dim>) base_loads<dim>;                                    \
  template decltype(tread_field<dim>) tread_field<dim>;                                  \
  template Matrix observations(const Tread<dim>&, const TreadField&, const TreadLoads&); \
  template Matrix observations(const Tread<dim>&, const TreadField&, const TreadLoads&,  \
                               std::span<const int>);                                    \
  template decltype(nodal_displacements<dim>) nodal_displacements<dim>;
WHEELWRIGHT_INSTANTIATE(2)
WHEELWRIGHT_INSTANTIATE(3)
#undef WHEELWRIGHT_INSTANTIATE

}  // namespace wheelwright
