#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "wheelwright/optimization/optimizer/constraints.h"
#include "wheelwright/optimization/sensitivity/evaluation.h"

namespace wheelwright {

/// The columns of a history file that depend on the case.
struct HistoryColumns {
  struct Quantity {
    std::string name;
    std::string unit;
  };
  std::string objective_unit;      ///< e.g. "J/m"
  std::vector<Quantity> terms;     ///< one column each, by the names of Evaluation::terms
  std::vector<Quantity> measures;  ///< one column each, by the names of Evaluation::measures
  /// Three columns each, by the names of BoundState: value, bound and multiplier.
  std::vector<Quantity> bounds = {};
  std::vector<std::string> phases = {};  ///< one column each, in seconds, by the names of Evaluation::phases
};

/// One trial shape, accepted or not. NaN, and values not reached by a failed evaluation, are written as empty
/// cells.
struct HistoryRow {
  int iteration;  ///< number that the shape gets if accepted
  int trial;      ///< counts the step halvings of one iteration
  bool accepted;
  std::string reason;  ///< why it was rejected, e.g. "newton_stalled"; empty when accepted
  double objective;
  std::vector<TermValue> terms;
  std::vector<MeasureValue> measures;
  double volume_fraction;               ///< material area over the area of the full ring
  double step;                          ///< maximum motion of the boundary [m]
  double max_velocity;                  ///< largest normal velocity, in units of the gradient density [Pa]
  int max_newton_iterations;            ///< over the load positions
  std::vector<BoundState> bounds = {};  ///< in the order of the columns; empty: not evaluated
  std::vector<PhaseTime> phases;
  double trial_seconds;                  ///< wall time of this trial
  double elapsed_seconds;                ///< wall time since the run began
  std::vector<std::string> events = {};  ///< changes of the shape other than the motion of its boundary
};

/// The name of the file in a run's folder.
inline constexpr const char* history_file = "history.csv";

/// A position in a history file: the number of bytes before it, and their checksum.
struct HistoryMark {
  std::uint64_t bytes = 0;
  std::uint32_t checksum = 0;
};

/// history.csv: a header with units, then one row per trial, written to disk immediately. Numbers have the
/// fewest digits that read back to the same double.
class History {
 public:
  /// Replaces the file. Throws OutputError.
  History(std::filesystem::path path, HistoryColumns columns);

  /// Continues at a position of the file, for which holds() is true, and drops the rows after it. The columns
  /// of terms are those of the file, whatever `columns` contains. Throws OutputError.
  History(std::filesystem::path path, HistoryColumns columns, const HistoryMark& end);

  /// Adds empty columns after those of the terms. Keeps a copy of the old file, for checkpoints written
  /// before. Throws OutputError.
  void add_terms(const std::vector<HistoryColumns::Quantity>& terms);

  const HistoryColumns& columns() const { return columns_; }

  /// Whether the file, or the copy kept by add_terms(), starts with the bytes of the mark.
  static bool holds(const std::filesystem::path& path, const HistoryMark& mark);

  /// Throws OutputError.
  void add(const HistoryRow& row);

  /// The current end of the file.
  const HistoryMark& end() const { return end_; }

  /// Returns when all rows are on the disk. Throws OutputError.
  void synchronize();

 private:
  void write_line(const std::vector<std::string>& cells);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  HistoryColumns columns_;
  std::unique_ptr<std::FILE, Close> file_;
  HistoryMark end_;
};

}  // namespace wheelwright
