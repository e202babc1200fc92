#include "wheelwright/mechanics/ring/line_harmonics.h"

#include <cblas.h>

#include <numbers>

#include "wheelwright/base/parallel.h"

namespace wheelwright {
namespace {

using Complex = std::complex<double>;

/// Rows of a product that are computed together: their parts fit the cache.
constexpr int rows_together = 64;

/// c = a b of contiguous column-major matrices.
void multiply_contiguous(const Complex* a, const ComplexMatrix& b, CBLAS_TRANSPOSE op_b, int rows,
                         Complex* c) {
  const Complex one = 1, zero = 0;
  const int n = op_b == CblasNoTrans ? b.columns() : b.rows(),
            k = op_b == CblasNoTrans ? b.rows() : b.columns();
  cblas_zgemm3m(CblasColMajor, CblasNoTrans, op_b, rows, n, k, &one, a, rows, b.data(), b.rows(), &zero, c,
                rows);
}

}  // namespace

template <int dim>
LineHarmonics::LineHarmonics(const Tread<dim>& tread, const SectorHarmonics& harmonics, int harmonic)
    : waves_(tread.columns_per_sector(), tread.columns_per_sector()) {
  const int n = tread.columns_per_sector(), reach = tread.base_reach(), n_line = tread.n_line(),
            n_base = tread.base_per_column(), n_columns = harmonics.n_sectors() * n;
  const auto wave = [&](int q, int column) {
    const long steps = (long(harmonic) + long(q) * harmonics.n_sectors()) * column % n_columns;
    return std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(steps) / n_columns);
  };
  Matrix phases(2 * reach + 1, 2 * n);  // real parts, then imaginary ones
  for (int q = 0; q < n; ++q) {
    for (int c = 0; c < n; ++c) waves_(c, q) = wave(q, c);
    for (int c = -reach; c <= reach; ++c) {
      phases(c + reach, q) = wave(q, c).real();
      phases(c + reach, n + q) = wave(q, c).imag();
    }
  }
  const int n_entries = n_line * n_base;
  auto maps = Matrix::unfilled(n_entries, 2 * n);
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n_entries, 2 * n, 2 * reach + 1, 1.0 / n,
              tread.line_of_base().data(), n_entries, phases.data(), phases.rows(), 0, maps.data(),
              n_entries);
  for (int q = 0; q < n; ++q) {
    adjoint_.push_back(ComplexMatrix::unfilled(n_base, n_line));
    for (int j = 0; j < n_base; ++j)
      for (int i = 0; i < n_line; ++i)
        adjoint_[q](j, i) = {maps(n_line * j + i, q), -maps(n_line * j + i, n + q)};
  }
}

ComplexMatrix LineHarmonics::times_adjoint(const ComplexMatrix& a) const {
  const int n = waves_.rows(), n_base = adjoint_.front().rows(), n_line = adjoint_.front().columns();
  auto result = ComplexMatrix::unfilled(a.rows(), n * n_line);
  parallel_for((a.rows() + rows_together - 1) / rows_together, [&](int part) {
    const int first = part * rows_together, rows = std::min(rows_together, a.rows() - first);
    const ComplexMatrix own = block(a, first, 0, rows, a.columns());
    auto in_harmonics = ComplexMatrix::unfilled(rows, n * n_base),
         mapped = ComplexMatrix::unfilled(rows, n * n_line), lines = mapped;
    multiply_contiguous(own.data(), waves_, CblasNoTrans, rows * n_base, in_harmonics.data());
    for (int q = 0; q < n; ++q)
      multiply_contiguous(in_harmonics.column(q * n_base), adjoint_[q], CblasNoTrans, rows,
                          mapped.column(q * n_line));
    multiply_contiguous(mapped.data(), waves_, CblasConjTrans, rows * n_line, lines.data());
    for (int j = 0; j < lines.columns(); ++j) std::copy_n(lines.column(j), rows, result.column(j) + first);
  });
  return result;
}

template <int dim>
double LineHarmonics::flops(const Tread<dim>& tread, double rows) {
  const double n = tread.columns_per_sector(), n_base = tread.base_per_column(), n_line = tread.n_line();
  return 8 * rows * n * (n * (n_base + n_line) + n_base * n_line);
}

template LineHarmonics::LineHarmonics(const Tread<2>&, const SectorHarmonics&, int);
template LineHarmonics::LineHarmonics(const Tread<3>&, const SectorHarmonics&, int);
template double LineHarmonics::flops(const Tread<2>&, double);
template double LineHarmonics::flops(const Tread<3>&, double);

}  // namespace wheelwright
