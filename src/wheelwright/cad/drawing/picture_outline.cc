#include "wheelwright/cad/drawing/picture_outline.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "wheelwright/cad/drawing/chain.h"

namespace wheelwright {

namespace {

/// Values at the nodes of a rectangular grid; the columns may be periodic.
struct Samples {
  int columns, rows;
  bool periodic;
  std::function<double(int, int)> value;  ///< at a column and a row, less the threshold; positive is drawn
};

/// An edge between a node and the next one in its row (or, if `down`, in its column), where the contour
/// crosses it.
struct Edge {
  int column, row;
  bool down;
  auto operator<=>(const Edge&) const = default;
};

/// Contours as closed chains of edges, by marching squares: between the four nodes of a cell the contour
/// joins the crossed edges so that the drawn region lies on its left; if all four are crossed, the mean of
/// the nodes decides.
class Contours {
 public:
  explicit Contours(const Samples& samples) : samples_(samples) {
    const int last_column = samples.periodic ? samples.columns : samples.columns - 1;
    for (int row = 0; row + 1 < samples.rows; ++row)
      for (int column = 0; column < last_column; ++column) add_cell(column, row);
  }

  std::vector<std::vector<Edge>> loops() {
    std::vector<std::vector<Edge>> result;
    while (!next_.empty()) {
      std::vector<Edge> loop{next_.begin()->first};
      for (auto step = next_.begin(); step != next_.end();) {
        const Edge next = step->second;
        next_.erase(step);
        step = next_.find(next);
        if (step != next_.end()) loop.push_back(next);
      }
      result.push_back(std::move(loop));
    }
    return result;
  }

 private:
  int wrapped(int column) const { return samples_.periodic ? column % samples_.columns : column; }

  void add_cell(int column, int row) {
    const int right = wrapped(column + 1);
    // The nodes of the cell, and the edges from each to the next one.
    const std::array<double, 4> values{samples_.value(column, row), samples_.value(column, row + 1),
                                       samples_.value(right, row + 1), samples_.value(right, row)};
    const std::array<Edge, 4> edges{Edge{column, row, true}, Edge{column, row + 1, false},
                                    Edge{right, row, true}, Edge{column, row, false}};
    std::vector<int> in,
        out;  // edges at which the walk round the cell comes into what is drawn, and leaves it
    for (int k = 0; k < 4; ++k) {
      const bool before = values[k] > 0, after = values[(k + 1) % 4] > 0;
      if (!before && after) in.push_back(k);
      if (before && !after) out.push_back(k);
    }
    const bool middle_is_drawn = values[0] + values[1] + values[2] + values[3] > 0;
    for (std::size_t k = 0; k < in.size(); ++k) {
      const std::size_t partner = in.size() == 2 ? partner_of(in[k], out, middle_is_drawn) : 0;
      next_[edges[out[partner]]] = edges[in[k]];
    }
  }

  /// With two ways in: the corners that are drawn are joined across the middle, or each is cut off.
  static std::size_t partner_of(int in, const std::vector<int>& out, bool joined) {
    const int wanted = joined ? (in + 3) % 4 : (in + 1) % 4;
    return out[0] == wanted ? 0 : 1;
  }

  const Samples& samples_;
  std::map<Edge, Edge> next_;
};

/// The contours as polygons, of points that `place` puts where a column and a row, with fractions, belong.
DrawnOutline outline_of(const Samples& samples, const std::function<Point(double, double)>& place) {
  DrawnOutline outline;
  for (const std::vector<Edge>& edges : Contours(samples).loops()) {
    std::vector<Point> corners;
    for (const Edge& edge : edges) {
      const int next_column = edge.down ? edge.column : edge.column + 1,
                next_row = edge.down ? edge.row + 1 : edge.row;
      const double a = samples.value(edge.column, edge.row),
                   b = samples.value(samples.periodic ? next_column % samples.columns : next_column,
                                     next_row);
      const double share = a / (a - b);
      corners.push_back(place(edge.column + (edge.down ? 0 : share), edge.row + (edge.down ? share : 0)));
    }
    std::vector<Curve> sides;
    for (std::size_t i = 0; i < corners.size(); ++i)
      sides.push_back(Curve::line(corners[i], corners[(i + 1) % corners.size()]));
    DrawnLoop loop = closed_loop(sides, "");
    if (!loop.curves.empty()) outline.loops.push_back(std::move(loop));
  }
  return outline;
}

constexpr double not_drawn = 0;

}  // namespace

DrawnOutline wheel_outline(const Picture& picture, double threshold, double width) {
  // Around the picture nothing is drawn.
  const auto value = [&](int column, int row) {
    const bool inside = column > 0 && row > 0 && column <= picture.columns && row <= picture.rows;
    return (inside ? picture.at(column - 1, row - 1) : not_drawn) - threshold;
  };
  const double pixel = width / picture.columns;
  // The centre of the first pixel is node 1, half a pixel from the picture's edge.
  return outline_of({picture.columns + 2, picture.rows + 2, false, value}, [&](double column, double row) {
    return Point{(column - 0.5 - 0.5 * picture.columns) * pixel, -(row - 0.5 - 0.5 * picture.rows) * pixel};
  });
}

DrawnOutline ring_outline(const Picture& picture, double threshold, int count, double inner_radius,
                          double outer_radius) {
  const int columns = picture.columns * count;
  const auto value = [&](int column, int row) {
    const bool inside = row > 0 && row <= picture.rows;
    return (inside ? picture.at(column % picture.columns, row - 1) : not_drawn) - threshold;
  };
  const double height = (outer_radius - inner_radius) / picture.rows;
  return outline_of({columns, picture.rows + 2, true, value}, [&](double column, double row) {
    const double azimuth = 2 * std::numbers::pi * (column + 0.5) / columns,
                 radius = outer_radius - (row - 0.5) * height;
    return radius * Point{std::cos(azimuth), std::sin(azimuth)};
  });
}

}  // namespace wheelwright
