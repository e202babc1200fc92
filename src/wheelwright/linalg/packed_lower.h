#pragma once

#include <algorithm>
#include <vector>

#include "wheelwright/linalg/dense.h"

namespace wheelwright {

/// The lower triangle of a square matrix in panels of columns: each panel holds its columns from the row of
/// its first one on, column-major, so that half of the square matrix is not stored and kernels for dense
/// matrices work on it. No panel crosses the border between the first `n_first` unknowns and the others.
template <class Scalar>
class PackedLower {
 public:
  /// Columns of a panel, at most: wide enough for matrix products at full speed.
  static constexpr int panel_width = 192;

  /// A matrix of zeros.
  PackedLower(int size, int n_first) : size_(size), n_first_(n_first), start_(size) {
    append_panels(0, n_first);
    append_panels(n_first, size);
    size_t n_entries = 0;
    for (Panel& panel : panels_) {
      panel.start = n_entries;
      for (int j = 0; j < panel.n_columns; ++j)
        start_[panel.first + j] = n_entries + size_t(j) * panel.stride - panel.first;
      n_entries += size_t(panel.n_columns) * panel.stride;
    }
    entries_.assign(n_entries, Scalar(0));
  }

  int size() const { return size_; }
  int n_first() const { return n_first_; }
  size_t n_entries() const { return entries_.size(); }

  /// The entry in row i >= column j.
  Scalar& operator()(int i, int j) { return entries_[start_[j] + i]; }
  const Scalar& operator()(int i, int j) const { return entries_[start_[j] + i]; }

  struct Panel {
    int first, n_columns;  ///< its columns
    int stride;            ///< between columns: the number of rows from `first` on
    size_t start;          ///< of its entries
    int end() const { return first + n_columns; }
  };
  const std::vector<Panel>& panels() const { return panels_; }

 private:
  void append_panels(int first, int end) {
    const int n = (end - first + panel_width - 1) / panel_width;
    for (int k = 0; k < n; ++k) {
      const int begin = first + (end - first) * k / n, next = first + (end - first) * (k + 1) / n;
      panels_.push_back({begin, next - begin, size_ - begin, 0});
    }
  }

  int size_, n_first_;
  std::vector<Panel> panels_;
  std::vector<size_t> start_;  ///< of every column, less its first row
  std::vector<Scalar> entries_;
};

}  // namespace wheelwright
