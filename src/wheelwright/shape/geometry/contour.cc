#include "wheelwright/shape/geometry/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

/// Minimum distance of a crossing from the ends of its edge, as a fraction of the edge. It keeps vertices
/// distinct where psi vanishes at a sample.
constexpr double end_margin = 1e-6;

/// The place of a polygon vertex: at sample (i, j), or at the fraction t of the edge that starts at the
/// sample and runs along an axis.
enum class Site { sample, radial_edge, azimuthal_edge };

struct Vertex {
  int i, j;
  Site site;
  double t;

  Vec<2> position() const {
    return {i + (site == Site::radial_edge ? t : 0), j + (site == Site::azimuthal_edge ? t : 0)};
  }
  bool on_circle(int row) const { return i == row && site != Site::radial_edge; }
};

using Polygon = std::vector<Vertex>;

/// The zero in (0, 1) of the parabola through (0, start), (1/2, middle) and (1, end), where start and end
/// differ in sign.
double parabola_zero(double start, double middle, double end) {
  const double a = 2 * (start + end) - 4 * middle;
  const double b = 4 * middle - 3 * start - end;
  const double q = -0.5 * (b + std::copysign(std::sqrt(std::max(0.0, b * b - 4 * a * start)), b));
  const double near = start / q, far = q / a;
  const double t = near >= 0 && near <= 1 ? near : far;
  return std::clamp(t, end_margin, 1 - end_margin);
}

/// Samples of psi on a grid that is `n` times finer than the cells of the sector. Sample (i, j) is the i-th
/// along the radius and the j-th along the azimuth.
class SampledLevelSet {
 public:
  SampledLevelSet(const LevelSet<2>& psi, int n)
      : n_(n),
        rows_(n * psi.lattice.grid().cells[0]),
        columns_(n * psi.lattice.grid().cells[1]),
        degree_(psi.lattice.degree()),
        cells_(psi.lattice.grid()) {
    for (int cell = 0; cell < cells_.n_cells(); ++cell) nodal_.push_back(psi.cell_values(cell));
    std::vector<ShapeFunctions<2>> at_samples;  // of a cell
    for (int j = 0; j < n; ++j)
      for (int i = 0; i <= n; ++i) at_samples.emplace_back(degree_, unit_cell_point({1.0 * i, 1.0 * j}, 0));
    samples_.resize((rows_ + 1) * columns_);
    for (int j = 0; j < columns_; ++j)
      for (int i = 0; i <= rows_; ++i) {
        const int cell = cell_of(i, j), first_row = n_ * cells_.cell_position(cell)[0];
        samples_[j * (rows_ + 1) + i] = polynomial(at_samples[j % n_ * (n_ + 1) + i - first_row], cell);
      }
  }

  int rows() const { return rows_; }
  int columns() const { return columns_; }
  double sample(int i, int j) const { return samples_[(j % columns_) * (rows_ + 1) + i]; }
  bool material(int i, int j) const { return sample(i, j) < 0; }

  /// Whether all corners of the square with the first corner at sample (i, j) lie in the material, or all in
  /// voids: then no zero is on its sides.
  bool is_uniform(int i, int j) const {
    const bool first = material(i, j);
    return material(i + 1, j) == first && material(i, j + 1) == first && material(i + 1, j + 1) == first;
  }

  /// Polygons of the material in the square with the first corner at sample (i, j).
  std::vector<Polygon> square_polygons(int i, int j) const {
    const auto crossings = square_crossings(i, j);
    const auto corners = square_corners(i, j);
    const int n_crossings =
        std::count_if(crossings.begin(), crossings.end(), [](auto& c) { return c.t > 0; });
    if (n_crossings == 4 && polynomial({i + 0.5, j + 0.5}, i, j) >= 0) {
      const int k = material(i, j) ? 0 : 1;
      return {{crossings[(k + 3) % 4], corners[k], crossings[k]},
              {crossings[k + 1], corners[k + 2], crossings[k + 2]}};
    }
    Polygon polygon;
    for (int k = 0; k < 4; ++k) {
      if (material(corners[k].i, corners[k].j)) polygon.push_back(corners[k]);
      if (crossings[k].t > 0) polygon.push_back(crossings[k]);
    }
    if (polygon.empty()) return {};
    return {polygon};
  }

  /// Whether all samples of the cell lie in the material.
  bool full(int cell) const {
    const auto c = cells_.cell_position(cell);
    for (int j = n_ * c[1]; j <= n_ * (c[1] + 1); ++j)
      for (int i = n_ * c[0]; i <= n_ * (c[0] + 1); ++i)
        if (!material(i, j)) return false;
    return true;
  }

