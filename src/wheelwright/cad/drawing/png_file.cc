#include "wheelwright/cad/drawing/png_file.h"

#include <fmt/format.h>
#include <png.h>

#include <cstdint>

namespace wheelwright {

namespace {

PictureResult refused(std::string problem, std::string remedy) {
  return {std::nullopt, {{0, std::move(problem), std::move(remedy)}}};
}

/// Over white, as a screen shows it; the weights of the colours are those of sRGB.
float darkness(const std::uint8_t* rgba) {
  const float luma = 0.2126F * static_cast<float>(rgba[0]) + 0.7152F * static_cast<float>(rgba[1]) +
                     0.0722F * static_cast<float>(rgba[2]);
  return static_cast<float>(rgba[3]) / 255 * (1 - luma / 255);
}

}  // namespace

PictureResult read_png(std::string bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
    return refused(fmt::format("this is no PNG that can be read: {}", image.message),
                   "save the picture as PNG");
  const long long pixels = static_cast<long long>(image.width) * image.height;
  if (pixels > most_pixels) {
    png_image_free(&image);
    return refused(fmt::format("{} x {} pixels are too many", image.width, image.height),
                   fmt::format("use at most {} pixels", most_pixels));
  }
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> rgba(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, rgba.data(), 0, nullptr) == 0)
    return refused(fmt::format("the PNG is damaged: {}", image.message), "save the picture again");
  Picture picture{std::move(bytes), static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.darkness.reserve(pixels);
  for (long long i = 0; i < pixels; ++i) picture.darkness.push_back(darkness(&rgba[4 * i]));
  return {std::move(picture), {}};
}

}  // namespace wheelwright
