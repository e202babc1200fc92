#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/cad/curves/curve.h"

namespace wheelwright {

/// A part of an SVG path between two moves.
struct Subpath {
  std::vector<Curve> curves;  ///< each begins where the one before it ends
  bool closed;                ///< by the command Z
};

/// A mistake in a text, and the number of characters before it.
struct TextMistake {
  std::size_t at;
  std::string problem;
};

struct SvgPath {
  std::vector<Subpath> subpaths;
  std::optional<TextMistake> mistake;  ///< the path ends before it, as SVG says
};

/// Reads path data: all commands of SVG 1.1 and 2.
SvgPath parse_svg_path(std::string_view data);

/// Reads a list of transforms, e.g. "translate(1,2) rotate(30)"; nothing if it is not one.
std::optional<Affine> parse_svg_transform(std::string_view text);

/// Reads numbers that are separated by white space or commas; nothing if there is anything else.
std::optional<std::vector<double>> parse_svg_numbers(std::string_view text);

/// A length and its unit as written, e.g. "12.5mm"; the unit may be empty.
struct SvgLength {
  double value;
  std::string unit;
};
std::optional<SvgLength> parse_svg_length(std::string_view text);

}  // namespace wheelwright
