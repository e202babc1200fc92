#include "wheelwright/case/load_drawings.h"

#include "wheelwright/cad/drawing/drawing.h"
#include "wheelwright/cad/drawing/png_file.h"
#include "wheelwright/case/case_key.h"
#include "wheelwright/case/named_file.h"

namespace wheelwright {

namespace {

namespace fs = std::filesystem;
using Kind = Diagnostic::Kind;
using Problems = std::vector<FileProblem>;

std::string key_of_problem(DrawingProblem::Key key, std::size_t i) {
  switch (key) {
    case DrawingProblem::Key::unit:
      return key_of(&FileShape::unit, i).path();
    case DrawingProblem::Key::axle:
      return key_of(&FileShape::axle, i).path();
    default:
      return key_of(&FileShape::path, i).path();
  }
}

/// Adds a problem in a drawing: on the line of its key, or in the file.
void add(const DrawingProblem& found, std::string key, const fs::path& file, Problems& problems) {
  const bool of_case = found.key != DrawingProblem::Key::none;
  problems.push_back({of_case ? Kind::conflict : Kind::drawing, std::move(key), of_case ? "" : file.string(),
                      found.line, found.problem, found.remedy});
}

void load(FileShape& shape, const fs::path& folder, std::size_t i, Problems& problems) {
  const std::string path_key = key_of(&FileShape::path, i).path();
  const auto format = drawing_format(shape.path);
  if (!format) {
    problems.push_back({Kind::out_of_range, path_key, "", 0, "the name of a drawing must end in .svg or .dxf",
                        "save it as SVG or DXF; pictures belong in [[shape.picture]]"});
    return;
  }
  const fs::path file = folder / shape.path;
  auto bytes = read_named_file(file, path_key, most_drawing_bytes, problems);
  if (!bytes) return;
  check_checksum(shape.checksum, *bytes, key_of(&FileShape::checksum, i).path(), problems);
  DrawingResult result = read_drawing(*format, *std::move(bytes), {metres(shape.unit), shape.axle});
  for (const DrawingProblem& found : result.problems)
    add(found, key_of_problem(found.key, i), file, problems);
  if (result.value) shape.drawing.contents = std::make_shared<const Drawing>(*std::move(result.value));
}

void load(PictureShape& shape, const fs::path& folder, std::size_t i, Problems& problems) {
  const std::string path_key = key_of(&PictureShape::path, i).path();
  const fs::path file = folder / shape.path;
  auto bytes = read_named_file(file, path_key, most_drawing_bytes, problems);
  if (!bytes) return;
  check_checksum(shape.checksum, *bytes, key_of(&PictureShape::checksum, i).path(), problems);
  PictureResult result = read_png(*std::move(bytes));
  for (const DrawingProblem& found : result.problems) add(found, path_key, file, problems);
  if (result.value) shape.picture.contents = std::make_shared<const Picture>(*std::move(result.value));
}

}  // namespace

std::optional<double> metres(DrawingUnit unit) {
  switch (unit) {
    case DrawingUnit::of_file:
      return {};
    case DrawingUnit::metre:
      return 1;
    case DrawingUnit::centimetre:
      return 1e-2;
    case DrawingUnit::millimetre:
      return 1e-3;
    case DrawingUnit::inch:
      return 0.0254;
  }
  return {};
}

std::vector<FileProblem> load_drawings(Case& c, const fs::path& folder,
                                       const std::function<bool(const std::string&)>& may_be_read) {
  Problems problems;
  const auto load_all = [&](const auto& section) {
    auto& shapes = section.in(c);
    using Shape = typename std::decay_t<decltype(shapes)>::value_type;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      if (may_be_read(table_of<Shape>(i).path())) load(shapes[i], folder, i, problems);
  };
  load_all(file_shape_sections());
  load_all(picture_shape_sections());
  return problems;
}

}  // namespace wheelwright
