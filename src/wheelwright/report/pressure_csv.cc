#include "wheelwright/report/pressure_csv.h"

#include <numbers>

#include "wheelwright/files/atomic_file.h"
#include "wheelwright/files/csv.h"

namespace wheelwright {

void write_pressure_csv(const std::filesystem::path& path, std::span<const ContactPoint> points) {
  std::string content = csv_line({"position", "azimuth [deg]", "x [m]", "weight [m]", "pressure [Pa]",
                                  "friction [Pa]", "sigma_n [Pa]", "gap [m]"});
  for (const ContactPoint& p : points)
    content += csv_line({std::to_string(p.position), csv_number(p.azimuth * 180 / std::numbers::pi),
                         csv_number(p.x), csv_number(p.weight), csv_number(p.pressure),
                         csv_number(p.friction), csv_number(p.normal_stress), csv_number(p.gap)});
  write_atomically(path, content);
}

}  // namespace wheelwright
