#include "wheelwright/output/report/wheel_pictures.h"

#include <algorithm>

#include "wheelwright/base/units.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/output/report/deformed_svg.h"
#include "wheelwright/output/report/lit_wheel.h"
#include "wheelwright/output/report/mesh_svg.h"
#include "wheelwright/output/report/pressure_map.h"
#include "wheelwright/output/report/shape_boundary.h"

namespace wheelwright {
namespace {

constexpr double window_in_thicknesses = 0.75;  // half the view of the contact over the ring's thickness

/// The stress on the whole wheel.
template <int dim>
DeformedPicture<dim> stress_picture(const PictureNames& names, const PositionFields<dim>& fields) {
  NamedField stress = von_mises_field(fields.stress);
  stress.name = "von Mises stress";
  return {.title = names.title,
          .displacement = fields.displacement,
          .magnification = fields.is_large ? 1
                                           : picture_magnification(fields.displacement,
                                                                   fields.lattice.grid().outer_radius),
          .contact_azimuth = fields.ground_azimuth,
          .most_stressed_of = names.n_positions,
          .is_bonded = fields.is_bonded,
          .ground = fields.ground,
          .camber = fields.camber,
          .window = {},
          .scalar = std::move(stress),
          .scale = ScaleKind::without_tail,
          .rim = fields.rim,
          .travel = fields.travel,
          .rim_force = dim == 2 ? scaled(names.width, fields.rim_force) : fields.rim_force,
          .contact = fields.contact,
          .peak = fields.von_mises,
          .layers = fields.layers,
          .shown = names.shown};
}

/// The same with the displacement towards the ground instead.
template <int dim>
DeformedPicture<dim> with_displacement(DeformedPicture<dim> picture) {
  picture.scalar = {"displacement down", unit<dim>(UnitKind::length),
                    vertical_field<dim>(picture.displacement, picture.contact_azimuth)};
  picture.scale = ScaleKind::all;
  picture.peak = {};
  return picture;
}

/// The same with the fatigue utilization of a turn instead.
template <int dim>
DeformedPicture<dim> with_fatigue(DeformedPicture<dim> picture, NamedField utilization,
                                  std::optional<DrawnPeak<dim>> peak) {
  for (auto* values : {&utilization.field.values, &utilization.field.odd_values})
    for (double& value : *values) value *= 100;
  std::ranges::replace(utilization.name, '_', ' ');
  picture.scalar = {std::move(utilization.name), "%", std::move(utilization.field)};
  if (peak) peak->value *= 100;
  picture.peak = peak;
  picture.is_peak_projected = true;
  return picture;
}

/// The same with the temperature of the rolling wheel instead.
template <int dim>
DeformedPicture<dim> with_temperature(DeformedPicture<dim> picture, const RingField& temperature,
                                      const std::optional<DrawnPeak<dim>>& peak) {
  picture.scalar = {"temperature", unit<dim>(UnitKind::temperature), temperature};
  picture.scale = ScaleKind::all;
  picture.peak = peak;
  picture.is_peak_projected = true;
  return picture;
}

}  // namespace

void write_wheel_pictures(const std::filesystem::path& folder, const PictureNames& names,
                          const LevelSet<2>& shape, const CutDomain<2>& domain,
                          const PositionFields<2>& fields, const TurnPeaks<2>& peaks) {
  const PolarGrid<2>& grid = shape.lattice.grid();
  const auto write = [&](const char* file, const DeformedPicture<2>& picture) {
    write_atomically(folder / (names.prefix + file), deformed_svg(shape, fields.lattice, picture));
  };
  const auto stress = stress_picture(names, fields);
  auto contact = stress;
  contact.magnification = 1;
  contact.window = window_in_thicknesses * (grid.outer_radius - grid.inner_radius);
  write("stress.svg", stress);
  write("stress_contact.svg", contact);
  write("displacement.svg", with_displacement(stress));
  if (fields.fatigue) write("fatigue.svg", with_fatigue(stress, *fields.fatigue, peaks.fatigue));
  if (fields.temperature)
    write("temperature.svg", with_temperature(stress, *fields.temperature, peaks.temperature));
  write_atomically(folder / (names.prefix + "mesh.svg"), mesh_svg(shape, domain, names.title, fields.layers));
}

void write_wheel_pictures(const std::filesystem::path& folder, const PictureNames& names,
                          const LevelSet<3>& shape, const CutDomain<3>&, const PositionFields<3>& fields,
                          const TurnPeaks<3>& peaks) {
  const SurfaceMesh surface = shape_boundary(shape, fields.lattice.degree());
  const auto write = [&](const char* file, const DeformedPicture<3>& picture) {
    write_atomically(folder / (names.prefix + file), deformed_svg(surface, fields.lattice, picture));
  };
  const auto stress = stress_picture(names, fields);
  write("stress.svg", stress);
  write("displacement.svg", with_displacement(stress));
  if (fields.fatigue) write("fatigue.svg", with_fatigue(stress, *fields.fatigue, peaks.fatigue));
  if (fields.temperature)
    write("temperature.svg", with_temperature(stress, *fields.temperature, peaks.temperature));
  write_atomically(folder / (names.prefix + "pressure.svg"),
                   pressure_map_svg(names.title, shape.lattice.grid(), fields.contact));
}

}  // namespace wheelwright
