#include "wheelwright/app/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "wheelwright/base/text.h"

namespace wheelwright {
namespace {

constexpr std::size_t recent_shapes = 10;
constexpr const char* clear_line = "\r\x1b[K";

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

int terminal_width(std::FILE* stream) {
  winsize size{};
  if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

/// e.g. " kg"
std::string unit_text(const ProgressState& s) {
  return s.objective_unit.empty() ? "" : " " + s.objective_unit;
}

std::string change_text(const ProgressState& s) {
  return fmt::format("{:+.2f} %", 100 * (s.objective / s.initial_objective - 1));
}

/// Rounded up, and never "0:00": this is shown only while there is something left to do.
std::string left_text(double seconds_left) {
  if (seconds_left < 0) return "time left unknown";
  return "at most " + clock_text(std::max(1.0, std::ceil(seconds_left))) + " left";
}

double completed_fraction(const ProgressState& s) {
  return *s.n_shapes > 0 ? std::clamp(double(s.shape) / *s.n_shapes, 0.0, 1.0) : 1.0;
}

bool is_last(const ProgressState& s) { return s.n_shapes && s.shape >= *s.n_shapes; }

std::string shape_text(const ProgressState& s) {
  return s.n_shapes ? fmt::format("{}/{}", s.shape, *s.n_shapes) : fmt::format("{}", s.shape);
}

/// Fills the finished part of a bar "[###...]" with colour.
std::string coloured(const std::string& bar) {
  const auto open = bar.find('['), close = bar.find(']');
  if (open == std::string::npos || close == std::string::npos) return bar;
  return bar.substr(0, open) + "\x1b[36m" + bar.substr(open, close + 1 - open) + "\x1b[0m" +
         bar.substr(close + 1);
}

}  // namespace

ProgressStyle progress_style(std::FILE* stream) {
  const std::string_view terminal = environment("TERM");
  if (!::isatty(::fileno(stream)) || terminal.empty() || terminal == "dumb") return ProgressStyle::lines;
  return environment("NO_COLOR").empty() ? ProgressStyle::coloured_bar : ProgressStyle::bar;
}

std::string clock_text(double seconds) {
  const long s = std::lround(std::clamp(seconds, 0.0, 1e9));
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string progress_line(const ProgressState& s, double seconds_left) {
  return fmt::format("shape {}  objective {:.6g}{} ({})  volume {:.3f} %  step {:.3g} mm  elapsed {}{}",
                     shape_text(s), s.objective, unit_text(s), change_text(s), 100 * s.volume_fraction,
                     1000 * s.step, clock_text(s.elapsed_seconds),
                     s.n_shapes && !is_last(s) ? "  " + left_text(seconds_left) : "");
}

std::string progress_bar(const ProgressState& s, double seconds_left, int width) {
  constexpr int shortest_bar = 20, longest_bar = 40;
  const std::vector<std::string> parts{
      fmt::format("{}{}", s.n_shapes ? " " : "shape ", shape_text(s)),
      fmt::format("  J {:.5g}{} ({})", s.objective, unit_text(s), change_text(s)),
      s.n_shapes && !is_last(s) ? "  " + left_text(seconds_left) : "",
      fmt::format("  volume {:.2f} %", 100 * s.volume_fraction),
      fmt::format("  step {:.2g} mm", 1000 * s.step)};
  std::string numbers;
  for (const std::string& part : parts) {
    if (static_cast<int>(numbers.size() + part.size()) + shortest_bar + 2 > width) break;
    numbers += part;
  }
  if (!s.n_shapes) return numbers.substr(0, std::max(width, 0));
  const int length = std::clamp(width - 2 - static_cast<int>(numbers.size()), 0, longest_bar);
  const int done = std::lround(completed_fraction(s) * length);
  const std::string bar = fmt::format("[{:.<{}}]{}", std::string(done, '#'), length, numbers);
  return bar.substr(0, std::max(width, 0));
}

void Progress::end() {
  if (!bar_.empty()) std::fputs("\n", stream_);
  bar_.clear();
}

void Progress::complete() {
  if (!last_) return;
  if (style_ == ProgressStyle::lines) {
    if (!last_has_line_) write_line(*last_, 0);
  } else if (last_->n_shapes) {
    last_->n_shapes = last_->shape;
    bar_ = progress_bar(*last_, 0, terminal_width(stream_) - 1);
    paint_bar();
  }
}

double Progress::seconds_left(const ProgressState& state) {
  recent_.push_back(state.elapsed_seconds);
  if (recent_.size() > recent_shapes + 1) recent_.pop_front();
  if (recent_.size() < 2 || !state.n_shapes) return -1;
  const double mean = (recent_.back() - recent_.front()) / (recent_.size() - 1);
  return mean * std::max(0, *state.n_shapes - state.shape);
}

bool Progress::is_time_after(const std::optional<double>& last, double elapsed_seconds) const {
  return !last || elapsed_seconds - *last >= seconds_between_lines_;
}

void Progress::write_line(const ProgressState& state, double left) {
  last_line_ = last_shape_ = state.elapsed_seconds;
  last_has_line_ = true;
  note(progress_line(state, left));
}

void Progress::show(const ProgressState& state) {
  const double left = seconds_left(state);
  last_ = state;
  last_has_line_ = false;
  if (style_ != ProgressStyle::lines) {
    bar_ = progress_bar(state, left, terminal_width(stream_) - 1);
    paint_bar();
  } else if (is_time_after(last_shape_, state.elapsed_seconds) || is_last(state)) {
    write_line(state, left);
  }
}

void Progress::show_step(const std::string& text, double elapsed_seconds) {
  if (style_ != ProgressStyle::lines) {
    bar_ = without_control_characters(text).substr(0, std::max(terminal_width(stream_) - 1, 0));
    paint_bar();
  } else if (is_time_after(last_line_, elapsed_seconds)) {
    last_line_ = elapsed_seconds;
    note(text);
  }
}

void Progress::note(std::string_view line) {
  std::fputs(fmt::format("{}{}\n", bar_.empty() ? "" : clear_line, without_control_characters(line)).c_str(),
             stream_);
  if (!bar_.empty()) paint_bar();
  std::fflush(stream_);
}

void Progress::paint_bar() {
  const std::string& bar = style_ == ProgressStyle::coloured_bar ? coloured(bar_) : bar_;
  std::fputs((clear_line + bar).c_str(), stream_);
  std::fflush(stream_);
}

}  // namespace wheelwright
