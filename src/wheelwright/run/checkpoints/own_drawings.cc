#include "wheelwright/run/checkpoints/own_drawings.h"

#include <fmt/format.h>

#include "wheelwright/cad/drawing/drawing.h"
#include "wheelwright/cad/drawing/png_file.h"
#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/level_set_file.h"

namespace wheelwright {

namespace {
constexpr const char* folder_of_drawings = "drawings";
}

Case with_own_drawings(Case c) {
  int number = 0;
  for (FileShape& shape : c.shapes.files)
    shape.path = fmt::format("{}/drawing_{}.{}", folder_of_drawings, ++number,
                             drawing_format(shape.path) == DrawingFormat::dxf ? "dxf" : "svg");
  number = 0;
  for (PictureShape& shape : c.shapes.pictures)
    shape.path = fmt::format("{}/picture_{}.png", folder_of_drawings, ++number);
  if (!c.saved_shape.from.empty())
    c.saved_shape.from = fmt::format("{}/{}", folder_of_drawings, saved_shape_file);
  return c;
}

void write_drawings(const std::filesystem::path& folder, const Case& c) {
  if (c.shapes.files.empty() && c.shapes.pictures.empty() && c.saved_shape.from.empty()) return;
  make_subfolder(folder / folder_of_drawings);
  for (const FileShape& shape : c.shapes.files)
    if (shape.drawing.contents) write_atomically(folder / shape.path, shape.drawing.contents->bytes);
  for (const PictureShape& shape : c.shapes.pictures)
    if (shape.picture.contents) write_atomically(folder / shape.path, shape.picture.contents->bytes);
  if (c.saved_shape.shape.contents)
    write_atomically(
        folder / c.saved_shape.from,
        std::visit([](const auto& shape) { return level_set_file(shape); }, *c.saved_shape.shape.contents));
}

}  // namespace wheelwright
