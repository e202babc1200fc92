#include "wheelwright/run/checkpoints/resume_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "wheelwright/case/derived.h"
#include "wheelwright/case/design_radii.h"
#include "wheelwright/run/checkpoints/provenance.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;

/// Why a checkpoint is unusable, as text.
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

/// Whether the remembered moves are vectors or speeds, and of radii, as the case requires.
template <int dim>
bool has_moves_of(const Case& c, const OptimizationState<dim>& state) {
  const size_t per_node = velocity_kind(c) == VelocityKind::vector ? dim : 1,
               n_radii = design_radii(c).size();
  return std::ranges::all_of(state.memory.pairs, [&](const CurvaturePair& pair) {
    return pair.move.size() == per_node * state.shape.values.size() + n_radii;
  });
}

template <int dim>
Expected<Checkpoint<dim>, Unusable> read_checkpoint(const fs::path& file, const Case& c,
                                                    const fs::path& history) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.failure();
  auto checkpoint = parse_checkpoint_file<dim>(*bytes);
  if (!checkpoint)
    return Unusable{
        fmt::format("{}: {}", to_string(checkpoint.failure().fault), checkpoint.failure().detail)};
  const std::string &then = checkpoint->provenance.resolved_case, now = provenance(c).resolved_case;
  if (then != now) return Unusable{fmt::format("written for another case: {}", first_difference(then, now))};
  if (!level_of(c, checkpoint->state.shape) || level_of(c, checkpoint->initial.shape) != 0)
    return Unusable{"its shape is on another grid than the case's"};
  if (!has_moves_of(c, checkpoint->state))
    return Unusable{"its moves of the boundary are not of the case's kind"};
  if (!History::holds(history, checkpoint->history))
    return Unusable{
        fmt::format("{} does not contain the rows that were written before it", history.string())};
  return *std::move(checkpoint);
}

}  // namespace

template <int dim>
ResumePoint<dim> resume_point(const fs::path& folder, const Case& c) {
  ResumePoint<dim> point{CheckpointFolder(folder), {}, {}};
  for (const fs::path& file : point.checkpoints.files()) {
    auto checkpoint = read_checkpoint<dim>(file, c, folder / history_file);
    if (checkpoint) {
      point.checkpoints.keep(file);
      point.newest = *std::move(checkpoint);
      break;
    }
    point.unusable.push_back({file, checkpoint.failure().reason});
  }
  return point;
}

template decltype(resume_point<2>) resume_point<2>;
template decltype(resume_point<3>) resume_point<3>;

}  // namespace wheelwright
