#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "wheelwright/files/written_files.h"

/// Small runs and their folders, for the tests of stopping and going on.
namespace wheelwright::testing {

namespace fs = std::filesystem;

/// The sections of a wheel that is solved within milliseconds. On cells longer than the contact patch the
/// energy of projected elements changes by 1e-4 when a boundary crosses a cell, which ends small steps early.
inline const std::string small_wheel = R"(
[wheel]
sectors = 8
[load]
positions = 2
[[holes.ring]]
count = 16
center_radius = 0.27
radius = 0.03
[grid]
radial_cells = 8
angular_cells = 96
tread_levels = 0
dilatation = "pointwise"
[optimizer]
rim_band = 0.0175
tread_band = 0.035
)";

/// A case of `iterations` shapes of it, with redistancing, smoothing and rejected trials. `more` is appended
/// and may open sections.
inline std::string small_case(int iterations, const std::string& more = "") {
  return small_wheel + fmt::format(R"(iterations = {}
tolerance = 0
accepted_increase = 0
smoothing = 0.1
smooth_every = 4
redistance_every = 3
[output]
folder = "run"
vtu_every = 7
checkpoint_every = 3
checkpoint_seconds = 0
{})",
                                   iterations, more);
}

/// The same, whose last shapes need no minimum widths. If it is extended, it is the same as one of more
/// shapes: the widths are asked for when a third of the shapes is left.
inline std::string small_case_of_any_width(int iterations, const std::string& more = "") {
  std::string text = small_case(iterations, more);
  const std::string section = "[optimizer]\n";
  text.insert(text.find(section) + section.size(), "minimum_wall = 0\nminimum_gap = 0\n");
  return text;
}

inline std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// history.csv without its columns in seconds.
inline std::string without_times(const std::string& history) {
  const auto lines = split(history, '\n');
  if (lines.empty()) return "";
  const auto header = split(lines.front(), ',');
  std::string result;
  for (const std::string& line : lines) {
    const auto cells = split(line, ',');
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (k >= header.size() || !header[k].ends_with(" [s]")) result += cells[k] + ',';
    result += '\n';
  }
  return result;
}

/// A page without the name of its run and the time that it took.
inline std::string without_name_and_time(std::string page) {
  for (const std::string key : {"\"name\":\"", "\"seconds\":"}) {
    const auto begin = page.find(key, page.find("\"runs\":")) + key.size();
    page.erase(begin, page.find(',', begin) - begin);
  }
  return page;
}

/// All results in a run's folder, by their path in it: every file but the lock, the checkpoints and the lists
/// of written files, and the history and the page without times.
inline std::map<std::string, std::string> results(const fs::path& run) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const std::string name = fs::relative(entry.path(), run).string();
    if (!entry.is_regular_file() || name == "run.lock" || name.starts_with("checkpoints/")) continue;
    if (name.ends_with(list_of_written_files)) continue;
    files[name] = content(entry.path());
    if (name == "history.csv") files[name] = without_times(files[name]);
    if (name == "report.html") files[name] = without_name_and_time(files[name]);
  }
  return files;
}

/// The surroundings of the first place where two texts differ.
inline std::string first_difference(const std::string& a, const std::string& b) {
  constexpr std::size_t before = 60, shown = 120;
  const auto at = static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
  const std::size_t from = at - std::min(at, before);
  return a.substr(from, shown) + "\n against\n" + b.substr(std::min(from, b.size()), shown);
}

inline void expect_equal_results(const fs::path& straight, const fs::path& resumed) {
  const auto expected = results(straight), found = results(resumed);
  EXPECT_TRUE(expected.contains("history.csv") && expected.contains("comparison.svg") &&
              expected.contains("stress.svg"));
  for (const auto& [name, text] : expected) {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_TRUE(found.at(name) == text) << name << " differs: " << first_difference(text, found.at(name));
  }
  for (const auto& [name, text] : found) EXPECT_TRUE(expected.contains(name)) << name << " is left over";
}

/// A folder for one test, which is removed with it.
class TemporaryFolder : public ::testing::Test {
 protected:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "wheelwright-run-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() override { fs::remove_all(folder_); }

  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

}  // namespace wheelwright::testing
