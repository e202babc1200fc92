#include "wheelwright/ring/surface_compliance.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/periodic.h"

namespace wheelwright {
namespace {

/// Right-hand sides that are solved together: enough for fast products, and few enough to take little memory.
constexpr int rhs_together = 192;

/// Calls visit(row, sector, first, n) for `n_columns` columns of the ring's outer line from `first_column`
/// on: the n rows from `row` on of that piece of the line are those from `first` on of the sector in a field
/// by `n_sectors` sectors (CyclicStiffness), which repeats itself after them.
template <int dim, class Visit>
void for_each_part(const Tread<dim>& tread, int n_sectors, int first_column, int n_columns, Visit visit) {
  const int per_column = tread.base_per_column(), per_sector = tread.columns_per_sector();
  for (int c = 0; c < n_columns; ++c) {
    const int column = wrap(first_column + c, tread.n_columns());
    visit(per_column * c, column / per_sector % n_sectors, per_column * (column % per_sector), per_column);
  }
}

/// The samples' coordinates in the columns around the loaded ones, for unit tests on loaded columns of the
/// sector: [loaded column][-width ... width], one column per coordinate of the tests.
template <int dim>
std::vector<std::vector<Matrix>> responses(const CyclicStiffness<dim>& ring, const Tread<dim>& tread,
                                           int width, std::span<const int> loaded) {
  const Matrix &tests = tread.tests().of_line, &samples = tread.samples().of_line;
  const int n_sectors = ring.n_sectors(), reach = tread.reach(), n_tests = tests.rows();
  const int n_loaded = static_cast<int>(loaded.size()), n_line = 2 * reach + 2;
  Matrix loads(ring.n_outer(), n_loaded * n_tests * n_sectors);
  for (int k = 0; k < n_loaded; ++k)
    for_each_part(tread, n_sectors, loaded[k] - reach, n_line, [&](int row, int sector, int first, int n) {
      for (int test = 0; test < n_tests; ++test)
        for (int i = 0; i < n; ++i)
          loads(first + i, (k * n_tests + test) * n_sectors + sector) += tests(test, row + i);
    });
  const Matrix outer = ring.outer_displacements(loads);
  std::vector<std::vector<Matrix>> result(n_loaded);
  parallel_for(n_loaded, [&](int k) {
    const int n_seen = n_line + 2 * width;
    auto seen = Matrix::unfilled(n_seen * tread.base_per_column(), n_tests);
    for_each_part(tread, n_sectors, loaded[k] - width - reach, n_seen,
                  [&](int row, int sector, int first, int n) {
                    for (int test = 0; test < n_tests; ++test)
                      std::copy_n(outer.column((k * n_tests + test) * n_sectors + sector) + first, n,
                                  seen.column(test) + row);
                  });
    for (int d = -width; d <= width; ++d)
      result[k].push_back(product(
          samples, Op::none,
          block(seen, (d + width) * tread.base_per_column(), 0, samples.columns(), n_tests), Op::none));
  });
  return result;
}

/// The mirror image, in the plane of azimuth 0, of the response of one column to tractions on another.
template <int dim>
Matrix mirror_image(const Tread<dim>& tread, const Matrix& block) {
  // The image of a column's frame is the frame at the end of the column's image.
  const double angle = 2 * std::numbers::pi / tread.n_columns();
  const double c = std::cos(angle), s = std::sin(angle);
  const int n_components = tread.traced_components();
  const auto images = [&](int point) { return tread.surface().mirror_images[2 * point] / 2; };
  const auto reflect = [&](double& radial, double& circumferential) {
    const double r = radial, t = circumferential;
    radial = c * r + s * t;
    circumferential = s * r - c * t;
  };
  auto result = Matrix::unfilled(block.rows(), block.columns());
  for (int from = 0; from < block.columns() / n_components; ++from)
    for (int to = 0; to < block.rows() / n_components; ++to) {
      const int i0 = n_components * images(to), j0 = n_components * images(from);
      for (int j = 0; j < n_components; ++j)
        for (int i = 0; i < n_components; ++i)
          result(i0 + i, j0 + j) = block(n_components * to + i, n_components * from + j);
      for (int j = 0; j < n_components; ++j) reflect(result(i0, j0 + j), result(i0 + 1, j0 + j));
      for (int i = 0; i < n_components; ++i) reflect(result(i0 + i, j0), result(i0 + i, j0 + 1));
    }
  return result;
}

}  // namespace

template <int dim>
SurfaceCompliance<dim>::SurfaceCompliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread,
                                          int width, const std::vector<bool>& loaded)
    : columns_per_sector_(tread.columns_per_sector()),
      components_(tread.traced_components()),
      width_(width),
      blocks_(size_t(2 * width + 1) * columns_per_sector_) {
  // -S (C + T G T^T) Te^T with the tread's compliance C and transfer T and the core's compliance G.
  const TraceKernel &samples = tread.samples(), &tests = tread.tests();
  const auto image_of = [&](int column) { return columns_per_sector_ - 1 - column; };
  const auto is_image = [&](int column) {
    return ring.is_mirror_symmetric() && column > image_of(column) && loaded[image_of(column)];
  };
  std::vector<int> columns;
  for (int c = 0; c < columns_per_sector_; ++c)
    if (loaded[c] && !is_image(c)) columns.push_back(c);
  const int n_columns = static_cast<int>(columns.size()),
            together = std::max(1, rhs_together / std::max(1, tests.of_line.rows()));
  for (int first = 0; first < n_columns; first += together) {
    const std::span group = std::span(columns).subspan(first, std::min(together, n_columns - first));
    const auto coordinates = responses(ring, tread, width, group);
    parallel_for(static_cast<int>(group.size()), [&](int k) {
      for (int d = -width; d <= width; ++d) {
        Matrix& result = blocks_[(2 * width + 1) * group[k] + d + width];
        result = std::abs(d) <= tread.reach() ? tread.compliance(d)
                                              : Matrix(samples.basis.rows(), tests.basis.rows());
        const Matrix of_tests = product(coordinates[k][d + width], Op::none, tests.basis, Op::transpose);
        multiply(-1, samples.basis, Op::none, of_tests, Op::none, -1, result);
      }
    });
  }
  parallel_for(columns_per_sector_, [&](int from) {
    if (!loaded[from] || !is_image(from)) return;
    for (int d = -width; d <= width; ++d)
      blocks_[(2 * width + 1) * from + d + width] = mirror_image(tread, block(image_of(from), -d));
  });
}

template class SurfaceCompliance<2>;
template class SurfaceCompliance<3>;

}  // namespace wheelwright
