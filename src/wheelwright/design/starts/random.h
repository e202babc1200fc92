#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace wheelwright {

/// Random numbers that are the same on every machine: a Mersenne twister, and our own distributions.
class Random {
 public:
  /// The sequence with a number; sequences with different numbers are independent.
  Random(std::uint64_t seed, std::uint64_t number) {
    std::seed_seq words{low_word(seed), high_word(seed), low_word(number), high_word(number)};
    engine_.seed(words);
  }

  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * fraction(); }

  /// The same, uniform in the logarithm.
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

  /// One of 0, ..., n - 1.
  int below(int n) { return static_cast<int>(fraction() * n); }

  bool coin() { return below(2) == 1; }

 private:
  static std::uint32_t low_word(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
  static std::uint32_t high_word(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }

  /// In [0, 1), with 53 bits.
  double fraction() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  std::mt19937_64 engine_;
};

}  // namespace wheelwright
