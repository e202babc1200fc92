#include "wheelwright/output/report/lit_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wheelwright {
namespace {

constexpr int samples = 2;  // per pixel, along each axis
const double sharp_edge = std::cos(40 * std::numbers::pi / 180);

Vec<3> unit_vector(Vec<3> v) {
  const double length = norm<3>(v);
  for (double& x : v) x = length > 0 ? x / length : 0;
  return v;
}

/// The triangles at every vertex: those of vertex v are triangles[begin[v]] to triangles[begin[v + 1] - 1].
struct Fans {
  std::vector<int> begin, triangles;

  explicit Fans(const LitBody& body)
      : begin(body.points.size() + 1, 0), triangles(3 * body.triangles.size()) {
    for (const auto& t : body.triangles)
      for (const int v : t) ++begin[v + 1];
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::vector<int> next(begin.begin(), begin.end() - 1);
    for (int t = 0; t < std::ssize(body.triangles); ++t)
      for (const int v : body.triangles[t]) triangles[next[v]++] = t;
  }
};

/// Normals in the camera's frame, scaled by the triangles' areas and of length 1.
struct Normals {
  std::vector<Vec<3>> sized, unit;

  Normals(const LitBody& body, const Camera& camera) {
    for (const auto& [a, b, c] : body.triangles) {
      const Vec<3> u = body.points[b] - body.points[a], v = body.points[c] - body.points[a];
      sized.push_back(camera.turned(cross(u, v)));
      unit.push_back(unit_vector(sized.back()));
    }
  }

  /// The normal at a triangle's corner: the mean over the triangles there that do not form a sharp edge with
  /// it.
  Vec<3> at_corner(int triangle, int vertex, const Fans& fans) const {
    Vec<3> sum{};
    for (int k = fans.begin[vertex]; k < fans.begin[vertex + 1]; ++k) {
      const int other = fans.triangles[k];
      if (dot<3>(unit[triangle], unit[other]) < sharp_edge) continue;
      sum += sized[other];
    }
    return unit_vector(sum);
  }
};

/// The brightness of a surface with this normal: light from above, from the camera's left, and weaker from
/// all sides.
double brightness(const Vec<3>& normal) {
  const Vec<3> key = unit_vector({-0.45, 0.65, 0.75}), fill = unit_vector({0.9, -0.1, 0.4});
  return 0.52 + 0.16 * 0.5 * (1 + normal[1]) + 0.50 * std::max(0.0, dot<3>(normal, key)) +
         0.12 * std::max(0.0, dot<3>(normal, fill));
}

/// The amount of white added by a shiny surface.
double highlight(const Vec<3>& normal) {
  const Vec<3> half = unit_vector({-0.26, 0.38, 1});
  return 0.10 * std::pow(std::max(0.0, dot<3>(normal, half)), 24);
}

/// A corner as it is drawn.
struct DrawnCorner {
  Vec<3> place;  ///< pixels from the left and from above, and towards the viewer
  Vec<3> colour;
};

class Canvas {
 public:
  explicit Canvas(int size)
      : size_(size),
        colours_(std::size_t(size) * size, std::array<float, 3>{255, 255, 255}),
        depths_(colours_.size(), -INFINITY) {}

  int size() const { return size_; }

  void draw(const std::array<DrawnCorner, 3>& corners) {
    const auto& [a, b, c] = corners;
    const double area = side(a.place, b.place, c.place);
    if (!(std::abs(area) > 0)) return;
    const auto range = [&](int axis) {
      const auto [low, high] =
          std::minmax({corners[0].place[axis], corners[1].place[axis], corners[2].place[axis]});
      return std::array{std::max(0, static_cast<int>(std::ceil(low - 0.5))),
                        std::min(size_ - 1, static_cast<int>(std::floor(high - 0.5)))};
    };
    const auto columns = range(0), rows = range(1);
    for (int row = rows[0]; row <= rows[1]; ++row)
      for (int column = columns[0]; column <= columns[1]; ++column) {
        const Vec<3> pixel{column + 0.5, row + 0.5, 0};
        const double u = side(b.place, c.place, pixel) / area, v = side(c.place, a.place, pixel) / area,
                     w = 1 - u - v;
        if (u < 0 || v < 0 || w < 0) continue;
        const double depth = u * a.place[2] + v * b.place[2] + w * c.place[2];
        const std::size_t k = std::size_t(row) * size_ + column;
        if (depth <= depths_[k]) continue;
        depths_[k] = depth;
        for (int d = 0; d < 3; ++d)
          colours_[k][d] = static_cast<float>(u * a.colour[d] + v * b.colour[d] + w * c.colour[d]);
      }
  }

