#include <algorithm>
#include <cmath>

#include "tests/fuzz/target.h"
#include "wheelwright/base/text.h"
#include "wheelwright/case/derived.h"
#include "wheelwright/case/drawn_shapes.h"
#include "wheelwright/case/keys.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/run/study/case_report.h"
#include "wheelwright/run/study/problem_size.h"

using namespace wheelwright;
using namespace wheelwright::testing;

namespace {

void check_problems(const CaseResult& result, std::string_view text) {
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  int last = 0;
  for (const Diagnostic& problem : result.problems) {
    if (problem.file != "fuzz.toml") continue;  // it stands in a drawing
    require(problem.line > 0 && problem.line <= lines, "a problem stands on a line of the file");
    require(problem.line >= last, "problems come in the order of the file");
    require(problem.text() == without_control_characters(problem.text()), "a problem is one line of text");
    last = problem.line;
  }
}

void check_case(const Case& c) {
  const CaseResult again = parse_case(to_toml(c), "again.toml");
  require(again.value == c, "a resolved case reads back equal");
  require(std::isfinite(estimated_memory(problem_size(c))) && estimated_memory(problem_size(c)) > 0,
          "memory is a number");
  require(derived_report(c).find("nan") == std::string::npos, "derived numbers are numbers");
  warnings(c);
  Composition(figures(c));
}

}  // namespace

std::vector<std::string> wheelwright::testing::seeds() {
  Case c;
  c.holes.rings = {ring_sections().example};
  c.holes.circles = {circle_sections().example};
  for_each_shape_section([&](const auto& section) {
    section.in(c) = {section.example};
    section.in(c)[0].order = 1;
  });
  return {case_template(), to_toml(c)};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const CaseResult result = parse_case(text, "fuzz.toml");
  require(result.value.has_value() == result.problems.empty(), "a case, or problems");
  check_problems(result, text);
  if (result.value) check_case(*result.value);
  return 0;
}