  /// Index of the cell that contains the square (i, j).
  int cell_of(int i, int j) const {
    return cells_.cell_index({std::min(i, rows_ - 1) / n_, std::min(j, columns_ - 1) / n_});
  }

  /// Converts a position in units of samples to a point of the unit cell.
  Vec<2> unit_cell_point(const Vec<2>& position, int cell) const {
    const auto c = cells_.cell_position(cell);
    return {position[0] / n_ - c[0], position[1] / n_ - c[1]};
  }

 private:
  static std::array<Vertex, 4> square_corners(int i, int j) {
    const auto corner = [](int k, int l) { return Vertex{.i = k, .j = l, .site = Site::sample, .t = 0}; };
    return {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
  }

  /// Zeros on the sides of the square; side k runs from corner k to the next. t = 0 marks a side without a
  /// zero.
  std::array<Vertex, 4> square_crossings(int i, int j) const {
    return {{crossing(i, j, Site::radial_edge, i, j), crossing(i + 1, j, Site::azimuthal_edge, i, j),
             crossing(i, j + 1, Site::radial_edge, i, j), crossing(i, j, Site::azimuthal_edge, i, j)}};
  }

  /// The zero on the edge that starts at sample (i, j), for the polynomial of the cell that contains the
  /// square.
  Vertex crossing(int i, int j, Site site, int square_i, int square_j) const {
    const int di = site == Site::radial_edge, dj = site == Site::azimuthal_edge;
    const double start = sample(i, j), end = sample(i + di, j + dj);
    if ((start < 0) == (end < 0)) return {.i = i, .j = j, .site = site, .t = 0};
    const double middle = polynomial({i + 0.5 * di, j + 0.5 * dj}, square_i, square_j);
    return {.i = i, .j = j, .site = site, .t = parabola_zero(start, middle, end)};
  }

  double polynomial(const Vec<2>& position, int square_i, int square_j) const {
    const int cell = cell_of(square_i, square_j);
    return polynomial(ShapeFunctions<2>(degree_, unit_cell_point(position, cell)), cell);
  }

  double polynomial(const ShapeFunctions<2>& shape, int cell) const {
    double value = 0;
    for (int a = 0; a < nodes_per_cell<2>(degree_); ++a) value += shape.value[a] * nodal_[cell][a];
    return value;
  }

  int n_, rows_, columns_, degree_;
  PolarGrid<2> cells_;
  std::vector<std::vector<double>> nodal_;
  std::vector<double> samples_;
};

/// An edge of the boundary of the material in one sector, with the material on the left.
struct Segment {
  Vertex start, end;
  ContourKind kind;
  Vec<2> start_point;  ///< Cartesian position in the first sector
};

/// Whether the side from a to b of a polygon lies on the boundary of the material; sets the kind of boundary.
bool bounds_material(const Vertex& a, const Vertex& b, int rows, ContourKind& kind) {
  if (a.on_circle(0) && b.on_circle(0)) {
    kind = ContourKind::rim;
    return true;
  }
  if (a.on_circle(rows) && b.on_circle(rows)) {
    kind = ContourKind::tread;
    return true;
  }
  kind = ContourKind::free;
  return a.site != Site::sample && b.site != Site::sample;
}

std::vector<Segment> sector_segments(const LevelSet<2>& psi, int subdivisions) {
  const SampledLevelSet samples(psi, subdivisions);
  const PolarGrid<2>& grid = psi.lattice.grid();
  const int degree = psi.lattice.degree();
  const double column_angle = grid.column_angle();
  std::vector<CellMap<2>> maps;
  for (int row = 0; row < grid.cells[0]; ++row) maps.emplace_back(grid, degree, std::array{row, 0});

  std::vector<Segment> segments;
  for (int j = 0; j < samples.columns(); ++j) {
    for (int i = 0; i < samples.rows(); ++i) {
      const bool is_at_circle = i == 0 || i + 1 == samples.rows();
      if (samples.is_uniform(i, j) && !(is_at_circle && samples.material(i, j))) continue;
      const int cell = samples.cell_of(i, j);
      const auto c = grid.cell_position(cell);
      for (const Polygon& polygon : samples.square_polygons(i, j)) {
        for (std::size_t k = 0; k < polygon.size(); ++k) {
          const Vertex &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
          ContourKind kind;
          if (!bounds_material(a, b, samples.rows(), kind)) continue;
          const ShapeFunctions<2> shape(degree, samples.unit_cell_point(a.position(), cell));
          segments.push_back({.start = a,
                              .end = b,
                              .kind = kind,
                              .start_point = rotated<2>(maps[c[0]].position(shape), c[1] * column_angle)});
        }
      }
    }
  }
  return segments;
}

/// Follows the segments of the full ring, numbered s + n_segments * sector.
class Successors {
 public:
  Successors(const std::vector<Segment>& segments, const PolarGrid<2>& grid, int subdivisions)
      : segments_(segments),
        samples_per_line_(subdivisions * grid.cells[0] + 1),
        columns_(subdivisions * grid.cells[1]),
        n_sectors_(grid.n_sectors) {
    for (int s = 0; s < n(); ++s) from_[number(segments[s].start)] = s;
  }

