#include "wheelwright/design/explore/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "wheelwright/case/read.h"
#include "wheelwright/case/write.h"
#include "wheelwright/design/explore/design_runs.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/file_content.h"
#include "wheelwright/files/path_queries.h"
#include "wheelwright/run/checkpoints/own_drawings.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path design_case(const fs::path& folder, const std::string& name) {
  return folder / folder_of_designs / (name + ".toml");
}

std::string plan_json(const DesignPlan& plan) {
  Json json{{"name", plan.name},
            {"title", plan.title},
            {"has_previews", plan.has_previews},
            {"solves_finalists", plan.solves_finalists},
            {"is_complete", plan.is_complete},
            {"quantities", Json::array()},
            {"designs", Json::array()}};
  for (const RankedQuantity& quantity : plan.quantities) json["quantities"].push_back(quantity.word);
  for (const Design& design : plan.designs)
    json["designs"].push_back(
        {{"name", design.name}, {"text", design.text}, {"parameters", design.parameters}});
  return json.dump(2) + '\n';
}

/// The case of a design, or the first reason why it cannot be read.
Expected<Case, PlanProblem> read_design(const fs::path& file) {
  CaseResult read = read_case(file);
  if (!read.value) return PlanProblem{read.problems.front().text()};
  return *std::move(read.value);
}

Expected<DesignPlan, PlanProblem> parsed(const fs::path& folder, const nlohmann::json& json) {
  DesignPlan plan{.name = json.at("name"),
                  .title = json.at("title"),
                  .has_previews = json.at("has_previews"),
                  .solves_finalists = json.at("solves_finalists"),
                  .is_complete = json.at("is_complete")};
  for (const auto& one : json.at("designs")) {
    auto source = read_design(design_case(folder, one.at("name")));
    if (!source) return source.failure();
    plan.designs.push_back({one.at("name"), one.at("text"), *std::move(source), one.at("parameters")});
  }
  const auto known =
      plan.designs.empty() ? ranked_quantities() : ranked_quantities(plan.designs.front().source);
  for (const std::string word : json.at("quantities")) {
    const auto found = std::ranges::find(known, word, &RankedQuantity::word);
    if (found == known.end())
      return PlanProblem{
          fmt::format("{}: its designs have no quantity '{}'", (folder / plan_file).string(), word)};
    plan.quantities.push_back(*found);
  }
  return plan;
}

}  // namespace

void write_plan(const fs::path& folder, const DesignPlan& plan) {
  prepare_designs(folder, plan.designs);
  for (const Design& design : plan.designs) {
    const Case c = with_own_drawings(design.source);
    write_drawings(folder / folder_of_designs, c);
    write_atomically(design_case(folder, design.name), to_toml(c));
  }
  write_atomically(folder / plan_file, plan_json(plan));
}

Expected<DesignPlan, PlanProblem> read_plan(const fs::path& folder) {
  const fs::path file = folder / plan_file;
  if (!is_there(file))
    return PlanProblem{fmt::format(
        "{}: there is no {}; `wheelwright explore CASE --plan` or `wheelwright sweep CASE KEYS --plan` "
        "writes one",
        folder.string(), plan_file)};
  try {
    return parsed(folder, nlohmann::json::parse(file_content(file)));
  } catch (const nlohmann::json::exception& problem) {
    return PlanProblem{
        fmt::format("{}: not a plan of designs: {}; plan again", file.string(), problem.what())};
  }
}

}  // namespace wheelwright
