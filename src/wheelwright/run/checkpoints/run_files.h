#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "wheelwright/files/written_files.h"

namespace wheelwright {

/// The folder of the shapes saved as cases while a run was watched.
inline constexpr const char* designs_folder = "designs";

/// The names that a run may write to its folder. Add the names of new files and subfolders here, so that a
/// run is refused at its start, not its end, if the name is in use.
inline constexpr std::string_view names_in_a_run_folder[] = {"case.toml",
                                                             "history.csv",
                                                             "history.csv.before",
                                                             "comparison.svg",
                                                             "shape.svg",
                                                             "shape.levelset",
                                                             "stress.svg",
                                                             "stress_contact.svg",
                                                             "displacement.svg",
                                                             "fatigue.svg",
                                                             "temperature.svg",
                                                             "pressure.svg",
                                                             "shape.stl",
                                                             "surface.vtp",
                                                             "mesh.svg",
                                                             "pressures_initial.csv",
                                                             "pressures_initial.svg",
                                                             "pressures_final.csv",
                                                             "pressures_final.svg",
                                                             "summary.json",
                                                             "report.html",
                                                             "outlines.jsonl",
                                                             "shapes.pvd",
                                                             "rolling.pvd",
                                                             "run.lock",
                                                             "shapes",
                                                             "rolling",
                                                             "load_cases",
                                                             "drawings",
                                                             "commands.jsonl",
                                                             "designs",
                                                             "checkpoints",
                                                             "failure"};

/// Those of them that exist in the folder but were not written by a run.
inline std::vector<std::string> foreign_files(const std::filesystem::path& folder) {
  return WrittenFiles(folder).foreign(names_in_a_run_folder);
}

}  // namespace wheelwright
