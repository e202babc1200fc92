#include "wheelwright/report/wheel_pictures.h"

#include <algorithm>

#include "wheelwright/base/units.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/report/deformed_svg.h"
#include "wheelwright/report/lit_wheel.h"
#include "wheelwright/report/mesh_svg.h"
#include "wheelwright/report/pressure_map.h"
#include "wheelwright/report/shape_boundary.h"

namespace wheelwright {
namespace {

constexpr double window_in_thicknesses = 0.75;  // half the view of the contact over the ring's thickness

}  // namespace

int worst_position(std::span<const double> strain_energy) {
  return static_cast<int>(std::ranges::max_element(strain_energy) - strain_energy.begin());
}

void write_wheel_pictures(const std::filesystem::path& folder, const PictureNames& names,
                          const LevelSet<2>& shape, const CutDomain<2>& domain,
                          const PositionFields<2>& fields) {
  const PolarGrid<2>& grid = shape.lattice.grid();
  NamedField stress = von_mises_field(fields.stress);
  stress.name = "von Mises stress";
  const NamedField vertical{"displacement down", unit<2>(UnitKind::length),
                            vertical_field<2>(fields.displacement, fields.ground_azimuth)};
  const double magnification = picture_magnification(fields.displacement, grid.outer_radius);
  const auto draw = [&](const char* file, double factor, std::optional<double> window,
                        const NamedField& scalar, ScaleKind scale, std::optional<DrawnPeak<2>> peak) {
    write_atomically(folder / (names.prefix + file),
                     deformed_svg(shape, fields.lattice,
                                  {.title = names.title,
                                   .displacement = fields.displacement,
                                   .magnification = factor,
                                   .contact_azimuth = fields.ground_azimuth,
                                   .is_bonded = fields.is_bonded,
                                   .window = window,
                                   .scalar = scalar,
                                   .scale = scale,
                                   .rim = fields.rim,
                                   .travel = fields.travel,
                                   .rim_force = scaled(names.width, fields.rim_force),
                                   .contact = fields.contact,
                                   .peak = peak}));
  };
  draw("stress.svg", magnification, {}, stress, ScaleKind::without_tail, fields.von_mises);
  draw("stress_contact.svg", 1, window_in_thicknesses * (grid.outer_radius - grid.inner_radius), stress,
       ScaleKind::without_tail, fields.von_mises);
  draw("displacement.svg", magnification, {}, vertical, ScaleKind::all, {});
  write_atomically(folder / (names.prefix + "mesh.svg"), mesh_svg(shape, domain, names.title));
}

void write_wheel_pictures(const std::filesystem::path& folder, const PictureNames& names,
                          const LevelSet<3>& shape, const CutDomain<3>&, const PositionFields<3>& fields) {
  const PolarGrid<3>& grid = shape.lattice.grid();
  NamedField stress = von_mises_field(fields.stress);
  stress.name = "von Mises stress";
  const NamedField vertical{"displacement down", unit<3>(UnitKind::length),
                            vertical_field<3>(fields.displacement, fields.ground_azimuth)};
  const double magnification = picture_magnification(fields.displacement, grid.outer_radius);
  const SurfaceMesh surface = shape_boundary(shape, fields.lattice.degree());
  const auto draw = [&](const char* file, const NamedField& scalar, ScaleKind scale,
                        std::optional<DrawnPeak<3>> peak) {
    write_atomically(folder / (names.prefix + file), deformed_svg(surface, fields.lattice,
                                                                  {.title = names.title,
                                                                   .displacement = fields.displacement,
                                                                   .magnification = magnification,
                                                                   .contact_azimuth = fields.ground_azimuth,
                                                                   .is_bonded = fields.is_bonded,
                                                                   .window = {},
                                                                   .scalar = scalar,
                                                                   .scale = scale,
                                                                   .rim = fields.rim,
                                                                   .travel = fields.travel,
                                                                   .rim_force = fields.rim_force,
                                                                   .contact = fields.contact,
                                                                   .peak = peak}));
  };
  draw("stress.svg", stress, ScaleKind::without_tail, fields.von_mises);
  draw("displacement.svg", vertical, ScaleKind::all, {});
  write_atomically(folder / (names.prefix + "pressure.svg"),
                   pressure_map_svg(names.title, grid, fields.contact));
}

}  // namespace wheelwright
