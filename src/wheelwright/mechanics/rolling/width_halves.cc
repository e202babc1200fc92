#include "wheelwright/mechanics/rolling/width_halves.h"

#include <algorithm>

#include "wheelwright/shape/geometry/mirror.h"

namespace wheelwright {
namespace {

/// Observations of a column in one radial row of cells that follow each other cell by cell along the axle. In
/// a cell they stand face by face along the ground, on every face line by line along the axle.
struct Slabs {
  int first;           ///< vector, in the half tread
  int faces;           ///< along the ground
  int lines;           ///< along the axle
  int line_size;       ///< vectors
  int first_face_row;  ///< the face rows of its first cell along the axle, in TreadSurface::face_rows
  int n_face_rows;

  int size() const { return faces * lines * line_size; }
  /// The place of a vector's image in the image of its cell.
  int image(int v) const { return v + (lines - 1 - 2 * (v / line_size % lines)) * line_size; }
};

/// The slabs in the order of their observations, and the radial rows of cells: how many face rows each has.
struct Layout {
  std::vector<Slabs> slabs;
  std::vector<std::vector<int>> slabs_of_row;
};

/// `axial_cells`: of the half.
Layout layout_of(const TreadSurface<3>& half, int axial_cells) {
  const int contact = 2 * static_cast<int>(half.points.size());
  Layout layout{{{}}, {}};
  for (int next = 0; next < static_cast<int>(half.face_rows.size());) {
    layout.slabs_of_row.emplace_back();
    const auto add = [&](bool of_contact) {
      const FaceRow& row = half.face_rows[next];
      const int in_direction = row.points_per_face;
      Slabs slabs{.first = of_contact ? 0 : row.first,
                  .faces = row.faces,
                  .lines = of_contact ? row.per_face / (2 * in_direction) : in_direction,
                  .line_size = of_contact ? 2 * in_direction : power(in_direction, 2),
                  .first_face_row = next,
                  .n_face_rows = of_contact ? row.per_face / in_direction : power(in_direction, 2)};
      layout.slabs_of_row.back().push_back(of_contact ? 0 : static_cast<int>(layout.slabs.size()));
      next += slabs.n_face_rows;
      if (of_contact)
        layout.slabs.front() = slabs;
      else
        layout.slabs.push_back(slabs);
    };
    const int first = next;
    if (half.face_rows[next].first >= contact) add(false);
    if (next < static_cast<int>(half.face_rows.size()) && half.face_rows[next].first < contact) add(true);
    next = first + axial_cells * (next - first);
  }
  return layout;
}

Vec<3> across_middle(Vec<3> v) {
  v[2] = -v[2];
  return v;
}

}  // namespace

RollingModel<3> first_half(RollingModel<3> model) {
  model.grid = first_half(model.grid);
  model.side_faces = half_of(model.side_faces);
  model.load /= 2;
  model.horizontal_force /= 2;
  model.torque /= 2;
  return model;
}

LevelSet<3> first_half(const LevelSet<3>& whole) {
  LevelSet<3> half{Lattice<3>(first_half(whole.lattice.grid()), whole.lattice.degree()), {}};
  for (int node = 0; node < half.lattice.n_nodes(); ++node)
    half.values.push_back(whole.values[whole.lattice.node_index(half.lattice.node_position(node))]);
  return half;
}

WidthHalves::WidthHalves(const PolarGrid<3>& whole, const TreadSurface<3>& half)
    : whole_(whole), half_rows_(half.rows().size()), surface_(half) {
  const int n = whole.cells[2] / 2, contact = 2 * static_cast<int>(half.points.size());
  const Layout layout = layout_of(half, n);
  surface_.face_rows.clear();
  surface_.mirror_images.clear();
  for (const Slabs& slabs : layout.slabs)
    for (int axial = 0; axial < 2 * n; ++axial) {
      const bool is_image = axial >= n;
      const int from = slabs.first + (is_image ? 2 * n - 1 - axial : axial) * slabs.size();
      const int first = static_cast<int>(observed_.size());
      for (int v = 0; v < slabs.size(); ++v) {
        observed_.push_back({from + (is_image ? slabs.image(v) : v), is_image});
        surface_.mirror_images.push_back(first + half.mirror_images[slabs.first + v] - slabs.first);
      }
    }
  surface_.mirror_images.push_back(static_cast<int>(observed_.size()));
  for (const auto& of_row : layout.slabs_of_row)
    for (int axial = 0; axial < 2 * n; ++axial)
      for (const int s : of_row) {
        const Slabs& slabs = layout.slabs[s];
        for (int k = 0; k < slabs.n_face_rows; ++k) {
          FaceRow row = half.face_rows[slabs.first_face_row + k];
          row.first += slabs.first + axial * slabs.size();  // all slabs before it are twice as long
          surface_.face_rows.push_back(row);
        }
      }
  surface_.points.clear();
  surface_.annulus_weights.clear();
  for (size_t v = 0; v < observed_.size(); ++v) {
    const auto [vector, is_image] = observed_[v];
    if (vector >= contact) {
      surface_.annulus_weights.push_back(half.annulus_weights[vector - contact]);
    } else if (v % 2 == 0) {
      surface_.points.push_back(half.points[vector / 2]);
      double& z = surface_.points.back().position[2];
      if (is_image) z = whole.width - z;
    }
  }
}

Matrix WidthHalves::observations(const Matrix& of_half) const {
  const ObservationRows<3> rows = surface_.rows();
  auto result = Matrix::unfilled(rows.size(), of_half.columns());
  const int integral = half_rows_ - (rows.has_spin ? 1 : 0) - 3;
  for (int j = 0; j < result.columns(); ++j) {
    const double* from = of_half.column(j);
    double* to = result.column(j);
    for (const auto& [vector, is_image] : observed_) {
      std::copy_n(from + 3 * vector, 3, to);
      if (is_image) to[2] = -to[2];
      to += 3;
    }
    for (int d = 0; d < 3; ++d) *to++ = d == 2 ? 0 : 2 * from[integral + d];
    if (rows.has_spin) *to = 2 * from[integral + 3];
  }
  return result;
}

Matrix WidthHalves::loads(const Matrix& on_whole) const {
  if (on_whole.columns() == 0) return {};
  const bool has_spin = surface_.has_spin;
  const int integral = half_rows_ - (has_spin ? 1 : 0) - 3;
  Matrix result(half_rows_, on_whole.columns());
  for (int j = 0; j < result.columns(); ++j) {
    const double* from = on_whole.column(j);
    double* to = result.column(j);
    for (const auto& [vector, is_image] : observed_) {
      for (int d = 0; d < 3; ++d) to[3 * vector + d] += (is_image && d == 2 ? -0.5 : 0.5) * from[d];
      from += 3;
    }
    for (int d = 0; d < 2; ++d) to[integral + d] = from[d];
    if (has_spin) to[integral + 3] = from[3];
  }
  return result;
}

ContactPatch<3> WidthHalves::patch(const ContactPatch<3>& of_half) const {
  const int n_points = static_cast<int>(surface_.points.size()), n_half = n_points / 2;
  ContactPatch<3> patch{.points = {},
                        .rim = of_half.rim,
                        .rim_force = scaled(2, of_half.rim_force),
                        .newton_iterations = of_half.newton_iterations,
                        .growth = of_half.growth};
  if (of_half.stiffness) patch.stiffness = 2 * *of_half.stiffness;
  patch.rim_force.along_axle = 0;
  for (size_t first = 0; first < of_half.points.size(); first += n_half)
    for (int q = 0; q < n_points; ++q) {
      const auto [there, is_image] = point(q);
      auto at = of_half.points[first + there];
      at.point = q;
      at.position[2] -= 0.25 * whole_.width;  // the half's middle
      if (is_image) {
        at.position = across_middle(at.position);
        at.augmented = across_middle(at.augmented);
        at.traction = across_middle(at.traction);
      }
      patch.points.push_back(at);
    }
  return patch;
}

std::vector<Vec<3>> WidthHalves::tractions(const std::vector<Vec<3>>& on_whole) const {
  const int n_points = static_cast<int>(surface_.points.size());
  std::vector<Vec<3>> result(on_whole.size() / 2, Vec<3>{});
  for (size_t k = 0; k < on_whole.size(); ++k) {
    const auto [there, is_image] = point(static_cast<int>(k) % n_points);
    Vec<3>& to = result[k / n_points * (n_points / 2) + there];
    for (int d = 0; d < 3; ++d) to[d] += (is_image && d == 2 ? -0.5 : 0.5) * on_whole[k][d];
  }
  return result;
}

FunctionalDerivative<3> WidthHalves::derivative_of_half(const FunctionalDerivative<3>& whole) const {
  FunctionalDerivative<3> half{.energy = whole.energy,
                               .energy_by_harmonic = whole.energy_by_harmonic,
                               .tread_loads = loads(whole.tread_loads),
                               .integrals = whole.integrals,
                               .rim = {},
                               .tractions = {}};
  for (const RimForce& force : whole.rim) {
    half.rim.push_back(scaled(0.5, force));
    half.rim.back().along_axle = 0;
  }
  for (const double factor : whole.growth) half.growth.push_back(0.5 * factor);
  for (const auto& of_position : whole.tractions) half.tractions.push_back(tractions(of_position));
  return half;
}

WidthHalves::Place WidthHalves::place(int cell) const {
  auto p = whole_.cell_position(cell);
  const bool is_image = p[2] >= whole_.cells[2] / 2;
  if (is_image) p[2] = whole_.cells[2] - 1 - p[2];
  return {first_half(whole_).cell_index(p), is_image};
}

std::vector<SurfacePoint<3>> WidthHalves::boundary(const std::vector<SurfacePoint<3>>& of_half) const {
  const PolarGrid<3> half = first_half(whole_);
  std::vector<SurfacePoint<3>> points = of_half;
  for (auto& point : points) point.cell = whole_.cell_index(half.cell_position(point.cell));
  for (size_t k = 0; k < of_half.size(); ++k) {
    SurfacePoint<3> image = points[k];
    image.cell = mirror_image(whole_, image.cell, MirrorPlane::width);
    image.xi[2] = 1 - image.xi[2];
    image.normal = across_middle(image.normal);
    points.push_back(image);
  }
  return points;
}

RingField WidthHalves::at_nodes(const RingField& of_half, int degree) const {
  const Lattice<3> whole(whole_, degree), half(first_half(whole_), degree);
  const int last = half.nodes()[2] - 1;
  RingField result{3, std::vector<double>(3 * size_t(whole.n_nodes()) * whole_.n_sectors)};
  for (int sector = 0; sector < whole_.n_sectors; ++sector)
    for (int node = 0; node < whole.n_nodes(); ++node) {
      auto p = whole.node_position(node);
      const bool is_image = p[2] > last;
      if (is_image) p[2] = 2 * last - p[2];
      const double* from = &of_half.values[3 * (half.node_index(p) + size_t(half.n_nodes()) * sector)];
      double* to = &result.values[3 * (node + size_t(whole.n_nodes()) * sector)];
      std::copy_n(from, 3, to);
      if (is_image) to[2] = -to[2];
    }
  return result;
}

}  // namespace wheelwright
