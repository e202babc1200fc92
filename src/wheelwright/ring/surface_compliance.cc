#include "wheelwright/ring/surface_compliance.h"

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "wheelwright/base/parallel.h"
#include "wheelwright/base/periodic.h"

namespace wheelwright {
namespace {

/// Number of loaded columns that are solved together.
constexpr int group_size = 6;

/// The core's compliance between the outer line's unknowns of some columns of the ring.
template <int dim>
Matrix outer_compliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread, int first_to, int n_to,
                        int first_from, int n_from) {
  const int per_column = tread.base_per_column(), per_sector = tread.columns_per_sector();
  Matrix g(per_column * n_to, per_column * n_from);
  for (int b = 0; b < n_from; ++b) {
    const int from = wrap(first_from + b, tread.n_columns());
    for (int a = 0; a < n_to; ++a) {
      const int to = wrap(first_to + a, tread.n_columns());
      const Matrix& kernel = ring.outer_compliance(to / per_sector - from / per_sector);
      const int i0 = per_column * (to % per_sector), j0 = per_column * (from % per_sector);
      for (int j = 0; j < per_column; ++j)
        std::copy_n(kernel.column(j0 + j) + i0, per_column, g.column(per_column * b + j) + per_column * a);
    }
  }
  return g;
}

/// The coordinates of traces in `n_columns` neighbouring columns on all base columns that reach them: a band
/// of blocks, the first base column `reach` columns before the first column.
template <int dim>
Matrix on_base_columns(const Tread<dim>& tread, int n_columns, const TraceKernel& kernel) {
  const int reach = tread.reach(), per_column = tread.base_per_column();
  const int block = kernel.basis.columns();
  Matrix band(block * n_columns, per_column * (n_columns + 2 * reach + 1));
  for (int c = 0; c < n_columns; ++c)
    for (int d = -reach; d <= reach; ++d) {
      const Matrix& k = kernel.coordinates[d + reach];
      for (int j = 0; j < k.columns(); ++j)
        for (int i = 0; i < block; ++i) band(block * c + i, per_column * (c - d + reach) + j) += k(i, j);
    }
  return band;
}

}  // namespace

template <int dim>
SurfaceCompliance<dim>::SurfaceCompliance(const CyclicStiffness<dim>& ring, const Tread<dim>& tread,
                                          int width, const std::vector<bool>& loaded)
    : columns_per_sector_(tread.columns_per_sector()), width_(width) {
  // -S (C + T G T^T) Te^T with the tread's compliance C and transfer T and the core's compliance G.
  const int reach = tread.reach(), n_together = std::min(group_size, columns_per_sector_);
  const int n_sampled = n_together + 2 * width;
  const TraceKernel &samples = tread.samples(), &tests = tread.tests();
  const int n_samples = samples.basis.columns(), n_tests = tests.basis.columns();
  const Matrix test = on_base_columns(tread, n_together, tests);
  const Matrix sample = on_base_columns(tread, n_sampled, samples);
  blocks_.resize(size_t(2 * width + 1) * columns_per_sector_);
  const int n_groups = (columns_per_sector_ + n_together - 1) / n_together;
  parallel_for(n_groups, [&](int group) {
    const int first = group * n_together, last = std::min(first + n_together, columns_per_sector_);
    if (std::none_of(loaded.begin() + first, loaded.begin() + last, std::identity())) return;
    const Matrix g = outer_compliance(ring, tread, first - width - reach, n_sampled + 2 * reach + 1,
                                      first - reach, n_together + 2 * reach + 1);
    const Matrix sampled = product(sample, Op::none, product(g, Op::none, test, Op::transpose), Op::none);
    for (int from = first; from < last; ++from) {
      if (!loaded[from]) continue;
      const Matrix of_column =
          product(wheelwright::block(sampled, 0, n_tests * (from - first), sampled.rows(), n_tests), Op::none,
                  tests.basis, Op::transpose);
      for (int d = -width; d <= width; ++d) {
        const Matrix coordinates = wheelwright::block(of_column, n_samples * (from - first + d + width), 0,
                                                      n_samples, of_column.columns());
        Matrix& result = blocks_[(2 * width + 1) * from + d + width];
        result =
            std::abs(d) <= reach ? tread.compliance(d) : Matrix(samples.basis.rows(), tests.basis.rows());
        multiply(-1, samples.basis, Op::none, coordinates, Op::none, -1, result);
      }
    }
  });
}

template class SurfaceCompliance<2>;
template class SurfaceCompliance<3>;

}  // namespace wheelwright
