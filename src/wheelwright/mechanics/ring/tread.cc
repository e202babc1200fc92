#include "wheelwright/mechanics/ring/tread.h"

#include <algorithm>
#include <cmath>

#include "wheelwright/base/periodic.h"

namespace wheelwright {
namespace {

/// Couplings below this fraction of a column's own are dropped.
constexpr double negligible = 1e-14;

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
/// or tests theta/gamma sigma(u)n - u; of the first `traced` components, one row per point.
template <int dim, class OfTraction, class OfDisplacement>
std::vector<Matrix> traces(const std::vector<TreadPoint<dim>>& points, int traced, OfTraction of_traction,
                           OfDisplacement of_displacement, const Matrix& observed) {
  const int n_points = static_cast<int>(points.size());
  const ObservationRows<dim> rows{n_points, 0};
  std::vector<Matrix> result(traced, Matrix(n_points, observed.columns()));
  for (int d = 0; d < traced; ++d)
    for (int j = 0; j < observed.columns(); ++j)
      for (int q = 0; q < n_points; ++q)
        result[d](q, j) = of_traction(points[q]) * observed(rows.traction(q) + d, j) -
                          of_displacement(points[q]) * observed(rows.displacement(q) + d, j);
  return result;
}

/// A map on a column's retained unknowns as one on its own seam and the next one.
template <int dim>
Matrix on_seams(const TreadColumn<dim>& column, const Matrix& map, int per_column) {
  const int n_line = column.n_line, n_seam = per_column + n_line;
  Matrix result(map.rows(), 2 * n_seam);
  const auto put = [&](int from, int n, int to) {
    for (int j = 0; j < n; ++j) std::copy_n(map.column(from + j), map.rows(), result.column(to + j));
  };
  put(0, per_column, 0);
  put(per_column, column.n_base - per_column, n_seam);
  put(column.n_base, n_line, per_column);
  put(column.n_base + n_line, n_line, n_seam + per_column);
  return result;
}

/// Displacements of line 0 for displacements of the base's own parts of the columns -reach - 1 to reach + 1.
/// `response(c)`: of line c to loads on line 0; `load[side]`: on the first and last line of a column whose
/// base is displaced.
template <class Response>
Matrix base_on_line(const Response& response, const Matrix (&load)[2], int reach, int per_column) {
  const int n_line = load[0].rows(), n_base = load[0].columns();
  Matrix result(n_line, per_column * (2 * reach + 3));
  for (int c = -reach - 1; c <= reach; ++c) {
    Matrix of_column = product(response(-c), Op::none, load[0], Op::none);
    multiply(1, response(-c - 1), Op::none, load[1], Op::none, 1, of_column);
    double* to = result.column(per_column * (c + reach + 1));
    for (int k = 0; k < n_line * n_base; ++k) to[k] += of_column.entries()[k];
  }
  return result;
}

/// The base's stiffness by its line's own parts: `by_difference[k]` acts on all nodes of a column's base.
std::vector<Matrix> by_own_parts(const std::vector<Matrix>& by_difference, int per_column) {
  const int n_base = by_difference.front().rows(), n = static_cast<int>(by_difference.size());
  std::vector<Matrix> result(n + 2, Matrix(per_column, per_column));
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n_base; ++j)
      for (int i = 0; i < n_base; ++i)
        result[k + 1 + i / per_column - j / per_column](i % per_column, j % per_column) +=
            by_difference[k](i, j);
  return result;
}

}  // namespace

