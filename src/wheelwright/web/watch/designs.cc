#include "wheelwright/web/watch/designs.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "wheelwright/case/load_saved_shape.h"
#include "wheelwright/design/explore/design_runs.h"
#include "wheelwright/files/path_queries.h"

namespace wheelwright {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The JSON of an exploration or a sweep, or null.
Json read_designs(const fs::path& folder) {
  for (const char* name : {"explore.json", "sweep.json"}) {  // of the commands
    std::ifstream stream(folder / name, std::ios::binary);
    if (!stream) continue;
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    return Json::parse(text, nullptr, false);
  }
  return {};
}

/// What a page shows of a design.
Json shown(const Json& design) {
  Json json;
  for (const char* key : {"name", "start", "front", "numbers"}) json[key] = design.value(key, Json());
  return json;
}

}  // namespace

Expected<OfferedDesigns, NoProduct> offered_designs(const fs::path& folder) {
  const Json all = read_designs(folder);
  if (!all.is_object() || !all.contains("designs") || !all["designs"].is_array() ||
      !all.contains("quantities"))
    return NoProduct{fmt::format("{} is not the folder of a finished exploration or sweep", folder.string())};
  OfferedDesigns offered;
  Json designs = Json::array();
  for (const Json& design : all["designs"]) {
    if (!design.is_object() || !design.contains("name") || !design["name"].is_string()) continue;
    const std::string name = design["name"];
    const fs::path shape = folder / folder_of_designs / name / saved_shape_file;
    if (!is_design_name(name) || !is_file(shape)) continue;
    designs.push_back(shown(design));
    offered.shapes.emplace(name, fs::absolute(shape));
  }
  offered.json = Json{{"quantities", all["quantities"]}, {"designs", std::move(designs)}}.dump(
      -1, ' ', true, Json::error_handler_t::replace);
  return offered;
}

}  // namespace wheelwright
