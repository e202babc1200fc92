#include "wheelwright/cad/drawing/svg_path.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

namespace wheelwright {

namespace {

using std::numbers::pi;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Reads a text from its beginning to its end.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::size_t place() const { return at_; }
  bool on_end() const { return at_ == text_.size(); }
  char peek() const { return on_end() ? '\0' : text_[at_]; }
  char take() { return text_[at_++]; }

  void skip_spaces() {
    while (is_space(peek())) ++at_;
  }
  /// White space with at most one comma.
  void skip_separator() {
    skip_spaces();
    if (peek() != ',') return;
    ++at_;
    skip_spaces();
  }
  bool skip(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  bool number_follows() const { return is_digit(peek()) || peek() == '.' || peek() == '+' || peek() == '-'; }

  std::optional<double> number() {
    std::size_t begin = at_ + (peek() == '+');
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + begin, text_.data() + text_.size(), value);
    // from_chars also knows words like inf.
    const bool begins_well =
        begin < text_.size() && (is_digit(text_[begin]) || text_[begin] == '.' || text_[begin] == '-');
    if (error != std::errc() || !begins_well || !std::isfinite(value)) return {};
    at_ = end - text_.data();
    return value;
  }

  /// A flag of an arc: one digit, which the next number may follow at once.
  std::optional<bool> flag() {
    if (peek() != '0' && peek() != '1') return {};
    return take() == '1';
  }