template <int dim>
Expected<Tread<dim>> Tread<dim>::condense(const ElementTable<dim>& table, const TreadGrid& grid,
                                          const ContactForm& form, int points_per_direction, int traced) {
  auto column = tread_column<dim>(table, grid, form, points_per_direction);
  if (!column) return column.failure();
  Tread tread;
  tread.grid_ = grid;
  tread.form_ = form;
  tread.column_ = *std::move(column);
  tread.degree_ = table.degree();
  tread.traced_ = traced;
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

  for (int d = -reach; d <= reach; ++d) tread.line_compliance_.push_back(response(d));

  const TreadColumn<dim>& own = tread.column_;
  const int n_base = own.n_base, n_line = own.n_line, n_contact = own.surface.rows().n_contact(),
            per_column = tread.base_per_column();
  const auto samples = [&](const Matrix& seen) {
    return traces<dim>(
        own.surface.points, traced, [&](const auto&) { return form.tau(); },
        [](const auto& point) { return point.gamma; }, seen);
  };
  const auto tests = [&](const Matrix& seen) {
    return traces<dim>(
        own.surface.points, traced, [&](const auto& point) { return form.theta() / point.gamma; },
        [](const auto&) { return 1.0; }, seen);
  };
  const Matrix observed =
      on_seams(own, block(own.observation, 0, 0, n_contact, own.observation.columns()), per_column);
  tread.samples_ = samples(observed);
  tread.tests_ = tests(observed);
  std::vector<std::vector<Matrix>> by_traction;
  for (const Matrix& of_tests : tests(transposed(block(own.compliance, 0, 0, n_contact, n_contact))))
    by_traction.push_back(samples(transposed(of_tests)));
  for (int i = 0; i < traced; ++i)
    for (int j = 0; j < traced; ++j) tread.compliance_.push_back(by_traction[j][i]);

  // The base of a column loads its two lines, and they load it.
  Matrix line_load_of_base[2];
  for (int side = 0; side < 2; ++side) {
    line_load_of_base[side] = block(own.stiffness, n_base + side * n_line, 0, n_line, n_base);
    for (double& x : line_load_of_base[side].entries()) x = -x;
  }
  tread.line_of_base_ = base_on_line(response, line_load_of_base, reach, per_column);
  std::vector<Matrix> all_base;
  for (int d = -reach; d <= reach; ++d) {
    Matrix base = d == 0 ? block(own.stiffness, 0, 0, n_base, n_base) : Matrix(n_base, n_base);
    for (int seen = 0; seen < 2; ++seen)
      for (int loaded = 0; loaded < 2; ++loaded)
        multiply(-1, line_load_of_base[seen], Op::transpose,
                 product(response(d + seen - loaded), Op::none, line_load_of_base[loaded], Op::none),
                 Op::none, 1, base);
    all_base.push_back(std::move(base));
  }
  tread.line_stiffness_ = by_own_parts(all_base, per_column);
  return tread;
}

template <int dim>
ComplexMatrix Tread<dim>::outer_stiffness(const SectorHarmonics& harmonics, int harmonic) const {
  const int period = columns_per_sector_, per_column = base_per_column(), farthest = reach_ + 1;
  // All pairs of columns in the sector that are equally far apart have the same block.
  std::vector<ComplexMatrix> blocks(2 * period - 1, ComplexMatrix(per_column, per_column));
  for (int apart = 1 - period; apart < period; ++apart) {
    ComplexMatrix& block = blocks[apart + period - 1];
    const int first = -(farthest + apart) / period - 1, last = (farthest - apart) / period + 1;
    for (int ahead = first; ahead <= last; ++ahead) {
      const int difference = apart + ahead * period;
      if (std::abs(difference) > farthest) continue;
      const std::complex<double> phase = harmonics.phase(harmonic, -ahead);
      const Matrix& k = line_stiffness_[difference + farthest];
      for (size_t e = 0; e < k.entries().size(); ++e) block.entries()[e] += phase * k.entries()[e];
    }
  }
  ComplexMatrix result(period * per_column, period * per_column);
  for (int from = 0; from < period; ++from)
    for (int to = 0; to < period; ++to) {
      const ComplexMatrix& block = blocks[to - from + period - 1];
      for (int j = 0; j < per_column; ++j)
        std::copy_n(block.column(j), per_column, result.column(from * per_column + j) + to * per_column);
    }
  return result;
}

template class Tread<2>;
template class Tread<3>;

}  // namespace wheelwright
