#include "wheelwright/run/checkpoints/history.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <sstream>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/checksum.h"
#include "wheelwright/files/csv.h"
#include "wheelwright/files/output_error.h"
#include "wheelwright/files/written_files.h"
#include "wheelwright/quantities/functionals/quantity.h"

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

constexpr std::size_t cells_before_terms = 5;  // up to the objective
constexpr const char* volume_fraction_column = "volume fraction";

/// The columns of the file's header between the objective and the column `next`.
std::vector<HistoryColumns::Quantity> term_columns(const std::filesystem::path& path,
                                                   const std::string& next) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::istringstream header(line);
  std::vector<HistoryColumns::Quantity> terms;
  bool is_term = false;
  for (std::string cell; std::getline(header, cell, ',');) {
    const std::size_t open = cell.find(" [");
    const std::string word = cell.substr(0, open);
    if (word == next) break;
    if (is_term) terms.push_back({word, cell.substr(open + 2, cell.size() - open - 3)});
    is_term = is_term || word == name(Quantity());
  }
  return terms;
}

std::filesystem::path kept_file(const std::filesystem::path& path) { return path.string() + ".before"; }

bool begins_with(const std::filesystem::path& path, const HistoryMark& mark) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error || size < mark.bytes) return false;
  std::string start(mark.bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  return file.read(start.data(), static_cast<std::streamsize>(start.size())) &&
         checksum(start) == mark.checksum;
}

/// Restores the history of the mark if columns were added since.
const std::filesystem::path& put_back(const std::filesystem::path& path, const HistoryMark& mark) {
  if (begins_with(path, mark)) return path;
  std::error_code error;
  std::filesystem::rename(kept_file(path), path, error);
  if (error) throw OutputError(path, error.value());
  return path;
}

std::filesystem::path claimed(std::filesystem::path path) {
  claim_file(path);
  return path;
}

/// CSV with additional cells after the first `place` cells of each line, which must not contain quotes; the
/// header gets `names`, other lines empty cells.
std::string with_cells(std::string_view csv, std::size_t place, const std::string& names) {
  const std::string empty(static_cast<std::size_t>(std::ranges::count(names, ',')), ',');
  std::string result;
  std::size_t cell = 0;
  bool is_quoted = false, is_header = true;
  for (const char c : csv) {
    if (c == '"') is_quoted = !is_quoted;
    result += c;
    if (is_quoted) continue;
    if (c == ',' && ++cell == place) result += is_header ? names : empty;
    if (c == '\n') {
      cell = 0;
      is_header = false;
    }
  }
  return result;
}

}  // namespace

History::History(std::filesystem::path path, HistoryColumns columns)
    : path_(claimed(std::move(path))), columns_(std::move(columns)), file_(std::fopen(path_.c_str(), "w")) {
  if (!file_) throw OutputError(path_, errno);
  std::vector<std::string> header{"iteration", "trial", "accepted", "reason",
                                  "objective [" + columns_.objective_unit + "]"};
  for (const auto* quantities : {&columns_.terms, &columns_.measures})
    for (const auto& q : *quantities) header.push_back(q.name + " [" + q.unit + "]");
  header.push_back(std::string(volume_fraction_column) + " [-]");
  for (const char* name : {"step [m]", "max velocity [Pa]", "max newton iterations"}) header.push_back(name);
  for (const auto& b : columns_.bounds) {
    header.push_back(fmt::format("bounded {} [{}]", b.name, b.unit));
    header.push_back(fmt::format("bound of {} [{}]", b.name, b.unit));
    header.push_back(fmt::format("multiplier of {} [{} per {}]", b.name, columns_.objective_unit, b.unit));
  }
  for (const auto& phase : columns_.phases) header.push_back(phase + " [s]");
  for (const char* name : {"trial [s]", "elapsed [s]", "events"}) header.push_back(name);
  write_line(header);
}

History::History(std::filesystem::path path, HistoryColumns columns, const HistoryMark& end)
    : path_(put_back(claimed(std::move(path)), end)),
      columns_(std::move(columns)),
      file_(std::fopen(path_.c_str(), "a")),
      end_(end) {
  if (!file_ || ::ftruncate(::fileno(file_.get()), static_cast<off_t>(end.bytes)) != 0)
    throw OutputError(path_, errno);
  columns_.terms = term_columns(
      path_, columns_.measures.empty() ? volume_fraction_column : columns_.measures.front().name);
}

void History::add_terms(const std::vector<HistoryColumns::Quantity>& terms) {
  std::string names;
  for (const auto& q : terms) names += q.name + " [" + q.unit + "],";
  std::ifstream file(path_, std::ios::binary);
  const std::string before{std::istreambuf_iterator<char>(file), {}};
  const std::string text = with_cells(before, cells_before_terms + columns_.terms.size(), names);
  write_atomically(kept_file(path_), before);
  write_atomically(path_, text);
  file_.reset(std::fopen(path_.c_str(), "a"));
  if (!file_) throw OutputError(path_, errno);
  columns_.terms.insert(columns_.terms.end(), terms.begin(), terms.end());
  end_ = {text.size(), checksum(text)};
}

bool History::holds(const std::filesystem::path& path, const HistoryMark& mark) {
  return begins_with(path, mark) || begins_with(kept_file(path), mark);
}

void History::synchronize() {
  if (::fsync(::fileno(file_.get())) != 0 && errno != EINVAL) throw OutputError(path_, errno);
}

void History::add(const HistoryRow& row) {
  std::vector<std::string> cells{std::to_string(row.iteration), std::to_string(row.trial),
                                 row.accepted ? "1" : "0", row.reason, csv_number(row.objective)};
  for (const auto& c : columns_.terms) cells.push_back(value_cell(row.terms, c.name));
  for (const auto& m : columns_.measures) cells.push_back(value_cell(row.measures, m.name));
  for (const double value : {row.volume_fraction, row.step, row.max_velocity})
    cells.push_back(csv_number(value));
  cells.push_back(std::to_string(row.max_newton_iterations));
  for (std::size_t k = 0; k < columns_.bounds.size(); ++k) {
    const bool is_known = k < row.bounds.size();
    for (const double BoundState::*member : {&BoundState::value, &BoundState::bound, &BoundState::multiplier})
      cells.push_back(is_known ? csv_number(row.bounds[k].*member) : "");
  }
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
