#include "wheelwright/output/report/layered_surface.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace wheelwright {
namespace {

/// The lines of the grid on which layers meet.
class LayerLines {
 public:
  LayerLines(const PolarGrid<3>& grid, const std::vector<double>& radii) {
    for (const double radius : radii) lines_.push_back(grid.nearest_line(radius).line);
  }

  /// Whether a place lies on one of them; places of a surface are on lines exactly.
  bool has(const CellPoint& place) const {
    return std::ranges::any_of(lines_, [&](int line) { return height(place) == line; });
  }

  /// The layer of a triangle with these corners, counted from the rim: none crosses a line.
  int layer_of(const CellPoint& a, const CellPoint& b, const CellPoint& c) const {
    const double middle = (height(a) + height(b) + height(c)) / 3;
    return static_cast<int>(std::ranges::count_if(lines_, [&](int line) { return line < middle; }));
  }

  /// The same place, in the row of cells inside or outside of its line.
  static CellPoint beside(CellPoint place, bool outside) {
    const int line = static_cast<int>(std::lround(height(place)));
    place.cell[0] = outside ? line : line - 1;
    place.xi[0] = outside ? 0 : 1;
    return place;
  }

  /// The number of lines inside of a place on one of them.
  int index_of(const CellPoint& place) const {
    return static_cast<int>(std::ranges::count_if(lines_, [&](int line) { return line < height(place); }));
  }

 private:
  /// In rows of cells.
  static double height(const CellPoint& place) { return place.cell[0] + place.xi[0]; }

  std::vector<int> lines_;
};

/// The surface with its vertices on lines once for each layer there.
SurfaceMesh separated(const SurfaceMesh& mesh, const LayerLines& lines) {
  const int n = mesh.sector_points();
  SurfaceMesh result{
      .n_sectors = mesh.n_sectors, .places = {}, .points = {}, .triangles = {}, .parts = mesh.parts};
  std::map<std::array<int, 2>, int> known;  // a vertex of sector 0 and its layer, with the new number
  std::vector<int> sources;
  const auto vertex = [&](int old, int layer) {
    const CellPoint& place = mesh.places[old];
    const bool is_shared = lines.has(place);
    const auto [entry, is_new] =
        known.try_emplace({old, is_shared ? layer : 0}, static_cast<int>(sources.size()));
    if (is_new) {
      sources.push_back(old);
      result.places.push_back(is_shared ? LayerLines::beside(place, layer > lines.index_of(place)) : place);
    }
    return entry->second;
  };
  std::vector<std::array<int, 3>> triangles, sectors;  // of sector 0: its corners, and their sectors
  for (std::size_t t = 0; t < mesh.triangles.size() / mesh.n_sectors; ++t) {
    const auto& old = mesh.triangles[t];
    const int layer =
        lines.layer_of(mesh.places[old[0] % n], mesh.places[old[1] % n], mesh.places[old[2] % n]);
    triangles.push_back({vertex(old[0] % n, layer), vertex(old[1] % n, layer), vertex(old[2] % n, layer)});
    sectors.push_back({old[0] / n, old[1] / n, old[2] / n});
  }
  for (int sector = 0; sector < mesh.n_sectors; ++sector) {
    for (const int source : sources) result.points.push_back(mesh.points[source + n * sector]);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      auto& triangle = result.triangles.emplace_back();
      for (int k = 0; k < 3; ++k)
        triangle[k] =
            triangles[t][k] + static_cast<int>(sources.size()) * ((sectors[t][k] + sector) % mesh.n_sectors);
    }
  }
  return result;
}

}  // namespace

LayeredSurface layered_surface(SurfaceMesh mesh, const PolarGrid<3>& grid, const std::vector<double>& radii) {
  if (radii.empty()) return {std::move(mesh), {}};
  const LayerLines lines(grid, radii);
  LayeredSurface result{separated(mesh, lines), {}};
  const int n = result.sector_points();
  const auto is_end = [&](int vertex) {
    const CellPoint& place = result.places[vertex % n];
    return lines.has(place) && place.xi[0] == 1;
  };
  for (const auto& triangle : result.triangles)
    for (int k = 0; k < 3; ++k)
      if (const int a = triangle[k], b = triangle[(k + 1) % 3]; is_end(a) && is_end(b))
        result.layer_edges.push_back({a, b});
  return result;
}

}  // namespace wheelwright
