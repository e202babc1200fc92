#pragma once

#include <cstdio>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace wheelwright {

/// Lines for files and dumb terminals, a bar that repaints itself for other terminals.
enum class ProgressStyle { lines, bar, coloured_bar };

/// The style that suits the stream: lines unless it is a terminal and TERM is neither empty nor "dumb";
/// no colour when NO_COLOR is set and not empty.
ProgressStyle progress_style(std::FILE* stream);

/// The progress of a run after an accepted shape.
struct ProgressState {
  int shape;                    ///< shapes accepted so far
  std::optional<int> n_shapes;  ///< requested shapes; nothing if there is no limit
  double objective;             ///< as tables show it
  double initial_objective;     ///< likewise
  double volume_fraction;
  double step;                      ///< farthest that the boundary travelled in this shape [m]
  double elapsed_seconds;           ///< since the run began
  std::string objective_unit = {};  ///< empty if dimensionless
};

/// One line of text for a log. `seconds_left` < 0: not known yet.
std::string progress_line(const ProgressState& state, double seconds_left);

/// A bar with numbers, at most `width` characters: what does not fit is omitted. Only the numbers if there is
/// no limit of shapes.
std::string progress_bar(const ProgressState& state, double seconds_left, int width);

/// "1:02:03" or "2:03".
std::string clock_text(double seconds);

/// Shows the progress of a run: a bar on a terminal, otherwise an occasional line. The time left is estimated
/// for the last requested shape from the mean time of the last ten; a run that converges takes less. Errors
/// of its output never fail the run.
class Progress {
 public:
  /// `stream` is usually stderr; it must outlive this. `seconds_between_lines` applies if there is no bar.
  Progress(std::FILE* stream, ProgressStyle style, double seconds_between_lines = 1)
      : stream_(stream), style_(style), seconds_between_lines_(seconds_between_lines) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { end(); }

  /// Repaints the bar; or writes a line, unless the last one is too recent; always for the last shape.
  void show(const ProgressState& state);

  /// Replaces the bar by the current step of a slow computation; or writes a line, unless the last one is too
  /// recent.
  void show_step(const std::string& text, double elapsed_seconds);

  /// A separate line, above the bar.
  void note(std::string_view line);

  /// After the last shape: fills the bar, or writes the line of the last shape if it was skipped.
  void complete();

  /// Leaves the bar as it is; further output starts on a new line.
  void end();

 private:
  double seconds_left(const ProgressState& state);
  bool is_time_after(const std::optional<double>& last, double elapsed_seconds) const;
  void write_line(const ProgressState& state, double left);
  void paint_bar();

  std::FILE* stream_;
  ProgressStyle style_;
  double seconds_between_lines_;
  std::deque<double> recent_;          ///< elapsed seconds at the last shapes
  std::optional<double> last_line_;    ///< elapsed seconds at the last line
  std::optional<double> last_shape_;   ///< elapsed seconds at the last line of a shape
  std::optional<ProgressState> last_;  ///< shown last
  bool last_has_line_ = false;
  std::string bar_;  ///< the bar on the screen, empty if none
};

}  // namespace wheelwright
