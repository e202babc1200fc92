#include "wheelwright/app/shared_options.h"

#include "wheelwright/case/keys.h"

namespace wheelwright {
namespace {

Options::Limits limits_of_iterations() {
  const auto* key = find_key(optimizer_section().keys, "iterations");
  const Range range = std::get<IntegerField<Optimizer>>(key->field).range;
  return {static_cast<int>(range.low), static_cast<int>(range.high)};
}

}  // namespace

void add_case(Options& options, std::string& file) { options.argument("CASE", file, "case file"); }

void add_threads(Options& options, std::optional<int>& threads) {
  constexpr int max_threads = 1024;
  options.number(
      "--threads", threads, {1, max_threads},
      "Number of threads; default and maximum: the number of processors. Results do not depend on it");
}

void add_iterations(Options& options, std::optional<int>& iterations) {
  options.number(
      "--iterations", iterations, limits_of_iterations(),
      "Number of shapes, instead of the case's optimizer.iterations; expectations about later shapes, "
      "or the last one, are not checked");
}

void add_output(Options& options, std::optional<std::string>& folder, const std::string& meaning) {
  options.text("--output", "DIR", folder, not_empty, meaning);
}

void add_verbose(Options& options, bool& verbose) {
  options.flag("--verbose", verbose, "Show every trial shape, with the reason if it is rejected");
}

void add_events(Options& options, std::optional<std::string>& format) {
  options.text(
      "--events", "json", format,
      [](const std::string& text) { return text == "json" ? "" : "must be json"; },
      "Print only what happens, as one JSON object per line, for a program (docs/driving.md)");
}

void add_without_errors(Options& options, bool& without_errors) {
  options.flag("--without-errors", without_errors,
               "Do not solve on a finer grid too, from which the errors of the numbers are estimated");
}

std::string not_empty(const std::string& text) { return text.empty() ? "must not be empty" : ""; }

}  // namespace wheelwright
