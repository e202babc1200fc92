#include "wheelwright/mechanics/ring/section_stiffness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

namespace wheelwright {

double SectionStiffness::Entry::at(int difference) const {
  switch (difference) {
    case 0:
      return own;
    case 1:
      return ahead;
    case -1:
      return behind;
    default:
      return 0;
  }
}

SectionStiffness::SectionStiffness(const SparseSymmetric& sector, const std::vector<SharedUnknown>& shared,
                                   const BoundaryMirror& azimuth)
    : azimuth_(azimuth) {
  entries_.reserve(sector.values.size());
  for (int j = 0; j < sector.size; ++j)
    for (int k = sector.column_start[j]; k < sector.column_start[j + 1]; ++k) {
      const int i = sector.rows[k];
      const auto [row, of_row] = shared[i];
      const auto [column, of_column] = shared[j];
      const int difference = of_column - of_row;
      add(difference, row, column, sector.values[k]);
      if (i != j && row == column) add(-difference, row, column, sector.values[k]);
    }
  sum_equal_places();
}

/// An entry above the diagonal is that below it the other way round.
void SectionStiffness::add(int difference, int row, int column, double value) {
  if (row < column) {
    std::swap(row, column);
    difference = -difference;
  }
  Entry entry{column, row, kind(row, column)};
  (difference == 0 ? entry.own : difference > 0 ? entry.ahead : entry.behind) = value;
  entries_.push_back(entry);
}

void SectionStiffness::sum_equal_places() {
  const auto place = [](const Entry& e) { return std::tie(e.column, e.row); };
  std::ranges::stable_sort(entries_, {}, place);
  std::vector<Entry> summed;
  for (const Entry& e : entries_) {
    if (summed.empty() || place(summed.back()) != place(e)) {
      summed.push_back(e);
      continue;
    }
    summed.back().own += e.own;
    summed.back().ahead += e.ahead;
    summed.back().behind += e.behind;
  }
  entries_ = std::move(summed);
}

constexpr int n_kinds = 16;

int SectionStiffness::kind(int row, int column) const {
  const auto of = [&](int unknown) {
    const auto& image = azimuth_.unknowns[unknown];
    return 2 * image.ahead + (image.sign < 0);
  };
  return 4 * of(row) + of(column);
}

bool SectionStiffness::is_mirror_symmetric() const {
  constexpr double rounding = 1e-10;
  std::vector<double> scale(azimuth_.unknowns.size(), 0.0);
  for (const Entry& e : entries_)
    if (e.row == e.column) scale[e.row] = std::sqrt(std::abs(e.own));
  return std::ranges::all_of(entries_, [&](const Entry& e) {
    const auto &row = azimuth_.unknowns[e.row], &column = azimuth_.unknowns[e.column];
    for (int difference = -2; difference <= 2; ++difference) {
      const double image = row.sign * column.sign * e.at(row.ahead - column.ahead - difference);
      if (!(std::abs(e.at(difference) - image) <= rounding * scale[e.row] * scale[e.column])) return false;
    }
    return true;
  });
}

SparseSymmetric SectionStiffness::of_harmonic(const MirrorBasis& basis, std::complex<double> forward) const {
  struct Factors {
    double own, ahead, behind;
  };
  std::array<std::optional<Factors>, n_kinds> factors;
  const int n = static_cast<int>(azimuth_.unknowns.size());
  SparseSymmetric result{n, std::vector<int>(n + 1, 0), {}, {}};
  result.rows.reserve(entries_.size());
  result.values.reserve(entries_.size());
  for (const Entry& e : entries_) {
    auto& of_kind = factors[e.kind];
    if (!of_kind) {
      const auto factor = [&](std::complex<double> a) { return basis.of_own_images(e.row, e.column, a); };
      of_kind = Factors{factor(1), factor(forward), factor(std::conj(forward))};
    }
    ++result.column_start[e.column + 1];
    result.rows.push_back(e.row);
    result.values.push_back(e.own * of_kind->own + e.ahead * of_kind->ahead + e.behind * of_kind->behind);
  }
  for (int j = 0; j < n; ++j) result.column_start[j + 1] += result.column_start[j];
  return result;
}

}  // namespace wheelwright
