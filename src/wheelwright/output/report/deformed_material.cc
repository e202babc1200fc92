#include "wheelwright/output/report/deformed_material.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "wheelwright/mechanics/state/axle_height.h"
#include "wheelwright/output/report/solution_fields.h"
#include "wheelwright/shape/geometry/cell_map.h"

namespace wheelwright {
namespace {

constexpr int press_samples = 4;  // per column

std::array<double, 9> shape_values(int degree, const Vec<2>& xi) {
  return ShapeFunctions<2>(degree, xi).value;
}

/// The scalar that is drawn, at a point of a cell with these nodes and values of shape functions.
double scalar_at(const NamedField& field, int row, std::span<const std::size_t> nodes,
                 std::span<const double> shape) {
  if (!field.scalar) return interpolate(field.field, nodes, shape, 0, row);
  if (field.field.components == stress_components<2>)
    return field.scalar(interpolate<stress_components<2>>(field.field, nodes, shape, row));
  std::vector<double> components(field.field.components);
  for (int c = 0; c < field.field.components; ++c)
    components[c] = interpolate(field.field, nodes, shape, c, row);
  return field.scalar(components);
}

Vec<2> interpolated(const RingField& field, const Lattice<2>& lattice, const std::array<int, 2>& cell,
                    const std::array<double, 9>& shape) {
  return interpolate<2>(field, ring_cell_nodes<2>(lattice, cell),
                        std::span(shape.data(), nodes_per_cell<2>(lattice.degree())));
}

/// How far magnified displacements move the tread below the ground, at equally spaced azimuths. `level`: of
/// the ground below the axle of the undeformed wheel.
std::vector<double> press_of_tread(const Lattice<2>& lattice, const RingField& displacement,
                                   double magnification, double contact_azimuth, const Ground& ground) {
  const PolarGrid<2>& grid = lattice.grid();
  const double radius = grid.outer_radius, level = axle_height(grid, ground);
  std::vector<double> press;
  for (int column = 0; column < grid.ring_columns(); ++column)
    for (int k = 0; k < press_samples; ++k) {
      const double xi = double(k) / press_samples;
      const double azimuth = (column + xi) * grid.column_angle() - contact_azimuth;
      const Vec<2> u = interpolated(displacement, lattice, {grid.cells[0] - 1, column},
                                    shape_values(lattice.degree(), {1, xi}));
      const double down = std::cos(contact_azimuth) * u[0] + std::sin(contact_azimuth) * u[1];
      const double along = std::cos(contact_azimuth) * u[1] - std::sin(contact_azimuth) * u[0];
      const double below = ground.is_flat()
                               ? magnification * down - grid.outer_radius * (1 - std::cos(azimuth))
                               : magnification * down + radius * std::cos(azimuth) - level +
                                     ground.height(radius * std::sin(azimuth) + magnification * along);
      press.push_back(below > 0 ? below : 0);  // nothing for NaN
    }
  return press;
}

/// A polygon, divided into parts x parts squares if it is a whole cell.
std::vector<MaterialPolygon> divided(const MaterialPolygon& polygon, int parts) {
  if (polygon != MaterialPolygon{{0, 0}, {1, 0}, {1, 1}, {0, 1}}) return {polygon};
  std::vector<MaterialPolygon> result;
  const auto corner = [&](int i, int j) { return Vec<2>{double(i) / parts, double(j) / parts}; };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j)
      result.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
  return result;
}

}  // namespace

DeformedMaterial::DeformedMaterial(const LevelSet<2>& psi, const Lattice<2>& lattice,
                                   const RingField& displacement, double magnification,
                                   double contact_azimuth, Below below, const Ground& ground)
    : psi_(psi),
      lattice_(lattice),
      displacement_(displacement),
      magnification_(magnification),
      to_picture_(-0.5 * std::numbers::pi - contact_azimuth),
      ground_(ground),
      level_(axle_height(lattice.grid(), ground)),
      press_(below == Below::ground
                 ? press_of_tread(lattice, displacement, magnification, contact_azimuth, ground)
                 : std::vector<double>()) {}

double DeformedMaterial::max_press() const { return press_.empty() ? 0 : std::ranges::max(press_); }

Vec<2> DeformedMaterial::undeformed(const Vec<2>& x) const {
  const Vec<2> turned = to_picture_.forward(x);
  return {turned[0], -turned[1]};
}

double DeformedMaterial::press_at(double azimuth) const {
  const double position = azimuth / (2 * std::numbers::pi) * static_cast<double>(press_.size());
  const double below = std::floor(position);
  const int n = static_cast<int>(press_.size()), first = wrap(static_cast<int>(below), n);
  return std::lerp(press_[first], press_[(first + 1) % n], position - below);
}

