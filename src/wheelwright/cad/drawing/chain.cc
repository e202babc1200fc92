#include "wheelwright/cad/drawing/chain.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace wheelwright {

DrawnLoop closed_loop(const std::vector<Curve>& curves, std::string place) {
  DrawnLoop loop{{}, std::move(place)};
  for (const Curve& curve : curves)
    if (curve.start() != curve.end() || curve.box().size() > 0) loop.curves.push_back(curve);
  std::vector<Curve>& chain = loop.curves;
  if (chain.empty()) return loop;
  double size = 0;
  for (const Curve& curve : chain) size = std::max(size, curve.box().size());
  constexpr double rounding = 1e-9;
  if (distance(chain.back().end(), chain.front().start()) > rounding * size)
    chain.push_back(Curve::line(chain.back().end(), chain.front().start()));
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const Curve& before = chain[i == 0 ? chain.size() - 1 : i - 1];
    chain[i] = chain[i].with_ends(before.end(), chain[i].end());
  }
  return loop;
}

namespace {

/// Ends of curves, found by their places.
class Ends {
 public:
  struct End {
    int curve;
    bool is_start;
    Point at;
  };

  /// Of at least one curve.
  Ends(const std::vector<LooseCurve>& curves, double tolerance)
      : tolerance_(tolerance), origin_(curves.front().curve.start()) {
    for (int i = 0; i < static_cast<int>(curves.size()); ++i) {
      add({i, true, curves[i].curve.start()});
      add({i, false, curves[i].curve.end()});
    }
  }

  /// The ends within the tolerance of a place.
  std::vector<End> near(const Point& at) const {
    std::vector<End> result;
    const auto [column, row] = cell(at);
    for (long long i = column - 1; i <= column + 1; ++i)
      for (long long j = row - 1; j <= row + 1; ++j)
        if (const auto found = cells_.find({i, j}); found != cells_.end())
          for (const End& end : found->second)
            if (distance(end.at, at) <= tolerance_) result.push_back(end);
    return result;
  }

 private:
  using Cell = std::pair<long long, long long>;

  Cell cell(const Point& at) const {
    const Point from_origin = at - origin_;
    return {std::llround(from_origin[0] / tolerance_), std::llround(from_origin[1] / tolerance_)};
  }
  void add(const End& end) { cells_[cell(end.at)].push_back(end); }

  double tolerance_;
  Point origin_;
  std::map<Cell, std::vector<End>> cells_;
};

/// Whether a curve is a loop by itself.
bool closes_itself(const Curve& curve, double tolerance) {
  return distance(curve.start(), curve.end()) <= tolerance;
}

}  // namespace

Chains chained(const std::vector<LooseCurve>& curves, double tolerance) {
  Chains result;
  if (curves.empty()) return result;
  std::vector<bool> used(curves.size(), false);
  const Ends ends(curves, tolerance);
  for (std::size_t first = 0; first < curves.size(); ++first) {
    if (used[first]) continue;
    used[first] = true;
    std::vector<Curve> chain{curves[first].curve};
    bool is_open = false;
    while (!closes_itself(chain.front().with_ends(chain.front().start(), chain.back().end()), tolerance)) {
      const Point at = chain.back().end();
      const std::vector<Ends::End> here = ends.near(at);
      const auto next =
          std::find_if(here.begin(), here.end(), [&](const auto& end) { return !used[end.curve]; });
      if (here.size() != 2 || next == here.end()) {
        is_open = true;
        result.open_ends.push_back({at, curves[first].place, here.size() > 2});
        break;
      }
      used[next->curve] = true;
      const Curve& curve = curves[next->curve].curve;
      chain.push_back((next->is_start ? curve : curve.reversed())
                          .with_ends(at, next->is_start ? curve.end() : curve.start()));
    }
    if (!is_open) {
      chain.back() = chain.back().with_ends(chain.back().start(), chain.front().start());
      result.loops.push_back(closed_loop(chain, curves[first].place));
    }
  }
  return result;
}

}  // namespace wheelwright
