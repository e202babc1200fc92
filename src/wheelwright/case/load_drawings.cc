#include "wheelwright/case/load_drawings.h"

#include <fmt/format.h>

#include <optional>

#include "wheelwright/cad/drawing/drawing.h"
#include "wheelwright/cad/drawing/png_file.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/named_file.h"

namespace wheelwright {

namespace {

namespace fs = std::filesystem;
using Kind = Diagnostic::Kind;
using Problems = std::vector<FileProblem>;

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

void add(const std::vector<DrawingProblem>& found, const std::string& key, const fs::path& file,
         Problems& problems) {
  for (const DrawingProblem& problem : found) {
    const bool of_case = problem.key != DrawingProblem::Key::none;
    const char* name = problem.key == DrawingProblem::Key::unit   ? ".unit"
                       : problem.key == DrawingProblem::Key::axle ? ".axle"
                                                                  : ".path";
    problems.push_back({of_case ? Kind::conflict : Kind::drawing, key + name, of_case ? "" : file.string(),
                        problem.line, problem.problem, problem.remedy});
  }
}

void load(FileShape& shape, const fs::path& folder, const std::string& key, Problems& problems) {
  const auto format = drawing_format(shape.path);
  if (!format) {
    problems.push_back({Kind::out_of_range, key + ".path", "", 0,
                        "the name of a drawing must end in .svg or .dxf",
                        "save it as SVG or DXF; pictures belong in [[shape.picture]]"});
    return;
  }
  const fs::path file = folder / shape.path;
  auto bytes = read_named_file(file, key + ".path", most_drawing_bytes, problems);
  if (!bytes) return;
  check_checksum(shape.checksum, *bytes, key, problems);
  DrawingResult result = read_drawing(*format, *std::move(bytes), {metres(shape.unit), shape.axle});
  add(result.problems, key, file, problems);
  if (result.value) shape.drawing.contents = std::make_shared<const Drawing>(*std::move(result.value));
}

void load(PictureShape& shape, const fs::path& folder, const std::string& key, Problems& problems) {
  const fs::path file = folder / shape.path;
  auto bytes = read_named_file(file, key + ".path", most_drawing_bytes, problems);
  if (!bytes) return;
  check_checksum(shape.checksum, *bytes, key, problems);
  PictureResult result = read_png(*std::move(bytes));
  add(result.problems, key, file, problems);
  if (result.value) shape.picture.contents = std::make_shared<const Picture>(*std::move(result.value));
}

}  // namespace

std::vector<FileProblem> load_drawings(Case& c, const fs::path& folder,
                                       const std::function<bool(const std::string&)>& may_be_read) {
  Problems problems;
  const auto load_all = [&](const auto& section) {
    int number = 0;
    for (auto& shape : section.in(c)) {
      const std::string key = fmt::format("{}[{}]", section.path(), ++number);
      if (may_be_read(key)) load(shape, folder, key, problems);
    }
  };
  load_all(file_shape_sections());
  load_all(picture_shape_sections());
  return problems;
}

}  // namespace wheelwright
