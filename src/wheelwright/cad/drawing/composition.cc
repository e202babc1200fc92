#include "wheelwright/cad/drawing/composition.h"

#include <algorithm>
#include <cmath>

namespace wheelwright {

namespace {

/// Where each curve must be cut so that every piece is covered wholly or not at all: at its meetings with
/// curves of other outlines, and at their ends that lie on it.
std::vector<std::vector<double>> cuts(const CurveTree& tree, const auto& are_of_one_outline,
                                      double tolerance) {
  const std::vector<Curve>& curves = tree.curves();
  std::vector<std::vector<double>> result(curves.size());
  const auto cut_at_ends = [&](int of, int other) {
    for (const Point& end : {curves[other].start(), curves[other].end()})
      if (const auto near = curves[of].nearest(end); near.distance2 <= tolerance * tolerance)
        result[of].push_back(near.parameter);
  };
  tree.for_each_pair(tolerance, [&](int i, int j) {
    if (are_of_one_outline(i, j)) return true;
    for (const auto& [s, t] : meetings(curves[i], curves[j])) {
      result[i].push_back(s);
      result[j].push_back(t);
    }
    cut_at_ends(i, j);
    cut_at_ends(j, i);
    return true;
  });
  return result;
}

/// The pieces of a curve between its cuts; cuts closer than 1e-9 of the curve are merged.
std::vector<Curve> pieces_between(const Curve& curve, std::vector<double> cuts) {
  cuts.push_back(1);
  std::sort(cuts.begin(), cuts.end());
  std::vector<Curve> result;
  double last = 0;
  constexpr double least = 1e-9;
  for (const double cut : cuts) {
    if (cut - last < least) continue;
    const double end = 1 - cut < least ? 1 : cut;
    result.push_back(curve.part(last, end));
    last = end;
  }
  return result;
}

}  // namespace

Composition::Composition(const std::vector<Figure>& figures) {
  std::vector<Curve> curves;
  Box all;
  for (const Figure& figure : figures) {
    for (std::size_t k = 0; k < figure.outlines.size(); ++k)
      for (const DrawnLoop& loop : figure.outlines[k].loops)
        for (const Curve& whole : loop.curves)
          for (const Curve& piece : simple_pieces(whole)) {
            curves.push_back(piece);
            all.add(piece.box());
            owners_.push_back({static_cast<int>(fills_.size()), static_cast<int>(k)});
          }
    fills_.push_back(figure.fill);
  }
  curves_ = std::make_unique<CurveTree>(std::move(curves));
  const double touching = 1e-9 * all.size(), beside = 1e-7 * all.size();
  const auto cut = cuts(
      *curves_, [&](int i, int j) { return owners_[i] == owners_[j]; }, touching);
  std::vector<Curve> boundary;
  for (std::size_t i = 0; i < cut.size(); ++i)
    for (const Curve& piece : pieces_between(curves_->curves()[i], cut[i])) {
      const Point at = piece.at(0.5), along = piece.derivative(0.5);
      const double length = norm<2>(along);
      if (length == 0) continue;
      const Point aside = std::min(beside, 0.01 * length) / length * Point{-along[1], along[0]};
      if (is_hole(at + aside) != is_hole(at - aside)) boundary.push_back(piece);
    }
  boundary_ = std::make_unique<CurveTree>(std::move(boundary));
}

bool Composition::is_hole(const Point& x) const {
  std::vector<int> crossed;
  curves_->crossed(x, crossed);
  std::vector<Owner> owners;
  for (const int curve : crossed) owners.push_back(owners_[curve]);
  std::sort(owners.begin(), owners.end());
  // The last figure that holds x in one of its outlines: which a ray leaves an odd number of times.
  for (auto end = owners.end(); end != owners.begin();) {
    const auto begin = std::lower_bound(owners.begin(), end, *(end - 1));
    if ((end - begin) % 2 == 1) return fills_[begin->figure] == Fill::hole;
    end = begin;
  }
  return false;
}

double Composition::distance(const Point& x, double bound) const {
  return std::sqrt(boundary_->distance2(x, bound * bound));
}

}  // namespace wheelwright
