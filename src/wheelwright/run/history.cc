#include "wheelwright/run/history.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <sstream>

#include "wheelwright/base/quantity.h"
#include "wheelwright/files/checksum.h"
#include "wheelwright/files/csv.h"
#include "wheelwright/files/output_error.h"

namespace wheelwright {
namespace {

template <class NamedValue>
std::string value_cell(const std::vector<NamedValue>& values, const std::string& name) {
  const auto found = std::ranges::find(values, name, &NamedValue::name);
  return found == values.end() ? "" : csv_number(found->value);
}

/// A phase may occur several times in one trial: the sum.
std::string phase_cell(const std::vector<PhaseTime>& phases, const std::string& name) {
  if (std::ranges::find(phases, name, &PhaseTime::phase) == phases.end()) return "";
  double seconds = 0;
  for (const PhaseTime& p : phases)
    if (p.phase == name) seconds += p.seconds;
  return csv_number(seconds);
}

constexpr const char* volume_fraction_column = "volume fraction";

/// What the file's header says between the objective and the column `next`.
std::vector<HistoryColumns::Quantity> criteria_columns(const std::filesystem::path& path,
                                                       const std::string& next) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::istringstream header(line);
  std::vector<HistoryColumns::Quantity> criteria;
  bool is_criterion = false;
  for (std::string cell; std::getline(header, cell, ',');) {
    const std::size_t open = cell.find(" [");
    const std::string word = cell.substr(0, open);
    if (word == next) break;
    if (is_criterion) criteria.push_back({word, cell.substr(open + 2, cell.size() - open - 3)});
    is_criterion = is_criterion || word == name(Quantity::objective);
  }
  return criteria;
}

}  // namespace

History::History(std::filesystem::path path, HistoryColumns columns)
    : path_(std::move(path)), columns_(std::move(columns)), file_(std::fopen(path_.c_str(), "w")) {
  if (!file_) throw OutputError(path_, errno);
  std::vector<std::string> header{"iteration", "trial", "accepted", "reason",
                                  "objective [" + columns_.objective_unit + "]"};
  for (const auto* quantities : {&columns_.criteria, &columns_.measures})
    for (const auto& q : *quantities) header.push_back(q.name + " [" + q.unit + "]");
  header.push_back(std::string(volume_fraction_column) + " [-]");
  for (const char* name : {"step [m]", "max velocity [Pa]", "max newton iterations"}) header.push_back(name);
  for (const auto& phase : columns_.phases) header.push_back(phase + " [s]");
  for (const char* name : {"trial [s]", "elapsed [s]", "events"}) header.push_back(name);
  write_line(header);
}

History::History(std::filesystem::path path, HistoryColumns columns, const HistoryMark& end)
    : path_(std::move(path)), columns_(std::move(columns)), file_(std::fopen(path_.c_str(), "a")), end_(end) {
  if (!file_ || ::ftruncate(::fileno(file_.get()), static_cast<off_t>(end.bytes)) != 0)
    throw OutputError(path_, errno);
  columns_.criteria = criteria_columns(
      path_, columns_.measures.empty() ? volume_fraction_column : columns_.measures.front().name);
}

bool History::holds(const std::filesystem::path& path, const HistoryMark& mark) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error || size < mark.bytes) return false;
  std::string start(mark.bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  return file.read(start.data(), static_cast<std::streamsize>(start.size())) &&
         checksum(start) == mark.checksum;
}

void History::synchronize() {
  if (::fsync(::fileno(file_.get())) != 0 && errno != EINVAL) throw OutputError(path_, errno);
}

void History::add(const HistoryRow& row) {
  std::vector<std::string> cells{std::to_string(row.iteration), std::to_string(row.trial),
                                 row.accepted ? "1" : "0", row.reason, csv_number(row.objective)};
  for (const auto& c : columns_.criteria) cells.push_back(value_cell(row.criteria, c.name));
  for (const auto& m : columns_.measures) cells.push_back(value_cell(row.measures, m.name));
  for (const double value : {row.volume_fraction, row.step, row.max_velocity})
    cells.push_back(csv_number(value));
  cells.push_back(std::to_string(row.max_newton_iterations));
  for (const auto& phase : columns_.phases) cells.push_back(phase_cell(row.phases, phase));
  for (const double value : {row.trial_seconds, row.elapsed_seconds}) cells.push_back(csv_number(value));
  cells.push_back(fmt::format("{}", fmt::join(row.events, "; ")));
  write_line(cells);
}

void History::write_line(const std::vector<std::string>& cells) {
  const std::string line = csv_line(cells);
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
    throw OutputError(path_, errno);
  end_ = {end_.bytes + line.size(), checksum(line, end_.checksum)};
}

}  // namespace wheelwright
