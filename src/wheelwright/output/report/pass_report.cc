#include "wheelwright/output/report/pass_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheelwright/files/csv.h"

namespace wheelwright {
namespace {

constexpr double mm = 1e3, megapascals = 1e-6;

struct Range {
  double mean = 0, least = 0, largest = 0;
};

/// Over the positions.
template <class Value>
Range range_of(const std::vector<ContactSummary>& positions, Value value) {
  Range range{0, value(positions.front()), value(positions.front())};
  for (const ContactSummary& position : positions) {
    range.mean += value(position) / static_cast<double>(positions.size());
    range.least = std::min(range.least, value(position));
    range.largest = std::max(range.largest, value(position));
  }
  return range;
}

std::string place_line(const PassPlace& place, double forces) {
  const std::vector<ContactSummary>& positions = *place.positions;
  const auto force = [&](double ContactSummary::*member) {
    return range_of(positions, [&](const ContactSummary& p) { return forces * p.*member; });
  };
  const Range rise = range_of(positions, [&](const ContactSummary& p) { return place.rise - p.descent; });
  const Range along = force(&ContactSummary::friction_force);
  const Range peak = range_of(positions, [](const ContactSummary& p) { return p.peak_pressure; });
  return fmt::format("{:>12.4g} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g}\n",
                     mm * place.shift, mm * rise.mean, force(&ContactSummary::radial_force).mean, along.mean,
                     along.least, along.largest, megapascals * peak.largest);
}

}  // namespace

std::string pass_table(const std::vector<PassPlace>& pass, double forces) {
  constexpr const char* words = "{:>12} {:>12} {:>12} {:>12} {:>12} {:>12} {:>12}\n";
  std::string table = fmt::format(words, "ground", "axle", "force up", "along", "least", "largest", "peak");
  table += fmt::format(words, "moved [mm]", "raised [mm]", "[N]", "[N]", "[N]", "[N]", "[MPa]");
  for (const PassPlace& place : pass)
    table += place.positions
                 ? place_line(place, forces)
                 : fmt::format("{:>12.4g} {}\n", mm * place.shift, to_string(place.positions.failure()));
  return table;
}

std::string pass_csv(const std::vector<PassPlace>& pass, double forces) {
  std::string csv = csv_line({"moved_m", "position", "axle_raised_m", "travel_m", "force_up_N",
                              "force_along_N", "peak_pressure_Pa"});
  for (const PassPlace& place : pass) {
    if (!place.positions) continue;
    int i = 0;
    for (const ContactSummary& p : *place.positions)
      csv += csv_line({csv_number(place.shift), fmt::format("{}", i++), csv_number(place.rise - p.descent),
                       csv_number(p.travel), csv_number(forces * p.radial_force),
                       csv_number(forces * p.friction_force), csv_number(p.peak_pressure)});
  }
  return csv;
}

}  // namespace wheelwright
