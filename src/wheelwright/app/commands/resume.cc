#include "wheelwright/app/commands/resume.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#include "wheelwright/run/optimize_case.h"
#include "wheelwright/run/provenance.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// Why a checkpoint cannot be used, in words.
struct Unusable {
  std::string reason;
};

Expected<std::string, Unusable> read_file(const fs::path& file) {
  constexpr std::uintmax_t most_bytes = 1 << 30;
  std::error_code error;
  const auto size = fs::file_size(file, error);
  if (error) return Unusable{error.message()};
  if (size > most_bytes) return Unusable{"larger than any checkpoint"};
  std::string bytes(size, '\0');
  if (!std::ifstream(file, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(size)))
    return Unusable{"cannot be read"};
  return bytes;
}

/// The first line of a case in which `now` differs from `then`.
std::string first_difference(const std::string& then, const std::string& now) {
  std::istringstream lines_then(then), lines_now(now);
  std::string a, b;
  while (std::getline(lines_then, a) && std::getline(lines_now, b))
    if (a != b) return fmt::format("it said \"{}\" and now says \"{}\"", a, b);
  return "it has other keys";
}

/// A checkpoint of this case whose history is there.
Expected<Checkpoint<2>, Unusable> read_checkpoint(const fs::path& file, const Case& c,
                                                  const fs::path& history) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.failure();
  auto checkpoint = parse_checkpoint_file<2>(*bytes);
  if (!checkpoint)
    return Unusable{
        fmt::format("{}: {}", to_string(checkpoint.failure().fault), checkpoint.failure().detail)};
  const std::string &then = checkpoint->provenance.resolved_case, now = provenance(c).resolved_case;
  if (then != now) return Unusable{fmt::format("written for another case: {}", first_difference(then, now))};
  const Lattice<2> lattice = initial_shape(c).lattice;
  for (const LevelSet<2>* psi : {&checkpoint->state.shape, &checkpoint->initial.shape})
    if (psi->lattice.grid() != lattice.grid() || psi->lattice.degree() != lattice.degree())
      return Unusable{"its shape stands on another grid than the case's"};
  if (!History::holds(history, checkpoint->history))
    return Unusable{fmt::format("{} does not hold the rows that were written before it", history.string())};
  return *std::move(checkpoint);
}

/// The newest checkpoint that can be used; says what is wrong with those that cannot.
std::optional<Checkpoint<2>> newest_usable(CheckpointFolder& folder, const Case& c, const fs::path& history) {
  for (const fs::path& file : folder.files()) {
    auto checkpoint = read_checkpoint(file, c, history);
    if (checkpoint) {
      folder.keep(file);
      return *std::move(checkpoint);
    }
    tell("{}: cannot be used, trying the one before it: {}\n", file.string(), checkpoint.failure().reason);
  }
  return {};
}

bool is_finished(const Checkpoint<2>& checkpoint, const Case& c) {
  if (!checkpoint.finished) return false;
  return checkpoint.finished == StopReason::no_descent ||
         reason_to_stop(optimizer_options(c), checkpoint.state);
}

int tell_finished(const Checkpoint<2>& checkpoint, const Case& c, const fs::path& folder) {
  fmt::print("{}: finished: {} shapes ({})\n", folder.string(), checkpoint.state.iteration,
             to_string(*checkpoint.finished));
  if (checkpoint.finished == StopReason::iterations)
    fmt::print("to go further: wheelwright resume {} --iterations N\n", folder.string());
  return report_expectations(c, checkpoint);
}

/// Whether the history tells of trials after the initial shape, which is saved before them.
bool has_trials(const fs::path& history) {
  constexpr std::ptrdiff_t header_and_initial_shape = 2;
  std::ifstream file(history, std::ios::binary);
  return std::count(std::istreambuf_iterator<char>(file), {}, '\n') > header_and_initial_shape;
}

/// For a run without any checkpoint: it was killed before the first, or its checkpoints were removed.
int begin_again(const Case& c, const fs::path& folder, const fs::path& history) {
  if (has_trials(history)) {
    tell("{}: its checkpoints are gone; it cannot go on\n", folder.string());
    return exit_checkpoint;
  }
  tell("{}: no checkpoint yet; the run begins\n", folder.string());
  return optimize_case(c, {folder, CheckpointFolder(folder)});
}

int go_on(const Case& c, const fs::path& folder) {
  const fs::path history = folder / "history.csv";
  CheckpointFolder checkpoints(folder);
  if (!checkpoints.exists()) return begin_again(c, folder, history);
  const auto checkpoint = newest_usable(checkpoints, c, history);
  if (!checkpoint) {
    tell("{}: no checkpoint can be used\n", folder.string());
    return exit_checkpoint;
  }
  if (is_finished(*checkpoint, c)) return tell_finished(*checkpoint, c, folder);
  if (checkpoint->provenance.program != program_text())
    tell("warning: saved by {}; the last digits may differ from a run without a stop\n",
         checkpoint->provenance.program);
  tell("{}: going on after shape {}\n", folder.string(), checkpoint->state.iteration);
  return optimize_case(c, {folder, checkpoints, checkpoint});
}

}  // namespace

int resume_command(const Case& c, const RunOptions& options) {
  return in_locked_folder(options.run_folder, [&] { return go_on(c, options.run_folder); });
}

}  // namespace wheelwright
