#include "wheelwright/ring/tread.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/periodic.h"
#include "wheelwright/linalg/column_basis.h"

namespace wheelwright {
namespace {

/// Couplings below this fraction of a column's own are dropped.
constexpr double negligible = 1e-14;

/// The columns of a map on retained unknowns that belong to the column's first (0) or last (1) line.
template <int dim>
Matrix on_line(const TreadColumn<dim>& column, const Matrix& map, int side) {
  return block(map, 0, column.n_base + side * column.n_line, map.rows(), column.n_line);
}

/// A block of a column's stiffness: rows of its first (0) or last (1) line, columns of one of them.
template <int dim>
Matrix line_stiffness(const TreadColumn<dim>& column, int row_side, int column_side) {
  const int n = column.n_line;
  return block(column.stiffness, column.n_base + row_side * n, column.n_base + column_side * n, n, n);
}

/// The lines of the ring, base fixed: a line is the last of one column and the first of the next.
template <int dim>
Expected<CyclicChain> line_chain(const TreadColumn<dim>& column, int n_columns) {
  Matrix diagonal = line_stiffness(column, 0, 0);
  const Matrix last = line_stiffness(column, 1, 1);
  for (size_t k = 0; k < last.entries().size(); ++k) diagonal.entries()[k] += last.entries()[k];
  return CyclicChain::factor(diagonal, line_stiffness(column, 0, 1), n_columns);
}

/// Responses of all lines to unit loads on line 0, base fixed.
std::vector<Matrix> line_responses(const CyclicChain& lines, int n_line) {
  Matrix loads(n_line, n_line * lines.n_links());
  for (int load = 0; load < n_line; ++load) loads(load, load * lines.n_links()) = 1;
  const Matrix x = lines.solve(loads);
  std::vector<Matrix> responses(lines.n_links(), Matrix(n_line, n_line));
  for (int c = 0; c < lines.n_links(); ++c)
    for (int load = 0; load < n_line; ++load)
      std::copy_n(x.column(load * lines.n_links() + c), n_line, responses[c].column(load));
  return responses;
}

/// Traces of what is observed on Gamma_C (rows as in ObservationRows): samples z = tau sigma(u)n - gamma u,
/// or tests theta/gamma sigma(u)n - u.
template <int dim, class OfTraction, class OfDisplacement>
Matrix traces(const std::vector<TreadPoint<dim>>& points, OfTraction of_traction,
              OfDisplacement of_displacement, const Matrix& observed) {
  const int n_points = static_cast<int>(points.size());
  const ObservationRows<dim> rows{n_points, 0};
  Matrix result(dim * n_points, observed.columns());
  for (int j = 0; j < observed.columns(); ++j) {
    const double* o = observed.column(j);
    double* trace = result.column(j);
    for (int q = 0; q < n_points; ++q) {
      const double traction = of_traction(points[q]), displacement = of_displacement(points[q]);
      for (int d = 0; d < dim; ++d)
        trace[dim * q + d] = traction * o[rows.traction(q) + d] - displacement * o[rows.displacement(q) + d];
    }
  }
  return result;
}

/// The coordinates of the traces of all differences in one basis, up to rounding.
TraceKernel trace_kernel(const std::vector<Matrix>& traces) {
  const int rows = traces.front().rows(), columns = traces.front().columns();
  Matrix all(rows, columns * static_cast<int>(traces.size()));
  for (size_t k = 0; k < traces.size(); ++k)
    std::copy_n(traces[k].data(), traces[k].entries().size(), all.column(columns * static_cast<int>(k)));
  ColumnBasis found = column_basis(all, negligible);
  TraceKernel kernel{std::move(found.basis), {}};
  for (size_t k = 0; k < traces.size(); ++k)
    kernel.coordinates.push_back(
        block(found.coordinates, 0, columns * static_cast<int>(k), found.coordinates.rows(), columns));
  return kernel;
}

}  // namespace

template <int dim>
Expected<Tread<dim>> Tread<dim>::condense(const ElementTable<dim>& table, const TreadGrid& grid,
                                          const ContactForm& form, int points_per_direction) {
  auto column = tread_column<dim>(table, grid, form, points_per_direction);
  if (!column) return column.failure();
  Tread tread;
  tread.grid_ = grid;
  tread.form_ = form;
  tread.column_ = *std::move(column);
  tread.degree_ = table.degree();
  tread.n_columns_ = table.grid().ring_columns();
  tread.columns_per_sector_ = table.grid().columns();
  const int n = tread.n_columns_;
  auto lines = line_chain(tread.column_, n);
  if (!lines) return lines.failure();
  const auto responses = line_responses(*lines, tread.n_line());
  tread.lines_ = *std::move(lines);
  const auto response = [&](int difference) -> const Matrix& { return responses[wrap(difference, n)]; };

  const int farthest = (n - 1) / 2 - 1;
  int reach = farthest;
  while (reach > 1 && std::max(largest_entry(response(reach)), largest_entry(response(-reach))) <
                          negligible * largest_entry(response(0)))
    --reach;
  tread.reach_ = reach;

  // A column observes and loads the lines of another column through its own first and last line.
  const TreadColumn<dim>& own = tread.column_;
  const int n_base = own.n_base, n_line = own.n_line, n_contact = own.surface.rows().n_contact();
  const Matrix stiffness_on_base = block(own.stiffness, 0, 0, own.stiffness.rows(), n_base);
  const Matrix observed = block(own.observation, 0, 0, n_contact, own.observation.columns());
  const auto samples = [&](const Matrix& seen) {
    return traces<dim>(
        own.surface.points, [&](const auto&) { return form.tau(); },
        [](const auto& point) { return point.gamma; }, seen);
  };
  const auto tests = [&](const Matrix& seen) {
    return traces<dim>(
        own.surface.points, [&](const auto& point) { return form.theta() / point.gamma; },
        [](const auto&) { return 1.0; }, seen);
  };
  Matrix line_load_of_base[2], base_rows[2], sample_rows[2], test_rows[2];
  for (int side = 0; side < 2; ++side) {
    line_load_of_base[side] = Matrix(n_line, n_base);
    for (int j = 0; j < n_base; ++j)
      for (int i = 0; i < n_line; ++i)
        line_load_of_base[side](i, j) = -stiffness_on_base(n_base + side * n_line + i, j);
    base_rows[side] = Matrix(n_base, n_line);
    for (int j = 0; j < n_line; ++j)
      for (int i = 0; i < n_base; ++i) base_rows[side](i, j) = -line_load_of_base[side](j, i);
    sample_rows[side] = samples(on_line(own, observed, side));
    test_rows[side] = tests(on_line(own, observed, side));
  }
  const int n_traces = sample_rows[0].rows();
  std::vector<Matrix> all_sampled, all_tested;
  for (int d = -reach; d <= reach; ++d) {
    Matrix base(n_base, n_base), sampled(n_traces, n_base), tested(n_traces, n_base),
        compliance(n_traces, n_traces);
    if (d == 0) {
      const Matrix own_observation = block(own.observation, 0, 0, n_contact, n_base);
      base = block(own.stiffness, 0, 0, n_base, n_base);
      sampled = samples(own_observation);
      tested = tests(own_observation);
      compliance = samples(transposed(tests(transposed(block(own.compliance, 0, 0, n_contact, n_contact)))));
    }
    for (int seen = 0; seen < 2; ++seen) {
      Matrix of_base(n_line, n_base), of_tests(n_line, n_traces);
      for (int loaded = 0; loaded < 2; ++loaded) {
        const Matrix& seen_lines = response(d + seen - loaded);
        multiply(1, seen_lines, Op::none, line_load_of_base[loaded], Op::none, 1, of_base);
        multiply(1, seen_lines, Op::none, test_rows[loaded], Op::transpose, 1, of_tests);
      }
      multiply(1, base_rows[seen], Op::none, of_base, Op::none, 1, base);
      multiply(1, sample_rows[seen], Op::none, of_base, Op::none, 1, sampled);
      multiply(1, test_rows[seen], Op::none, of_base, Op::none, 1, tested);
      multiply(1, sample_rows[seen], Op::none, of_tests, Op::none, 1, compliance);
    }
    tread.base_stiffness_.push_back(std::move(base));
    all_sampled.push_back(std::move(sampled));
    all_tested.push_back(std::move(tested));
    tread.compliance_.push_back(std::move(compliance));
  }
  tread.samples_ = trace_kernel(all_sampled);
  tread.tests_ = trace_kernel(all_tested);
  return tread;
}

template <int dim>
std::vector<ComplexMatrix> Tread<dim>::outer_stiffness(const SectorHarmonics& harmonics) const {
  const int period = columns_per_sector_, per_column = base_per_column(), n_base = column_.n_base;
  const int n_outer = period * per_column;
  std::vector<ComplexMatrix> result(harmonics.n_harmonics(), ComplexMatrix(n_outer, n_outer));
  for (int h = 0; h < harmonics.n_harmonics(); ++h) {
    for (int from = 0; from < period; ++from) {
      for (int d = -reach_; d <= reach_; ++d) {
        const Matrix& k = base_stiffness_[d + reach_];
        for (int j = 0; j < n_base; ++j) {
          const int source = from * per_column + j;
          for (int i = 0; i < n_base; ++i) {
            // Floor division: columns before the sector belong to the previous one.
            const int target = (from + d) * per_column + i;
            const int target_sector = (target >= 0 ? target : target - n_outer + 1) / n_outer;
            result[h](target - target_sector * n_outer, source % n_outer) +=
                k(i, j) * harmonics.phase(h, source / n_outer - target_sector);
          }
        }
      }
    }
  }
  return result;
}

template class Tread<2>;
template class Tread<3>;

}  // namespace wheelwright
