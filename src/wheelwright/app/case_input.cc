#include "wheelwright/app/case_input.h"

#include <fmt/format.h>

#include "wheelwright/app/case_report.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/memory.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/base/parallel.h"
#include "wheelwright/case/read.h"

namespace wheelwright {
namespace {

/// For the rest of the program: where a limit is lifted TBB starts threads, and ends the program when there
/// is no memory for them. The pointer stays, so that the leak sanitizer finds what it holds.
void limit_threads(int n_threads) {
  static const ThreadLimit* volatile limit = new ThreadLimit(n_threads);
  static_cast<void>(limit);
}

}  // namespace

std::optional<Case> read_or_tell(const std::filesystem::path& file) {
  CaseResult result = read_case(file);
  if (result.value) return std::move(result.value);
  const std::size_t n = result.problems.size();
  for (const Diagnostic& problem : result.problems) tell("{}\n", problem.text());
  tell("{}\n",
       styled(stderr, Style::red, fmt::format("{}: {} problem{}", file.string(), n, n == 1 ? "" : "s")));
  return {};
}

void print_warning(std::FILE* stream, const std::string& text) {
  std::fputs(fmt::format("{} {}\n", styled(stream, Style::yellow, "warning:"), text).c_str(), stream);
}

void print_warnings(std::FILE* stream, const Case& c) {
  for (const std::string& text : warnings(c)) print_warning(stream, text);
}

bool may_compute(const std::string& command, const Case& c, const std::filesystem::path& file,
                 std::optional<int> threads) {
  print_warnings(stderr, c);
  if (const auto lack = lack_of_memory(c, available_memory())) {
    tell("wheelwright {}: {}: {}\n", command, file.string(), *lack);
    return false;
  }
  if (threads) limit_threads(*threads);
  return true;
}

int tell_failure(const std::string& command, const Failure& failure) {
  tell("wheelwright {}: {}: {}\n", command, to_string(failure.reason), failure.detail);
  return exit_no_solution;
}

}  // namespace wheelwright
