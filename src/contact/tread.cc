#include "contact/tread.h"

#include <algorithm>
#include <cmath>

#include "contact/tread_column.h"
#include "linalg/sparse_spd.h"

namespace wheelwright {
namespace {

double largest(const Matrix& a) {
  double result = 0;
  for (double x : a.entries()) result = std::max(result, std::abs(x));
  return result;
}

/// Responses of all azimuth lines of the tread above the base, one column a load on column 0.
struct LineResponse {
  int n_line;
  std::vector<std::vector<double>> lines;

  /// Rows of one line for all loads.
  Matrix line(int index) const {
    Matrix result(n_line, static_cast<int>(lines.size()));
    for (int j = 0; j < result.columns(); ++j)
      std::copy_n(lines[j].begin() + size_t(index) * n_line, n_line, result.column(j));
    return result;
  }
};

}  // namespace

template <int dim>
Expected<Tread<dim>> Tread<dim>::condense(const ElementTable<dim>& table, int rows, const ContactForm& form,
                                          int points_per_direction) {
  auto condensed = tread_column<dim>(table, rows, form, points_per_direction);
  if (!condensed) return condensed.failure();
  const TreadColumn<dim>& column = *condensed;
  const int n_base = column.n_base, n_line = column.n_line;

  Tread tread;
  tread.form_ = form;
  tread.rows_ = rows;
  tread.points_ = column.points;
  tread.degree_ = table.degree();
  tread.n_base_ = n_base;
  tread.n_columns_ = table.grid().ring_columns();
  tread.columns_per_sector_ = table.grid().columns();
  tread.base_per_line_ = n_base / (tread.degree_ + 1);
  const int n_columns = tread.n_columns_, n_observations = tread.n_observations();

  // The ring of azimuth lines, base fixed: column c couples lines c and c + 1.
  const auto line_dof = [&](int c, int local) {  // local: first line, then last line
    return ((c + local / n_line) % n_columns) * n_line + local % n_line;
  };
  std::vector<SparseSpd::Entry> entries;
  entries.reserve(size_t(n_columns) * 4 * n_line * n_line);
  for (int c = 0; c < n_columns; ++c)
    for (int j = 0; j < 2 * n_line; ++j)
      for (int i = 0; i < 2 * n_line; ++i)
        if (const int row = line_dof(c, i), col = line_dof(c, j); row >= col)
          entries.push_back({row, col, column.stiffness(n_base + i, n_base + j)});
  auto lines = SparseSpd::factor(n_columns * n_line, entries);
  if (!lines) return lines.failure();

  const auto respond = [&](const auto& load_of, int n_loads) {
    LineResponse response{n_line, {}};
    for (int load = 0; load < n_loads; ++load) {
      std::vector<double> rhs(size_t(n_columns) * n_line, 0.0);
      for (int i = 0; i < 2 * n_line; ++i) rhs[line_dof(0, i)] += load_of(load, i);
      response.lines.push_back(lines->solve(rhs));
    }
    return response;
  };
  const LineResponse to_observation =
      respond([&](int load, int i) { return column.observation(load, n_base + i); }, n_observations);
  const LineResponse to_base =
      respond([&](int load, int i) { return -column.stiffness(n_base + i, load); }, n_base);

  // What column `difference` sees of a response, through its first and last line.
  const auto seen = [&](const Matrix& map, const LineResponse& response, int difference, const Matrix& own) {
    Matrix result(map.rows(), static_cast<int>(response.lines.size()));
    if (difference == 0) result = own;
    for (int side = 0; side < 2; ++side) {
      Matrix part(map.rows(), n_line);
      for (int j = 0; j < n_line; ++j)
        std::copy_n(map.column(n_base + side * n_line + j), map.rows(), part.column(j));
      const int line = ((difference + side) % n_columns + n_columns) % n_columns;
      multiply(1, part, Op::none, response.line(line), Op::none, 1, result);
    }
    return result;
  };
  Matrix own_transfer(n_observations, n_base), base_rows(n_base, column.stiffness.columns()),
      own_base(n_base, n_base);
  for (int j = 0; j < n_base; ++j) {
    std::copy_n(column.observation.column(j), n_observations, own_transfer.column(j));
    std::copy_n(column.stiffness.column(j), n_base, own_base.column(j));
  }
  for (int j = 0; j < base_rows.columns(); ++j)
    std::copy_n(column.stiffness.column(j), n_base, base_rows.column(j));

  Matrix own_nodal(column.nodal.rows(), n_base);
  for (int j = 0; j < n_base; ++j) std::copy_n(column.nodal.column(j), own_nodal.rows(), own_nodal.column(j));

  const int farthest = (n_columns - 1) / 2;
  std::vector<Matrix> transfer, compliance, base;
  for (int d = -farthest; d <= farthest; ++d) {
    transfer.push_back(seen(column.observation, to_base, d, own_transfer));
    compliance.push_back(seen(column.observation, to_observation, d, column.compliance));
    base.push_back(seen(base_rows, to_base, d, own_base));
  }
  const auto negligible = [&](const std::vector<Matrix>& kernel, int d) {
    return largest(kernel[farthest + d]) < 1e-18 * largest(kernel[farthest]) &&
           largest(kernel[farthest - d]) < 1e-18 * largest(kernel[farthest]);
  };
  tread.reach_ = farthest;
  while (tread.reach_ > 1 && negligible(transfer, tread.reach_) && negligible(compliance, tread.reach_) &&
         negligible(base, tread.reach_))
    --tread.reach_;
  for (int d = -tread.reach_; d <= tread.reach_; ++d) {
    tread.transfer_.push_back(std::move(transfer[farthest + d]));
    tread.compliance_.push_back(std::move(compliance[farthest + d]));
    tread.base_stiffness_.push_back(std::move(base[farthest + d]));
    tread.nodal_transfer_.push_back(seen(column.nodal, to_base, d, own_nodal));
    tread.nodal_compliance_.push_back(seen(column.nodal, to_observation, d, column.nodal_compliance));
  }
  return tread;
}

template <int dim>
std::vector<ComplexMatrix> Tread<dim>::outer_stiffness(const SectorHarmonics& harmonics) const {
  const int period = columns_per_sector_, per_column = degree_ * base_per_line_;
  const int n_outer = period * per_column;
  std::vector<ComplexMatrix> result(harmonics.n_harmonics(), ComplexMatrix(n_outer, n_outer));
  for (int h = 0; h < harmonics.n_harmonics(); ++h) {
    for (int from = 0; from < period; ++from) {
      for (int d = -reach_; d <= reach_; ++d) {
        const Matrix& k = base_stiffness_[slot(d)];
        for (int j = 0; j < n_base_; ++j) {
          const int source = from * per_column + j;
          for (int i = 0; i < n_base_; ++i) {
            // Floor division: columns before the sector belong to the one before.
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
