#include "tests/fuzz/target.h"
#include "wheelwright/base/text.h"
#include "wheelwright/cad/drawing/composition.h"
#include "wheelwright/cad/drawing/drawing.h"
#include "wheelwright/cad/drawing/picture_outline.h"

using namespace wheelwright;
using namespace wheelwright::testing;

namespace {

void check_problems(const std::vector<DrawingProblem>& problems) {
  for (const DrawingProblem& problem : problems) {
    require(problem.line >= 0, "a line is counted from 1");
    require(!problem.problem.empty(), "a problem says what is wrong");
    require(problem.problem == without_control_characters(problem.problem), "a problem is one line of text");
  }
}

/// What was read is closed, and can be composed.
void check_outline(const DrawnOutline& outline) {
  for (const DrawnLoop& loop : outline.loops)
    for (std::size_t i = 0; i < loop.curves.size(); ++i)
      require(loop.curves[i].end() == loop.curves[(i + 1) % loop.curves.size()].start(), "a loop is closed");
  const Composition shape({{Fill::hole, {outline}}});
  const Box bounds = box(outline);
  require(!shape.is_hole(bounds.high + Point{bounds.size(), 0.1 * bounds.size()}),
          "nothing is drawn outside");
}

void try_drawing(DrawingFormat format, const std::string& bytes) {
  const DrawingResult result = read_drawing(format, bytes, {1e-3, Point{0, 0}});
  require(result.value.has_value() == result.problems.empty(), "a drawing, or problems");
  check_problems(result.problems);
  if (result.value) check_outline(result.value->outline);
}

void try_picture(const std::string& bytes) {
  const PictureResult result = read_png(bytes);
  require(result.value.has_value() == result.problems.empty(), "a picture, or problems");
  check_problems(result.problems);
  constexpr long long few = 10000;
  if (result.value && static_cast<long long>(result.value->columns) * result.value->rows <= few) {
    check_outline(wheel_outline(*result.value, 0.5, 0.7));
    check_outline(ring_outline(*result.value, 0.5, 3, 0.2, 0.3));
  }
}

}  // namespace

std::vector<std::string> wheelwright::testing::seeds() {
  return {
      "<svg width='9mm' height='9mm' viewBox='0 0 9 9'><path d='M1,1 h3 q3,3 0,3 t-3,1 z M6,6a1,1 0 1 1 "
      "1,1z'/></svg>",
      "<svg><g transform='rotate(3)scale(2)'><rect id='a' width='3' height='2' rx='1'/></g><use href='#a' "
      "y='5'/></svg>",
      "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n70\n1\n10\n0\n20\n0\n42\n1\n10\n9\n20\n0\n0\nENDSEC\n0\nEOF"
      "\n"};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try_drawing(DrawingFormat::svg, bytes);
  try_drawing(DrawingFormat::dxf, bytes);
  try_picture(bytes);
  return 0;
}
