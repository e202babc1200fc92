#include "wheelwright/shape/geometry/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "wheelwright/shape/geometry/cell_map.h"
#include "wheelwright/shape/geometry/marching_squares.h"

namespace wheelwright {
namespace {

SquareSamples samples_of(const LevelSet<2>& psi, int subdivisions) {
  const PolarGrid<2>& grid = psi.lattice.grid();
  std::vector<std::vector<double>> nodal;
  for (int cell = 0; cell < grid.n_cells(); ++cell) nodal.push_back(psi.cell_values(cell));
  return {grid.cells, psi.lattice.degree(), std::move(nodal), subdivisions};
}

/// An edge of the boundary of the material in one sector, with the material on the left.
struct Segment {
  SquareVertex start, end;
  ContourKind kind;
  Vec<2> start_point;  ///< Cartesian position in the first sector
};

/// Whether the side from a to b of a polygon lies on the boundary of the material; sets the kind of boundary.
bool bounds_material(const SquareVertex& a, const SquareVertex& b, int rows, ContourKind& kind) {
  if (a.has_row(0) && b.has_row(0)) {
    kind = ContourKind::rim;
    return true;
  }
  if (a.has_row(rows) && b.has_row(rows)) {
    kind = ContourKind::tread;
    return true;
  }
  kind = ContourKind::free;
  return a.site != SquareSite::sample && b.site != SquareSite::sample;
}

std::vector<Segment> sector_segments(const LevelSet<2>& psi, int subdivisions) {
  const SquareSamples samples = samples_of(psi, subdivisions);
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
      for (const SquarePolygon& polygon : samples.square_polygons(i, j)) {
        for (std::size_t k = 0; k < polygon.size(); ++k) {
          const SquareVertex &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
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
    const SquareVertex& end = segments_[ring_segment % n()].end;
    const int next = from_.at(number(end));
    const int sector = ring_segment / n() + sectors_on(end) - sectors_on(segments_[next].start);
    return next + n() * ((sector + n_sectors_) % n_sectors_);
  }

 private:
  int n() const { return static_cast<int>(segments_.size()); }

  /// A vertex has the same number in all squares that share it, and in all sectors.
  std::int64_t number(const SquareVertex& v) const {
    return 3 * (std::int64_t(v.j % columns_) * samples_per_line_ + v.i) + static_cast<int>(v.site);
  }
  int sectors_on(const SquareVertex& v) const { return v.j / columns_; }

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
  const SquareSamples samples = samples_of(psi, subdivisions);
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
        for (const SquarePolygon& polygon : samples.square_polygons(i, j)) {
          MaterialPolygon piece;
          for (const SquareVertex& v : polygon) piece.push_back(samples.unit_cell_point(v.position(), cell));
          result[cell].push_back(std::move(piece));
        }
      }
    }
  }
  return result;
}

}  // namespace wheelwright
