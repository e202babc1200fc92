#include "wheelwright/report/colour_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wheelwright {

std::string viridis(double t) {
  using Rgb = std::array<int, 3>;
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
  if (std::isnan(t)) return "#bbbbbb";
  const double position = std::clamp(t, 0.0, 1.0) * (knots.size() - 1);
  const int k = std::min<int>(position, knots.size() - 2);
  Rgb colour;
  for (int c = 0; c < 3; ++c) colour[c] = std::lround(std::lerp(knots[k][c], knots[k + 1][c], position - k));
  return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
}

}  // namespace wheelwright
