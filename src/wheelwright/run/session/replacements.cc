#include "wheelwright/run/session/replacements.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/files/level_set_file.h"
#include "wheelwright/shape/evolution/regrid.h"

namespace wheelwright {
namespace {

std::string problem_text(const Diagnostic& d) {
  return fmt::format("{}{}{}: {}{}{}", d.key, d.value.empty() ? "" : " = ", d.value, d.problem,
                     d.remedy.empty() ? "" : "; ", d.remedy);
}

/// The level set in a file.
template <int dim>
Expected<LevelSet<dim>, Refusal> read_shape(const std::filesystem::path& file) {
  constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 28;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || std::filesystem::file_size(file, error) > most_bytes)
    return Refusal{fmt::format("{}: there is no shape", file.string())};
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  auto shape = parse_level_set_file<dim>(bytes);
  if (!shape) return Refusal{fmt::format("{}: {}", file.string(), shape.failure().detail)};
  return *std::move(shape);
}

/// Whether shapes on one grid fit the other: same ring and same sectors.
template <int dim>
bool is_same_wheel(const PolarGrid<dim>& a, const PolarGrid<dim>& b) {
  constexpr double near = 1e-9;
  const bool is_as_wide = dim == 2 || std::abs(a.width - b.width) <= near * b.width;
  return a.n_sectors == b.n_sectors && is_as_wide && std::abs(a.inner_radius - b.inner_radius) <= near &&
         std::abs(a.outer_radius - b.outer_radius) <= near;
}

}  // namespace

Refusal refusal(const Failure& failure) { return {to_string(failure)}; }

Expected<Case, Refusal> accepted_case(const Case& c, const std::filesystem::path& file) {
  CaseResult result = parse_case(to_toml(c), file, c.vocabulary);
  if (result.value) return *std::move(result.value);
  std::string reason;
  for (const Diagnostic& problem : result.problems)
    reason += (reason.empty() ? "" : "; ") + problem_text(problem);
  return Refusal{reason};
}

template <int dim>
Expected<LevelSet<dim>, Refusal> drawn_over(const LevelSet<dim>& shape, std::span<const Stroke> strokes,
                                            const Evolver<dim>& evolver, double largest_island) {
  LevelSet<dim> drawn = shape;
  for (const Stroke& stroke : strokes) drawn = with_stroke(drawn, stroke);
  auto smooth = evolver.distance(evolver.keep_bands(drawn));
  if (!smooth) return refusal(smooth.failure());
  auto attached = evolver.without_islands(*smooth, largest_island);
  if (!attached) return refusal(attached.failure());
  return std::move(attached->psi);
}

template <int dim>
Expected<LevelSet<dim>, Refusal> shape_of_file(const std::filesystem::path& file, const Lattice<dim>& lattice,
                                               const Evolver<dim>& evolver) {
  const auto shape = read_shape<dim>(file);
  if (!shape) return shape.failure();
  if (!is_same_wheel(shape->lattice.grid(), lattice.grid()))
    return Refusal{fmt::format("{}: its wheel has other radii or another number of sectors", file.string())};
  return evolver.keep_bands(regrid(*shape, lattice));
}

template decltype(drawn_over<2>) drawn_over<2>;
template decltype(drawn_over<3>) drawn_over<3>;
template decltype(shape_of_file<2>) shape_of_file<2>;
template decltype(shape_of_file<3>) shape_of_file<3>;

}  // namespace wheelwright
