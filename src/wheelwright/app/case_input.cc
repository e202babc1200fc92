#include "wheelwright/app/case_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/memory.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/run/study/case_report.h"

namespace wheelwright {
namespace {

/// Holds for the rest of the program: TBB starts threads when a limit is lifted, and aborts if there is no
/// memory for them. The pointer is kept so that the leak sanitizer finds the object.
void limit_threads(int n_threads) {
  static const ThreadLimit* volatile limit = new ThreadLimit(n_threads);
  static_cast<void>(limit);
}

/// Tells what to do with a file whose extension is that of a drawing or a saved shape; empty for others.
std::string why_no_case(const std::filesystem::path& file) {
  const std::string extension = file.extension().string(), name = file.string();
  if (extension == std::filesystem::path(saved_shape_file).extension())
    return fmt::format(
        "a saved shape has no load and no material: refer to it in a case by [shape] from = \"{}\", or pass "
        "the folder of its run",
        name);
  if (extension == ".svg" || extension == ".dxf")
    return fmt::format(
        "a drawing has no load and no material: write a case with `wheelwright init my-wheel.toml`, and "
        "refer to "
        "the drawing in it by [[shape.file]] path = \"{}\"",
        name);
  return {};
}

}  // namespace

CaseResult read_case_file(const std::filesystem::path& file) {
  if (const std::string reason = why_no_case(file); !reason.empty())
    return {{},
            {{.kind = Diagnostic::Kind::unreadable, .file = file.string(), .problem = reason, .remedy = {}}}};
  return read_case(file);
}

void print_problems(const std::filesystem::path& file, const std::vector<Diagnostic>& problems) {
  constexpr std::size_t max_shown = 100;
  const std::size_t n = problems.size();
  for (std::size_t i = 0; i < std::min(n, max_shown); ++i) print_err("{}\n", problems[i].text());
  if (n == 1 && problems.front().line == 0) return;  // of the file as a whole: there is nothing to count
  const std::string more = n > max_shown ? fmt::format("; {} of them are not shown", n - max_shown) : "";
  print_err("{}\n", styled(stderr, Style::red,
                           fmt::format("{}: {} problem{}{}", file.string(), n, n == 1 ? "" : "s", more)));
}

std::optional<Case> read_or_report(const std::filesystem::path& file) {
  CaseResult result = read_case_file(file);
  if (!result.value) print_problems(file, result.problems);
  return std::move(result.value);
}

void warn_about(const std::string& wheel, const std::string& text) {
  print_warning(stderr, fmt::format("{}: {}", wheel, text));
}

void print_warning(std::FILE* stream, const std::string& text) {
  print_to(stream, "{} {}\n", styled(stream, Style::yellow, "warning:"), text);
}

bool may_compute(const std::string& command, const Case& c, const std::filesystem::path& file,
                 std::optional<int> threads) {
  for (const std::string& text : warnings(c)) warn_about(file.string(), text);
  const int n_threads = threads.value_or(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
  for (const auto& lack :
       {lack_of_memory(c, available_memory()), lack_of_address_space(c, n_threads, address_space_left())}) {
    if (!lack) continue;
    print_err("wheelwright {}: {}: {}\n", command, file.string(), *lack);
    return false;
  }
  if (threads) limit_threads(*threads);
  return true;
}

int report_failure(const std::string& command, const Failure& failure) {
  print_err("wheelwright {}: {}\n", command, to_string(failure));
  return exit_no_solution;
}

}  // namespace wheelwright
