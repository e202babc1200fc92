#include "wheelwright/report/wheel_pictures.h"

#include <algorithm>

#include "wheelwright/base/units.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/report/deformed_svg.h"
#include "wheelwright/report/mesh_svg.h"

namespace wheelwright {
namespace {

constexpr double magnification = 20;
constexpr double window_in_thicknesses = 0.75;  // half the view of the contact over the ring's thickness
constexpr double stress_outliers = 0.01;        // at slivers and corners

}  // namespace

int worst_position(std::span<const double> strain_energy) {
  return static_cast<int>(std::ranges::max_element(strain_energy) - strain_energy.begin());
}

void write_wheel_pictures(const std::filesystem::path& folder, const PictureNames& names,
                          const LevelSet<2>& shape, const CutDomain<2>& domain,
                          const PositionFields& fields) {
  const PolarGrid<2>& grid = shape.lattice.grid();
  const NamedField stress{"von Mises stress", unit<2>(UnitKind::stress), fields.von_mises};
  const NamedField vertical{"displacement down", unit<2>(UnitKind::length),
                            vertical_field(fields.displacement, fields.ground_azimuth)};
  const auto draw = [&](const char* file, std::optional<double> window, const NamedField& scalar,
                        double outliers) {
    write_atomically(folder / (names.prefix + file), deformed_svg(shape, fields.lattice,
                                                                  {.title = names.title,
                                                                   .displacement = fields.displacement,
                                                                   .magnification = magnification,
                                                                   .contact_azimuth = fields.ground_azimuth,
                                                                   .window = window,
                                                                   .scalar = scalar,
                                                                   .outliers = outliers}));
  };
  draw("stress.svg", {}, stress, stress_outliers);
  draw("stress_contact.svg", window_in_thicknesses * (grid.outer_radius - grid.inner_radius), stress,
       stress_outliers);
  draw("displacement.svg", {}, vertical, 0);
  write_atomically(folder / (names.prefix + "mesh.svg"), mesh_svg(shape, domain, names.title));
}

}  // namespace wheelwright
