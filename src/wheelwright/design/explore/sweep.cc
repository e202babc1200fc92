#include "wheelwright/design/explore/sweep.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/case/case_key.h"
#include "wheelwright/case/number_text.h"
#include "wheelwright/case/read.h"
#include "wheelwright/case/set_number.h"
#include "wheelwright/case/write.h"
#include "wheelwright/run/study/parting_planes.h"

namespace wheelwright {
namespace {

constexpr std::size_t max_designs = 999;

/// With the grid sizes that a case file with the other keys would have by default.
Case with_default_grid(Case c, const GivenCells& given) {
  const Grid usual;
  if (!given.radial) c.grid.radial_cells = usual.radial_cells;
  if (!given.angular) c.grid.angular_cells = usual.angular_cells;
  if (!given.axial) c.grid.axial_cells = usual.axial_cells;
  return with_fitting_grid(std::move(c), given);
}

/// The sizes given by the case file or the sweep.
GivenCells with_swept(GivenCells given, const std::vector<SweptKey>& keys) {
  for (const SweptKey& swept : keys) {
    given.radial |= swept.key == key_of(&Grid::radial_cells).path();
    given.angular |= swept.key == key_of(&Grid::angular_cells).path();
    given.axial |= swept.key == key_of(&Grid::axial_cells).path();
  }
  return given;
}

/// With shares of the distance that sum to 1: those of the load cases that are not swept keep their
/// proportions.
Case with_fitting_shares(Case c, const std::vector<SweptKey>& keys) {
  double swept = 0, others = 0;
  std::vector<double*> free;
  for (std::size_t k = 0; k < c.load.cases.size(); ++k) {
    auto& share = c.load.cases[k].distance_share;
    if (std::ranges::find(keys, key_of(&CaseLoad::distance_share, k).path(), &SweptKey::key) != keys.end()) {
      swept += share.value_or(0);
    } else if (share) {
      others += *share;
      free.push_back(&*share);
    }
  }
  if (swept > 0 && swept <= 1 && others > 0)
    for (double* share : free) *share *= (1 - swept) / others;
  return c;
}

/// The case as if read from its own file, or its first problem.
Expected<Case, SweepProblem> checked(const Case& c, const std::filesystem::path& file,
                                     const std::string& text) {
  CaseResult result = parse_case(to_toml(c), file, c.vocabulary);
  if (result.value) return *std::move(result.value);
  const Diagnostic& first = result.problems.front();
  return SweepProblem{fmt::format("{}: {}: {}{}{}", text, first.key, first.problem,
                                  first.remedy.empty() ? "" : "; ", first.remedy)};
}

}  // namespace

Expected<std::vector<Design>, SweepProblem> sweep_designs(const Case& c, const GivenCells& given_cells,
                                                          const std::filesystem::path& file,
                                                          const std::vector<SweptKey>& keys) {
  std::size_t n = 1;
  for (const SweptKey& swept : keys) n *= swept.values.size();
  if (n > max_designs)
    return SweepProblem{fmt::format("{} designs; at most {} are run in one folder", n, max_designs)};
  std::vector<Design> designs;
  for (std::size_t i = 0; i < n; ++i) {
    Case source = c;
    Design design{fmt::format("{:03}", i + 1), "", {}, {}};
    std::size_t rest = i, block = n;
    for (const SweptKey& swept : keys) {
      block /= swept.values.size();
      const double value = swept.values[rest / block];
      rest %= block;
      if (const auto problem = set_number(source, swept.key, value, swept.unit))
        return SweepProblem{*problem};
      design.text += fmt::format("{}{} = {}{}{}", design.text.empty() ? "" : ", ", swept.key,
                                 number_text(value), swept.unit.empty() ? "" : " ", swept.unit);
      design.parameters.emplace_back(
          swept.unit.empty() ? swept.key : fmt::format("{} [{}]", swept.key, swept.unit), value);
    }
    source = with_fitting_shares(std::move(source), keys);
    auto valid = checked(with_default_grid(source, with_swept(given_cells, keys)), file, design.text);
    if (!valid) return valid.failure();
    auto complete = with_parting_plane_found(*valid);
    if (!complete)
      return SweepProblem{fmt::format("{}: no parting plane: {}", design.text, complete.failure().detail)};
    design.source = *std::move(complete);
    design.source.title = design.text;
    design.source.output.vtu_every = design.source.output.pictures_every = 0;
    design.source.output.errors = ErrorEstimates::none;  // of the finalists they are estimated afterwards
    designs.push_back(std::move(design));
  }
  return designs;
}

}  // namespace wheelwright