  std::string word() {
    std::string result;
    while (is_letter(peek())) result += take();
    return result;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

/// An arc by its ends (SVG 1.1, appendix F.6).
Curve arc_between(const Point& from, const Point& to, double rx, double ry, double turn, bool large,
                  bool sweep) {
  rx = std::abs(rx);
  ry = std::abs(ry);
  if (rx == 0 || ry == 0) return Curve::line(from, to);
  const Affine back = Affine::rotation(-turn);
  const Point half = back.linear(0.5 * (from - to));
  const double x2 = half[0] * half[0], y2 = half[1] * half[1];
  const double excess = x2 / (rx * rx) + y2 / (ry * ry);
  if (excess > 1) {
    rx *= std::sqrt(excess);
    ry *= std::sqrt(excess);
  }
  const double rest = std::max(0.0, 1 / std::max(excess, 1e-300) - 1),
               factor = (large == sweep ? -1 : 1) * std::sqrt(rest);
  const Point offset{factor * rx * half[1] / ry, -factor * ry * half[0] / rx};
  const Affine forth = Affine::rotation(turn);
  const Point centre = forth.linear(offset) + 0.5 * (from + to);
  const auto angle = [&](double sign) {
    return std::atan2((sign * half[1] - offset[1]) / ry, (sign * half[0] - offset[0]) / rx);
  };
  const double begin = angle(1);
  double span = angle(-1) - begin;
  if (sweep && span < 0) span += 2 * pi;
  if (!sweep && span > 0) span -= 2 * pi;
  return Curve::arc(centre, forth.linear({rx, 0}), forth.linear({0, ry}), begin, begin + span)
      .with_ends(from, to);
}

/// Follows the commands of a path.
class PathReader {
 public:
  explicit PathReader(std::string_view data) : scan_(data) {}

  SvgPath read() {
    scan_.skip_spaces();
    while (!scan_.on_end() && !result_.mistake) {
      const char command = scan_.take();
      if (!is_letter(command) || (!has_begun_ && command != 'M' && command != 'm')) {
        fail(1, has_begun_ ? "a command is expected" : "a path must start with the command M");
        break;
      }
      has_begun_ = true;
      read_command(command);
      scan_.skip_spaces();
    }
    end_subpath(false);
    return std::move(result_);
  }

 private:
  void fail(std::size_t back, std::string problem) {
    if (!result_.mistake) result_.mistake = TextMistake{scan_.place() - back, std::move(problem)};
  }

  double number() {
    scan_.skip_separator();
    const auto value = scan_.number();
    if (!value) fail(0, "a number is expected");
    return value.value_or(0);
  }
  bool flag() {
    scan_.skip_separator();
    const auto value = scan_.flag();
    if (!value) fail(0, "a flag of an arc is expected, 0 or 1");
    return value.value_or(false);
  }
  Point point(bool relative) {
    const double x = number(), y = number();
    return relative ? at_ + Point{x, y} : Point{x, y};
  }

  void end_subpath(bool closed) {
    if (!curves_.empty()) result_.subpaths.push_back({std::move(curves_), closed});
    curves_.clear();
  }

  void add(const Curve& curve) {
    if (result_.mistake) return;
    curves_.push_back(curve);
    at_ = curve.end();
  }

  bool more_arguments() {
    if (result_.mistake) return false;
    scan_.skip_separator();
    return scan_.number_follows();
  }

  void move(bool relative) {
    end_subpath(false);
    at_ = begin_ = point(relative);
    while (more_arguments()) add(Curve::line(at_, point(relative)));
  }

  void close() {
    if (at_ != begin_) add(Curve::line(at_, begin_));
    end_subpath(true);
    at_ = begin_;
  }

  void read_command(char command) {
    const bool relative = command >= 'a';
    const char kind = relative ? static_cast<char>(command - 'a' + 'A') : command;
    if (kind == 'M') return move(relative);
    if (kind == 'Z') {
      reflected_cubic_ = reflected_quadratic_ = std::nullopt;
      return close();
    }
    do {
      if (!read_segment(kind, relative)) return fail(1, fmt::format("{} is no command of a path", command));
    } while (more_arguments());
  }

  /// One curve; false if there is no such command.
  bool read_segment(char kind, bool relative) {
    const auto cubic = std::exchange(reflected_cubic_, std::nullopt);
    const auto quadratic = std::exchange(reflected_quadratic_, std::nullopt);
    switch (kind) {
      case 'L':
        add(Curve::line(at_, point(relative)));
        return true;
      case 'H':
        add(Curve::line(at_, {number() + (relative ? at_[0] : 0), at_[1]}));
        return true;
      case 'V':
        add(Curve::line(at_, {at_[0], number() + (relative ? at_[1] : 0)}));
        return true;
      case 'C':
        add_cubic(point(relative), relative);
        return true;
      case 'S':
        add_cubic(cubic.value_or(at_), relative);
        return true;
      case 'Q':
        add_quadratic(point(relative), relative);
        return true;
      case 'T':
        add_quadratic(quadratic.value_or(at_), relative);
        return true;
      case 'A':
        add_arc(relative);
        return true;
      default:
        return false;
    }
  }

  void add_cubic(const Point& first, bool relative) {
    const Point second = point(relative), end = point(relative);
    add(Curve::cubic(at_, first, second, end));
    reflected_cubic_ = 2 * end - second;
  }
  void add_quadratic(const Point& control, bool relative) {
    const Point end = point(relative);
    add(Curve::quadratic(at_, control, end));
    reflected_quadratic_ = 2 * end - control;
  }
  void add_arc(bool relative) {
    const double rx = number(), ry = number(), turn = number() * pi / 180;
    const bool large = flag(), sweep = flag();
    const Point end = point(relative);
    if (end != at_) add(arc_between(at_, end, rx, ry, turn, large, sweep));
  }

  Scanner scan_;
  SvgPath result_;
  std::vector<Curve> curves_;
  Point at_{}, begin_{};
  std::optional<Point> reflected_cubic_, reflected_quadratic_;  ///< control points that S and T continue with
  bool has_begun_ = false;
};

std::optional<Affine> transform_of(const std::string& name, const std::vector<double>& v) {
  const auto n = v.size();
  if (name == "matrix" && n == 6)
    return Affine{.xx = v[0], .xy = v[2], .yx = v[1], .yy = v[3], .dx = v[4], .dy = v[5]};
  if (name == "translate" && (n == 1 || n == 2)) return Affine::shift({v[0], n == 2 ? v[1] : 0});
  if (name == "scale" && (n == 1 || n == 2)) return Affine::scaling(v[0], n == 2 ? v[1] : v[0]);
  if (name == "rotate" && (n == 1 || n == 3)) {
    const Affine turn = Affine::rotation(v[0] * pi / 180);
    if (n == 1) return turn;
    return Affine::shift({v[1], v[2]}) * turn * Affine::shift({-v[1], -v[2]});
  }
  if (name == "skewX" && n == 1) return Affine{.xy = std::tan(v[0] * pi / 180)};
  if (name == "skewY" && n == 1) return Affine{.yx = std::tan(v[0] * pi / 180)};
  return {};
}

}  // namespace

SvgPath parse_svg_path(std::string_view data) { return PathReader(data).read(); }

std::optional<Affine> parse_svg_transform(std::string_view text) {
  Affine result;
  Scanner scan(text);
  scan.skip_spaces();
  if (text.substr(scan.place()) == "none") return result;
  while (!scan.on_end()) {
    const std::string name = scan.word();
    scan.skip_spaces();
    if (!scan.skip('(')) return {};
    std::vector<double> values;
    scan.skip_spaces();
    while (!scan.skip(')')) {
      const auto value = scan.number();
      if (!value) return {};
      values.push_back(*value);
      scan.skip_separator();
    }
    const auto next = transform_of(name, values);
    if (!next) return {};
    result = result * *next;
    scan.skip_separator();
  }
  return result;
}

std::optional<std::vector<double>> parse_svg_numbers(std::string_view text) {
  std::vector<double> values;
  Scanner scan(text);
  scan.skip_spaces();
  while (!scan.on_end()) {
    const auto value = scan.number();
    if (!value) return {};
    values.push_back(*value);
    scan.skip_separator();
  }
  return values;
}

std::optional<SvgLength> parse_svg_length(std::string_view text) {
  Scanner scan(text);
  scan.skip_spaces();
  const auto value = scan.number();
  if (!value) return {};
  std::string unit = scan.skip('%') ? "%" : scan.word();
  scan.skip_spaces();
  if (!scan.on_end()) return {};
  return SvgLength{*value, std::move(unit)};
}

}  // namespace wheelwright
