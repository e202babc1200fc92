#include "wheelwright/cad/solid/lofted_hole.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <unordered_set>

namespace wheelwright::cad {
namespace {

/// Points of a half-plane: distance from the axis and z.
using Profile = std::vector<Vec<2>>;

/// The half-plane of one azimuth about the axis.
class HalfPlane {
 public:
  HalfPlane(const HolePiece& piece, double azimuth)
      : piece_(piece), along_{std::cos(azimuth), std::sin(azimuth)} {}

  Vec<3> point(const Vec<2>& x) const {
    return {piece_.axis[0] + x[0] * along_[0], piece_.axis[1] + x[0] * along_[1], x[1]};
  }

  /// Returns the curve in which the half-plane meets the piece, from the first edge to the other or to the
  /// axis; nothing if they do not meet in one curve.
  std::optional<Profile> profile(const std::unordered_set<int>& other) const {
    const auto begin = only_crossing(piece_.first);
    if (!begin || (!piece_.other.empty() && !only_crossing(piece_.other))) return {};
    Profile result{crossing(*begin)};
    for (int side = *begin;;) {
      const int second = Sides::next(side), third = Sides::next(second);
      side = is_crossed(second) ? second : third;
      const Vec<2> x = crossing(side);
      if (x[0] <= 0) {
        if (!piece_.other.empty()) return {};
        const Vec<2>& last = result.back();
        result.push_back(between(last, x, last[0] / (last[0] - x[0])));
        result.back()[0] = 0;
        return result;
      }
      result.push_back(x);
      if (piece_.sides.is_border(side)) return other.contains(side) ? std::optional(result) : std::nullopt;
      side = piece_.sides.opposite(side);
    }
  }

  /// The nearest point of {psi = 0} in the half-plane; along one axis only if `axis` is 0 or 1. Nothing if it
  /// is farther away than `reach` [m].
  std::optional<Vec<2>> projection(const Vec<2>& start, const ZeroSurface& zero, double reach,
                                   int axis = -1) const {
    Vec<2> x = start;
    constexpr int iterations = 8;
    for (int i = 0; i < iterations; ++i) {
      const auto value = zero.at(point(x));
      Vec<2> slope{value.gradient[0] * along_[0] + value.gradient[1] * along_[1], value.gradient[2]};
      if (axis >= 0) slope[1 - axis] = 0;
      const double square = dot(slope, slope);
      if (!(square > 0)) return {};
      x -= value.psi / square * slope;
      if (!(distance(x, start) <= reach)) return {};
    }
    return x;
  }

 private:
  double beside(int vertex) const {
    const Vec<3>& x = piece_.mesh.points[vertex];
    return along_[0] * (x[1] - piece_.axis[1]) - along_[1] * (x[0] - piece_.axis[0]);
  }

  bool is_crossed(int side) const {
    return (beside(piece_.sides.from(side)) < 0) != (beside(piece_.sides.to(side)) < 0);
  }

  /// Returns the point at which the half-plane crosses a side. Its distance is negative beyond the axis.
  Vec<2> crossing(int side) const {
    const int from = piece_.sides.from(side), to = piece_.sides.to(side);
    const double a = beside(from), b = beside(to);
    const Vec<3> x = between(piece_.mesh.points[from], piece_.mesh.points[to], a / (a - b));
    return {along_[0] * (x[0] - piece_.axis[0]) + along_[1] * (x[1] - piece_.axis[1]), x[2]};
  }

  /// The side of an edge that the half-plane crosses; nothing if it is not exactly one.
  std::optional<int> only_crossing(const std::vector<int>& edge) const {
    std::optional<int> found;
    for (const int side : edge) {
      if (!is_crossed(side) || crossing(side)[0] <= 0) continue;
      if (found) return {};
      found = side;
    }
    return found;
  }

