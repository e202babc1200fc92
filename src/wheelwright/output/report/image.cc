#include "wheelwright/output/report/image.h"

#include <png.h>

#include <stdexcept>

#include "wheelwright/files/base64.h"

namespace wheelwright {

std::string png_file(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0)
    throw std::runtime_error(std::string("the picture could not be encoded: ") + header.message);
  bytes.resize(size);
  return bytes;
}

std::string data_url(const Image& image) { return "data:image/png;base64," + base64(png_file(image)); }

}  // namespace wheelwright