  /// The means of the samples of every pixel.
  Image image() const {
    const int pixels = size_ / samples;
    Image image{pixels, pixels, {}};
    image.rgb.reserve(std::size_t(3) * pixels * pixels);
    for (int row = 0; row < pixels; ++row)
      for (int column = 0; column < pixels; ++column)
        for (int d = 0; d < 3; ++d) {
          double sum = 0;
          for (int i = 0; i < samples; ++i)
            for (int j = 0; j < samples; ++j)
              sum += colours_[std::size_t(samples * row + i) * size_ + samples * column + j][d];
          image.rgb.push_back(
              static_cast<std::uint8_t>(std::clamp(std::lround(sum / (samples * samples)), 0L, 255L)));
        }
    return image;
  }

 private:
  /// Twice the signed area of a triangle.
  static double side(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  int size_;
  std::vector<std::array<float, 3>> colours_;
  std::vector<double> depths_;
};

Vec<3> shown_colour(const Rgb& colour, const Vec<3>& normal) {
  const double light = brightness(normal), white = highlight(normal);
  Vec<3> result;
  for (int d = 0; d < 3; ++d) result[d] = std::min(255.0, light * colour[d] + white * 255);
  return result;
}

void draw(const LitBody& body, const Camera& camera, Canvas& canvas) {
  std::vector<Vec<3>> places;
  for (const Vec<3>& point : body.points) {
    const Vec<3> seen = camera.seen(point);
    places.push_back({0.5 * canvas.size() * (1 + seen[0]), 0.5 * canvas.size() * (1 - seen[1]), seen[2]});
  }
  const Normals normals(body, camera);
  const Fans fans(body);
  for (int t = 0; t < std::ssize(body.triangles); ++t) {
    if (body.is_lit && normals.sized[t][2] < 0) continue;  // seen from inside
    std::array<DrawnCorner, 3> corners;
    for (int k = 0; k < 3; ++k) {
      const int v = body.triangles[t][k];
      const Rgb& colour = body.colours[v];
      corners[k] = {places[v], body.is_lit ? shown_colour(colour, normals.at_corner(t, v, fans))
                                           : Vec<3>{double(colour[0]), double(colour[1]), double(colour[2])}};
    }
    canvas.draw(corners);
  }
}

}  // namespace

Camera::Camera(double yaw, double pitch, const Vec<3>& centre, double half) : centre_(centre), half_(half) {
  const Vec<3> right{std::cos(yaw), 0, -std::sin(yaw)},
      towards{std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
  axes_ = {right, cross(towards, right), towards};
}

Vec<3> Camera::turned(const Vec<3>& direction) const {
  return {dot<3>(axes_[0], direction), dot<3>(axes_[1], direction), dot<3>(axes_[2], direction)};
}

Vec<3> Camera::direction(const Vec<3>& turned) const {
  return turned[0] * axes_[0] + turned[1] * axes_[1] + turned[2] * axes_[2];
}

Vec<3> Camera::seen(const Vec<3>& point) const { return turned(point - centre_) / half_; }

Image lit_image(const std::vector<LitBody>& bodies, const Camera& camera, int pixels) {
  Canvas canvas(samples * pixels);
  for (const LitBody& body : bodies) draw(body, camera, canvas);
  return canvas.image();
}

}  // namespace wheelwright
