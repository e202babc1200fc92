#include "wheelwright/report/outline.h"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <set>

namespace wheelwright {
namespace {

/// Twice the area, positive for one sense of turning.
std::int64_t signed_double_area(const PicturePolygon& polygon) {
  std::int64_t sum = 0;
  PicturePoint a = polygon.back();
  for (const PicturePoint& b : polygon) {
    sum += std::int64_t(a[0]) * b[1] - std::int64_t(a[1]) * b[0];
    a = b;
  }
  return sum;
}

/// Directed sides, none of them together with its reverse.
class Sides {
 public:
  void add(const PicturePoint& from, const PicturePoint& to) {
    if (from == to) return;
    const auto reverse = ends_.find(to);
    if (reverse != ends_.end()) {
      const auto found = reverse->second.find(from);
      if (found != reverse->second.end()) {
        reverse->second.erase(found);
        if (reverse->second.empty()) ends_.erase(reverse);
        return;
      }
    }
    ends_[from].insert(to);
  }

  bool empty() const { return ends_.empty(); }

  /// Takes out the closed curve through the first point.
  PicturePolygon take_curve() {
    PicturePolygon curve;
    const PicturePoint first = ends_.begin()->first;
    PicturePoint at = first;
    do {
      curve.push_back(at);
      const auto side = ends_.find(at);
      const PicturePoint next = *side->second.begin();
      side->second.erase(side->second.begin());
      if (side->second.empty()) ends_.erase(side);
      at = next;
    } while (at != first);
    return curve;
  }

 private:
  std::map<PicturePoint, std::multiset<PicturePoint>> ends_;
};

}  // namespace

std::vector<PicturePolygon> union_outlines(const std::vector<PicturePolygon>& polygons) {
  Sides sides;
  for (const PicturePolygon& polygon : polygons) {
    const std::size_t n = polygon.size();
    const bool forward = n > 0 && signed_double_area(polygon) >= 0;
    for (std::size_t k = 0; k < n; ++k) {
      const PicturePoint &a = polygon[k], &b = polygon[(k + 1) % n];
      forward ? sides.add(a, b) : sides.add(b, a);
    }
  }
  std::vector<PicturePolygon> outlines;
  while (!sides.empty()) outlines.push_back(sides.take_curve());
  return outlines;
}

std::string outline_path(const std::vector<PicturePolygon>& outlines) {
  std::string path;
  for (const PicturePolygon& outline : outlines) {
    if (outline.size() < 3) continue;
    path += fmt::format("M{} {}l", outline[0][0], outline[0][1]);
    for (std::size_t k = 1; k < outline.size(); ++k) {
      const int dx = outline[k][0] - outline[k - 1][0], dy = outline[k][1] - outline[k - 1][1];
      path += fmt::format("{}{}{}{}", k > 1 && dx >= 0 ? " " : "", dx, dy >= 0 ? " " : "", dy);
    }
    path += 'z';
  }
  return path;
}

}  // namespace wheelwright
