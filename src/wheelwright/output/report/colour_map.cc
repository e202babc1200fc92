#include "wheelwright/output/report/colour_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wheelwright {

namespace {

using Rgb = std::array<int, 3>;

/// The colour at t in [0, 1] between knots at equal distances.
template <std::size_t n>
Rgb between(const std::array<Rgb, n>& knots, double t) {
  if (std::isnan(t)) return {0xbb, 0xbb, 0xbb};
  const double position = std::clamp(t, 0.0, 1.0) * (n - 1);
  const int k = std::min<int>(position, n - 2);
  Rgb colour;
  for (int c = 0; c < 3; ++c) colour[c] = std::lround(std::lerp(knots[k][c], knots[k + 1][c], position - k));
  return colour;
}

std::string hexadecimal(const Rgb& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

}  // namespace

std::array<int, 3> viridis_rgb(double t) {
  static constexpr std::array<Rgb, 10> knots{{{0x44, 0x01, 0x54},
                                              {0x48, 0x28, 0x78},
                                              {0x3e, 0x4a, 0x89},
                                              {0x31, 0x68, 0x8e},
                                              {0x26, 0x82, 0x8e},
                                              {0x1f, 0x9e, 0x89},
                                              {0x35, 0xb7, 0x79},
                                              {0x6d, 0xcd, 0x59},
                                              {0xb4, 0xde, 0x2c},
                                              {0xfd, 0xe7, 0x25}}};
  return between(knots, t);
}

std::string viridis(double t) { return hexadecimal(viridis_rgb(t)); }

std::string blue_to_red(double t) {
  static constexpr std::array<Rgb, 5> knots{
      {{0x0b, 0x3c, 0x8c}, {0x6f, 0x9f, 0xd8}, {0xfa, 0xfa, 0xfa}, {0xe0, 0x82, 0x5f}, {0x92, 0x12, 0x1e}}};
  return hexadecimal(between(knots, 0.5 * (t + 1)));
}

}  // namespace wheelwright
