#pragma once

#include <cstdio>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace wheelwright {

/// How progress is shown: lines for files and dumb terminals, a bar that repaints itself for the others.
enum class ProgressStyle { lines, bar, coloured_bar };

/// The style that suits the stream: lines unless it is a terminal and TERM is neither empty nor "dumb";
/// no colour when NO_COLOR is set and not empty.
ProgressStyle progress_style(std::FILE* stream);

/// Where a run stands after an accepted shape.
struct ProgressState {
  int shape;                    ///< shapes accepted so far
  std::optional<int> n_shapes;  ///< shapes asked for; nothing: there is no end
  double objective;             ///< as tables show it
  double initial_objective;     ///< likewise
  double volume_fraction;
  double step;                      ///< farthest that the boundary travelled in this shape [m]
  double elapsed_seconds;           ///< since the run began
  std::string objective_unit = {};  ///< nothing where it has none
};

/// One line of text for a log. `seconds_left` < 0: not known yet.
std::string progress_line(const ProgressState& state, double seconds_left);

/// A bar with the numbers, at most `width` characters: what does not fit is left out. Without an end there
/// are the numbers only.
std::string progress_bar(const ProgressState& state, double seconds_left, int width);

/// "1:02:03" or "2:03".
std::string clock_text(double seconds);

/// Shows how a run advances: one bar on a terminal, else a line now and then. The time left is that to the
/// last shape asked for, by the mean time of the last ten; a run that converges takes less. Nothing that it
/// writes can fail the run.
class Progress {
 public:
  /// `stream` is usually stderr; it must outlive this. `seconds_between_lines`: of lines without a bar.
  Progress(std::FILE* stream, ProgressStyle style, double seconds_between_lines = 1)
      : stream_(stream), style_(style), seconds_between_lines_(seconds_between_lines) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { end(); }

  /// Repaints the bar; or writes a line, unless the last one is too recent; always for the last shape.
  void show(const ProgressState& state);

  /// Says in place of the bar what takes so long; or in a line, unless the last one is too recent.
  void show_step(const std::string& text, double elapsed_seconds);

  /// A line of its own, above the bar.
  void note(std::string_view line);

  /// There are no more shapes: fills the bar, or writes the line of the last shape if that was left out.
  void complete();

  /// Leaves the bar as it is; what is printed next begins a line.
  void end();

 private:
  double seconds_left(const ProgressState& state);
  bool is_time_for_a_line(double elapsed_seconds) const;
  void write_line(const ProgressState& state, double left);
  void paint_bar();

  std::FILE* stream_;
  ProgressStyle style_;
  double seconds_between_lines_;
  std::deque<double> recent_;          ///< elapsed seconds at the last shapes
  std::optional<double> last_line_;    ///< elapsed seconds at the last line
  std::optional<ProgressState> last_;  ///< shown last
  bool last_has_line_ = false;
  std::string bar_;  ///< the bar on the screen, empty if none
};

}  // namespace wheelwright
