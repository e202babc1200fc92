#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace wheelwright {

/// tan(delta) of a material: the energy that a cycle of harmonic strain loses, over 2 pi times its elastic
/// energy at the largest strain. It may depend on the frequency.
class LossFactor {
 public:
  using Point = std::array<double, 2>;  ///< frequency [Hz], tan(delta)

  /// The same at every frequency.
  explicit(false) LossFactor(double number = 0) : number_(number) {}

  /// Between points of ascending frequencies > 0 linear in the logarithm of the frequency, beyond them as at
  /// the next one.
  explicit LossFactor(std::vector<Point> table) : table_(std::move(table)) {}

  /// At a frequency [Hz].
  double at(double frequency) const {
    if (table_.empty()) return number_;
    const auto next = std::ranges::upper_bound(table_, frequency, {}, [](const Point& p) { return p[0]; });
    if (next == table_.begin()) return table_.front()[1];
    if (next == table_.end()) return table_.back()[1];
    const Point &from = *(next - 1), &to = *next;
    return from[1] + std::log(frequency / from[0]) / std::log(to[0] / from[0]) * (to[1] - from[1]);
  }

  double largest() const {
    return table_.empty() ? number_ : std::ranges::max(table_, {}, [](const Point& p) { return p[1]; })[1];
  }

  /// Empty if it does not depend on the frequency.
  const std::vector<Point>& table() const { return table_; }

  bool operator==(const LossFactor&) const = default;

 private:
  double number_ = 0;
  std::vector<Point> table_;
};

}  // namespace wheelwright
