#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace wheelwright {

/// An image of pixels, row by row from the top, each of red, green and blue.
struct Image {
  int width, height;
  std::vector<std::uint8_t> rgb;
};

/// The picture as a PNG file. Throws std::runtime_error.
std::string png_file(const Image& image);

/// The same as the value of an SVG image's href.
std::string data_url(const Image& image);

}  // namespace wheelwright