Vec<2> DeformedMaterial::moved(const Vec<2>& x, double radius, double azimuth, const Vec<2>& u) const {
  const PolarGrid<2>& grid = lattice_.grid();
  const double share = (radius - grid.inner_radius) / (grid.outer_radius - grid.inner_radius);
  Vec<2> place = undeformed({x[0] + magnification_ * u[0], x[1] + magnification_ * u[1]});
  if (press_.empty()) return place;
  place[1] -= share * press_at(azimuth);
  const double depth = level_ - ground_.height(place[0]);
  return {place[0], place[1] > depth ? depth : place[1]};
}

Vec<2> DeformedMaterial::drawn(const Vec<2>& x) const {
  const PolarGrid<2>& grid = lattice_.grid();
  const double radius = std::hypot(x[0], x[1]), azimuth = std::atan2(x[1], x[0]);
  const double row = grid.line_at(radius), column = azimuth / grid.column_angle();
  const std::array<int, 2> cell{std::clamp(static_cast<int>(row), 0, grid.cells[0] - 1),
                                static_cast<int>(std::floor(column))};
  const Vec<2> xi{std::clamp(row - cell[0], 0.0, 1.0), column - cell[1]};
  return moved(x, radius, azimuth,
               interpolated(displacement_, lattice_, cell, shape_values(lattice_.degree(), xi)));
}

DeformedMaterial::CellPieces DeformedMaterial::cell_pieces(int cell,
                                                           const std::vector<MaterialPolygon>& polygons,
                                                           int parts) const {
  const PolarGrid<2>& grid = lattice_.grid();
  const auto c = grid.cell_position(cell);
  const CellMap<2> map(grid, psi_.lattice.degree(), c);
  const auto position = [&](const Vec<2>& xi) {
    return rotated<2>(map.position(ShapeFunctions<2>(psi_.lattice.degree(), xi)), c[1] * grid.column_angle());
  };
  CellPieces pieces{cell, position({0.5, 0.5}), {}, {}};
  std::map<Vec<2>, int> numbers;
  for (const MaterialPolygon& whole : polygons)
    for (const MaterialPolygon& polygon : divided(whole, parts)) {
      std::vector<int>& corners = pieces.polygons.emplace_back();
      for (const Vec<2>& xi : polygon) {
        const auto [number, is_new] = numbers.try_emplace(xi, pieces.points.size());
        corners.push_back(number->second);
        if (!is_new) continue;
        const Vec<2> x = position(xi);
        pieces.points.push_back(
            {x, std::hypot(x[0], x[1]), std::atan2(x[1], x[0]), shape_values(lattice_.degree(), xi)});
      }
    }
  return pieces;
}

std::vector<DrawnPoint> DeformedMaterial::drawn(const CellPieces& pieces, int sector,
                                                const NamedField& scalar) const {
  const PolarGrid<2>& grid = lattice_.grid();
  auto cell = grid.cell_position(pieces.cell);
  cell[1] += sector * grid.columns();
  const auto nodes = ring_cell_nodes<2>(lattice_, cell);
  const double turn = sector * grid.sector_angle();
  const AxleRotation to_sector(turn);
  std::vector<DrawnPoint> result;
  result.reserve(pieces.points.size());
  for (const CellPoint& point : pieces.points) {
    const std::span shape(point.shape.data(), nodes_per_cell<2>(lattice_.degree()));
    result.push_back({moved(to_sector.forward(point.x), point.radius, point.azimuth + turn,
                            interpolate<2>(displacement_, nodes, shape)),
                      scalar_at(scalar, cell[0], nodes, shape)});
  }
  return result;
}

std::vector<DrawnPiece> DeformedMaterial::pieces(const NamedField& scalar, int parts, const Vec<2>& centre,
                                                 double radius) const {
  const PolarGrid<2>& grid = lattice_.grid();
  const auto polygons = material_polygons(psi_, parts);
  std::vector<CellPieces> of_sector;
  for (int cell = 0; cell < grid.n_cells(); ++cell)
    if (!polygons[cell].empty()) of_sector.push_back(cell_pieces(cell, polygons[cell], parts));
  std::vector<DrawnPiece> result;
  for (int sector = 0; sector < grid.n_sectors; ++sector) {
    const AxleRotation to_sector(sector * grid.sector_angle());
    for (const CellPieces& cell : of_sector) {
      const Vec<2> middle = undeformed(to_sector.forward(cell.middle));
      if (std::hypot(middle[0] - centre[0], middle[1] - centre[1]) >= radius) continue;
      const std::vector<DrawnPoint> points = drawn(cell, sector, scalar);
      for (const auto& polygon : cell.polygons) {
        DrawnPiece& piece = result.emplace_back();
        for (const int corner : polygon) piece.push_back(points[corner]);
      }
    }
  }
  return result;
}

}  // namespace wheelwright
