#pragma once

#include <cstdio>
#include <deque>
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
  int shape;     ///< shapes accepted so far
  int n_shapes;  ///< shapes asked for
  double objective;
  double initial_objective;
  double volume_fraction;
  double step;             ///< farthest that the boundary travelled in this shape [m]
  double elapsed_seconds;  ///< since the run began
};

/// One line of text for a log. `seconds_left` < 0: not known yet.
std::string progress_line(const ProgressState& state, double seconds_left);

/// A bar with the numbers, at most `width` characters: what does not fit is left out.
std::string progress_bar(const ProgressState& state, double seconds_left, int width);

/// "1:02:03" or "2:03".
std::string clock_text(double seconds);

/// Shows how a run advances. The time left comes from the mean time of the last ten shapes. Nothing that it
/// writes can fail the run.
class Progress {
 public:
  /// `stream` is usually stderr; it must outlive this.
  Progress(std::FILE* stream, ProgressStyle style) : stream_(stream), style_(style) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() { end(); }

  /// Repaints the bar; or writes a line, at most one a second and always for the last shape.
  void show(const ProgressState& state);

  /// A line of its own, above the bar.
  void note(std::string_view line);

  /// Leaves the bar as it is; what is printed next begins a line.
  void end();

 private:
  double seconds_left(const ProgressState& state);
  void paint_bar();

  std::FILE* stream_;
  ProgressStyle style_;
  std::deque<double> recent_;  ///< elapsed seconds at the last shapes
  double last_line_ = -1e9;    ///< elapsed seconds at the last line
  std::string bar_;            ///< the bar on the screen, empty if none
};

}  // namespace wheelwright