  /// The segment of the ring that begins where this one ends.
  int after(int ring_segment) const {
    const Vertex& end = segments_[ring_segment % n()].end;
    const int next = from_.at(number(end));
    const int sector = ring_segment / n() + sectors_on(end) - sectors_on(segments_[next].start);
    return next + n() * ((sector + n_sectors_) % n_sectors_);
  }

 private:
  int n() const { return static_cast<int>(segments_.size()); }

  /// A vertex has the same number in all squares that share it, and in all sectors.
  std::int64_t number(const Vertex& v) const {
    return 3 * (std::int64_t(v.j % columns_) * samples_per_line_ + v.i) + static_cast<int>(v.site);
  }
  int sectors_on(const Vertex& v) const { return v.j / columns_; }

  const std::vector<Segment>& segments_;
  int samples_per_line_, columns_, n_sectors_;
  std::unordered_map<std::int64_t, int> from_;  ///< the segment that begins at a vertex
};

/// The kind of a chain of segments: their common kind, or free if they differ.
ContourKind joined(ContourKind a, ContourKind b) { return a == b ? a : ContourKind::free; }

}  // namespace

std::vector<Contour> material_contours(const LevelSet<2>& psi, int subdivisions) {
  const PolarGrid<2>& grid = psi.lattice.grid();
  const std::vector<Segment> segments = sector_segments(psi, subdivisions);
  const Successors successors(segments, grid, subdivisions);
  const int n = segments.size(), n_ring = n * grid.n_sectors;

  std::vector<Contour> contours;
  std::vector<bool> used(n_ring, false);
  for (int first = 0; first < n_ring; ++first) {
    if (used[first]) continue;
    Contour contour{segments[first % n].kind, {}};
    for (int s = first; !used[s]; s = successors.after(s)) {
      used[s] = true;
      contour.kind = joined(contour.kind, segments[s % n].kind);
      const int sector = s / n;
      contour.points.push_back(rotated<2>(segments[s % n].start_point, sector * grid.sector_angle()));
    }
    contours.push_back(std::move(contour));
  }
  return contours;
}

double signed_area(const Contour& contour) {
  double twice = 0;
  Vec<2> a = contour.points.back();
  for (const Vec<2>& b : contour.points) {
    twice += a[0] * b[1] - a[1] * b[0];
    a = b;
  }
  return 0.5 * twice;
}

double perimeter(const Contour& contour) {
  double length = 0;
  Vec<2> a = contour.points.back();
  for (const Vec<2>& b : contour.points) {
    length += distance(a, b);
    a = b;
  }
  return length;
}

std::vector<std::vector<MaterialPolygon>> material_polygons(const LevelSet<2>& psi, int subdivisions) {
  const SampledLevelSet samples(psi, subdivisions);
  const PolarGrid<2>& grid = psi.lattice.grid();
  std::vector<std::vector<MaterialPolygon>> result(grid.n_cells());
  for (int cell = 0; cell < grid.n_cells(); ++cell) {
    if (samples.full(cell)) {
      result[cell] = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
      continue;
    }
    const auto c = grid.cell_position(cell);
    for (int j = subdivisions * c[1]; j < subdivisions * (c[1] + 1); ++j) {
      for (int i = subdivisions * c[0]; i < subdivisions * (c[0] + 1); ++i) {
        for (const Polygon& polygon : samples.square_polygons(i, j)) {
          MaterialPolygon piece;
          for (const Vertex& v : polygon) piece.push_back(samples.unit_cell_point(v.position(), cell));
          result[cell].push_back(std::move(piece));
        }
      }
    }
  }
  return result;
}

}  // namespace wheelwright
