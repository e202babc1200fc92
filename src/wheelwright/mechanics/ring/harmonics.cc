#include "wheelwright/mechanics/ring/harmonics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wheelwright/base/parallel.h"

namespace wheelwright {
namespace {

/// How many of the harmonics' blocks exist at a time. Independent of the number of threads, so that their
/// sums are too.
int blocks_together(size_t n_entries, int n_harmonics) {
  constexpr double memory = 256e6;
  constexpr int fewest = 4;
  const double most = memory / (sizeof(std::complex<double>) * static_cast<double>(n_entries));
  return static_cast<int>(std::clamp<double>(most, std::min(fewest, n_harmonics), n_harmonics));
}

}  // namespace

SectorHarmonics::SectorHarmonics(int n_sectors)
    : n_sectors_(n_sectors),
      forward_real_(n_sectors, n_harmonics()),
      forward_imaginary_(n_sectors, n_harmonics()),
      backward_real_(n_harmonics(), n_sectors),
      backward_imaginary_(n_harmonics(), n_sectors) {
  for (int h = 0; h < n_harmonics(); ++h) {
    const double weight = h == 0 || 2 * h == n_sectors ? 1 : 2;
    for (int s = 0; s < n_sectors; ++s) {
      const auto w = phase(h, s);
      forward_real_(s, h) = w.real() / n_sectors;
      forward_imaginary_(s, h) = -w.imag() / n_sectors;
      backward_real_(h, s) = weight * w.real();
      backward_imaginary_(h, s) = -weight * w.imag();
    }
  }
}

std::complex<double> SectorHarmonics::phase(int harmonic, int shift) const {
  const long steps = (long(harmonic) * shift % n_sectors_ + n_sectors_) % n_sectors_;
  return std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(steps) / n_sectors_);
}

ComplexMatrix SectorHarmonics::forward(const Matrix& by_sector) const {
  const Matrix real = product(by_sector, Op::none, forward_real_, Op::none);
  const Matrix imaginary = product(by_sector, Op::none, forward_imaginary_, Op::none);
  auto result = ComplexMatrix::unfilled(by_sector.rows(), n_harmonics());
  for (size_t k = 0; k < result.entries().size(); ++k)
    result.entries()[k] = {real.entries()[k], imaginary.entries()[k]};
  return result;
}

Matrix SectorHarmonics::backward(const ComplexMatrix& by_harmonic) const {
  auto real = Matrix::unfilled(by_harmonic.rows(), n_harmonics());
  auto imaginary = real;
  for (size_t k = 0; k < by_harmonic.entries().size(); ++k) {
    real.entries()[k] = by_harmonic.entries()[k].real();
    imaginary.entries()[k] = by_harmonic.entries()[k].imag();
  }
  Matrix result = product(real, Op::none, backward_real_, Op::none);
  multiply(1, imaginary, Op::none, backward_imaginary_, Op::none, 1, result);
  return result;
}

std::vector<ComplexMatrix> SectorHarmonics::forward_each(const Matrix& by_sector) const {
  const int rows = by_sector.rows(), n_vectors = by_sector.columns() / n_sectors_;
  std::vector<ComplexMatrix> by_harmonic;
  for (int h = 0; h < n_harmonics(); ++h) by_harmonic.push_back(ComplexMatrix::unfilled(rows, n_vectors));
  parallel_for(n_vectors, [&](int v) {
    auto one = Matrix::unfilled(rows, n_sectors_);
    std::copy_n(by_sector.column(v * n_sectors_), one.entries().size(), one.data());
    const ComplexMatrix transformed = forward(one);
    for (int h = 0; h < n_harmonics(); ++h)
      std::copy_n(transformed.column(h), rows, by_harmonic[h].column(v));
  });
  return by_harmonic;
}

Matrix SectorHarmonics::backward_each(const std::vector<ComplexMatrix>& by_harmonic) const {
  const int rows = by_harmonic.front().rows(), n_vectors = by_harmonic.front().columns();
  auto by_sector = Matrix::unfilled(rows, n_vectors * n_sectors_);
  parallel_for(n_vectors, [&](int v) {
    auto transformed = ComplexMatrix::unfilled(rows, n_harmonics());
    for (int h = 0; h < n_harmonics(); ++h)
      std::copy_n(by_harmonic[h].column(v), rows, transformed.column(h));
    const Matrix one = backward(transformed);
    std::copy_n(one.data(), one.entries().size(), by_sector.column(v * n_sectors_));
  });
  return by_sector;
}

std::vector<Matrix> SectorHarmonics::between_sectors(
    int rows, int columns, int farthest, const std::function<ComplexMatrix(int harmonic)>& of_harmonic,
    std::optional<int> wanted_together) const {
  const int n = n_sectors();
  std::vector<int> needed;
  for (int ahead = 0; ahead < n; ++ahead)
    if (std::min(ahead, n - ahead) <= farthest) needed.push_back(ahead);
  const int n_needed = static_cast<int>(needed.size());
  std::vector<Matrix> by_sector(n);
  for (const int ahead : needed) by_sector[ahead] = Matrix(rows, columns);

  // One column per harmonic of a batch, real parts and then imaginary ones, times the phases of every sector.
  const size_t n_entries = size_t(rows) * columns;
  const int together = wanted_together.value_or(blocks_together(n_entries, n_harmonics()));
  for (int first_harmonic = 0; first_harmonic < n_harmonics(); first_harmonic += together) {
    const int n_batch = std::min(together, n_harmonics() - first_harmonic);
    std::vector<ComplexMatrix> by_harmonic(n_batch);
    parallel_for(n_batch, [&](int k) { by_harmonic[k] = of_harmonic(first_harmonic + k); });
    Matrix phases(2 * n_batch, n_needed);
    for (int k = 0; k < n_needed; ++k)
      for (int b = 0; b < n_batch; ++b) {
        const int h = first_harmonic + b;
        const std::complex<double> p = (h == 0 || 2 * h == n ? 1.0 : 2.0) / n * phase(h, needed[k]);
        phases(b, k) = p.real();
        phases(n_batch + b, k) = -p.imag();
      }
    constexpr int entries_together = 1024;
    parallel_for(static_cast<int>((n_entries + entries_together - 1) / entries_together), [&](int part) {
      const size_t first = size_t(part) * entries_together;
      const int size = static_cast<int>(std::min<size_t>(entries_together, n_entries - first));
      auto entries = Matrix::unfilled(size, 2 * n_batch);
      for (int b = 0; b < n_batch; ++b)
        for (int k = 0; k < size; ++k) {
          const std::complex<double> entry = by_harmonic[b].entries()[first + k];
          entries(k, b) = entry.real();
          entries(k, n_batch + b) = entry.imag();
        }
      const Matrix sums = product(entries, Op::none, phases, Op::none);
      for (int k = 0; k < n_needed; ++k) {
        double* to = by_sector[needed[k]].data() + first;
        for (int i = 0; i < size; ++i) to[i] += sums.column(k)[i];
      }
    });
  }
  return by_sector;
}

}  // namespace wheelwright
