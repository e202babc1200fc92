#include "wheelwright/output/report/pressure_csv.h"

#include <numbers>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/csv.h"

namespace wheelwright {

namespace {

/// The additional columns in 3D.
template <int dim>
std::vector<std::string> with_axle(std::vector<std::string> cells, const std::string& z,
                                   const std::string& friction) {
  if (dim == 3) cells.insert(cells.end(), {z, friction});
  return cells;
}

}  // namespace

template <int dim>
void write_pressure_csv(const std::filesystem::path& path, std::span<const ContactPoint> points) {
  constexpr const char* weight = dim == 2 ? "weight [m]" : "weight [m^2]";
  std::string content = csv_line(with_axle<dim>({"position", "azimuth [deg]", "x [m]", weight,
                                                 "pressure [Pa]", "friction [Pa]", "sigma_n [Pa]", "gap [m]"},
                                                "z [m]", "axial friction [Pa]"));
  for (const ContactPoint& p : points)
    content +=
        csv_line(with_axle<dim>({std::to_string(p.position), csv_number(p.azimuth * 180 / std::numbers::pi),
                                 csv_number(p.x), csv_number(p.weight), csv_number(p.pressure),
                                 csv_number(p.friction), csv_number(p.normal_stress), csv_number(p.gap)},
                                csv_number(p.z), csv_number(p.axial_friction)));
  write_atomically(path, content);
}

template decltype(write_pressure_csv<2>) write_pressure_csv<2>;
template decltype(write_pressure_csv<3>) write_pressure_csv<3>;

}  // namespace wheelwright