  const HolePiece& piece_;
  Vec<2> along_;
};

/// Points that divide a profile into parts of equal lengths.
Profile divided(const Profile& profile, int parts) {
  std::vector<double> length{0};
  for (std::size_t i = 1; i < profile.size(); ++i)
    length.push_back(length.back() + distance(profile[i - 1], profile[i]));
  Profile result{profile.front()};
  for (int j = 1; j < parts; ++j) {
    const double wanted = length.back() * j / parts;
    const auto after = std::ranges::upper_bound(length, wanted) - length.begin();
    result.push_back(between(profile[after - 1], profile[after],
                             (wanted - length[after - 1]) / (length[after] - length[after - 1])));
  }
  result.push_back(profile.back());
  return result;
}

std::string at_azimuth(double azimuth) {
  return " at " + std::to_string(static_cast<int>(std::lround(azimuth * 180 / std::numbers::pi))) +
         " degrees about its middle";
}

/// The points of a surface with these numbers of intervals.
Expected<std::vector<Vec<3>>, std::string> points_of(const HolePiece& piece, const ZeroSurface& zero,
                                                     int columns, int rows, double reach) {
  const std::unordered_set<int> other(piece.other.begin(), piece.other.end());
  std::vector<Vec<3>> points;
  for (int i = 0; i < columns; ++i) {
    const double azimuth = 2 * std::numbers::pi * i / columns;
    const HalfPlane plane(piece, azimuth);
    const auto profile = plane.profile(other);
    if (!profile) return "a hole is not one curve in a half-plane" + at_azimuth(azimuth);
    const Profile parts = divided(*profile, rows);
    for (int j = 0; j <= rows; ++j) {
      const int axis = j == 0 ? 0 : j < rows ? -1 : piece.other.empty() ? 1 : 0;
      const auto x = plane.projection(parts[j], zero, reach, axis);
      if (!x) return "points of a hole could not be found" + at_azimuth(azimuth);
      points.push_back(plane.point(*x));
    }
  }
  return points;
}

/// The largest distances from {psi = 0} in the middle between points along u, v and both, and along u at
/// places that are not evenly spaced: points and middles both miss waves around the axle of certain lengths.
struct Deviations {
  double around, along, between;
  bool folds;

  double largest() const { return std::max({around, along, between}); }
};

Deviations deviations(const SplineSurface& surface, const ZeroSurface& zero) {
  Deviations result{0, 0, 0, false};
  const double uneven = 1 / std::numbers::phi;  // multiples of it are spread over the intervals
  int sides = 0;                                // facing out of the material or into it
  const auto enlarge = [&](double& largest, double u, double v) {
    largest = std::max(largest, zero.at(at(surface, u, v).position).distance());
  };
  for (int i = 0; i < surface.columns; ++i)
    for (int j = 0; j < surface.rows; ++j) {
      enlarge(result.around, i + 0.5, j);
      enlarge(result.around, i + std::fmod(uneven * (i + 1), 1.0), j);
      enlarge(result.along, i, j + 0.5);
      enlarge(result.between, i + 0.5, j + 0.5);
      const SurfaceJet jet = at(surface, i + 0.5, j + 0.5);
      const int side = dot(cross(jet.by_u, jet.by_v), zero.at(jet.position).gradient) > 0 ? 1 : -1;
      if (sides != 0 && side != sides) result.folds = true;
      sides = side;
    }
  return result;
}

}  // namespace

Expected<SplineSurface, std::string> lofted_hole(const HolePiece& piece, const ZeroSurface& zero,
                                                 double tolerance) {
  constexpr int fewest = 16, most_columns = 1024, most_rows = 256;
  constexpr double share = 0.8;  // of the tolerance, at the middles between points
  constexpr double reach_in_tolerances = 30;
  for (int columns = fewest, rows = fewest;;) {
    const auto points = points_of(piece, zero, columns, rows, reach_in_tolerances * tolerance);
    if (!points) return points.failure();
    SplineSurface surface = interpolated(*points, columns, rows);
    const Deviations found = deviations(surface, zero);
    const double allowed = share * tolerance;
    if (!found.folds && found.largest() <= allowed) return surface;
    const bool is_around = found.around >= found.along || (found.around > allowed && columns <= rows);
    const bool more_columns = columns < most_columns && (is_around || rows == most_rows);
    if (!more_columns && rows == most_rows)
      return found.folds ? std::string("a lofted surface of a hole folds")
                         : std::string("a lofted surface of a hole misses the tolerance");
    (more_columns ? columns : rows) *= 2;
  }
}

SurfaceDeviation deviation(const SplineSurface& surface, const ZeroSurface& zero, int parts) {
  SurfaceDeviation largest{0, {}};
  for (int i = 0; i < parts * surface.columns; ++i)
    for (int j = 0; j <= parts * surface.rows; ++j) {
      const Vec<3> x = at(surface, double(i) / parts, double(j) / parts).position;
      const double found = zero.at(x).distance();
      if (found > largest.distance) largest = {found, polar<3>(x)};
    }
  return largest;
}

}  // namespace wheelwright::cad
