#include "wheelwright/report/pressure_csv.h"

#include <numbers>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/csv.h"

namespace wheelwright {

template <int dim>
void write_pressure_csv(const std::filesystem::path& path, std::span<const ContactPoint> points) {
  std::vector<std::string> names{
      "position",      "azimuth [deg]", "x [m]",        dim == 2 ? "weight [m]" : "weight [m^2]",
      "pressure [Pa]", "friction [Pa]", "sigma_n [Pa]", "gap [m]"};
  if constexpr (dim == 3) names.insert(names.end(), {"z [m]", "axial friction [Pa]"});
  std::string content = csv_line(names);
  for (const ContactPoint& p : points) {
    std::vector<std::string> cells{std::to_string(p.position),
                                   csv_number(p.azimuth * 180 / std::numbers::pi),
                                   csv_number(p.x),
                                   csv_number(p.weight),
                                   csv_number(p.pressure),
                                   csv_number(p.friction),
                                   csv_number(p.normal_stress),
                                   csv_number(p.gap)};
    if constexpr (dim == 3) cells.insert(cells.end(), {csv_number(p.z), csv_number(p.axial_friction)});
    content += csv_line(cells);
  }
  write_atomically(path, content);
}

template void write_pressure_csv<2>(const std::filesystem::path&, std::span<const ContactPoint>);
template void write_pressure_csv<3>(const std::filesystem::path&, std::span<const ContactPoint>);

}  // namespace wheelwright
