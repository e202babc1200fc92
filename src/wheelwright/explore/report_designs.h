#pragma once

#include <string>
#include <vector>

#include "wheelwright/explore/design.h"

namespace wheelwright {

// What an exploration or a sweep tells about its designs. The designs are in the order of ranked().

/// A design with its place among all of them.
struct RankedDesign : RatedDesign {
  int front;  ///< in the quantities asked for (explore/pareto.h); 0: no result, or a bound is missed
  std::string
      outline;  ///< the `d` of an SVG path of the wheel, 100 units wide about the origin; may be empty
};

/// Designs in the order of their fronts, and within a front of the first quantity; then those that miss a
/// bound, those without results last.
std::vector<RankedDesign> ranked(const std::vector<RatedDesign>& designs,
                                 const std::vector<RankedQuantity>& quantities);

/// For programs, one row per design: its place, parameters, and its numbers in the units of summary.json.
std::string designs_csv(const std::vector<RankedDesign>& designs);
std::string designs_json(const std::vector<RankedDesign>& designs,
                         const std::vector<RankedQuantity>& quantities);

/// For people: the first rows in the quantities asked for.
std::string designs_table(const std::vector<RankedDesign>& designs,
                          const std::vector<RankedQuantity>& quantities, int most_rows);

/// The designs by the first quantity and by each of the others (by itself, if it is the only one): points,
/// the front as large ones with the wheels of its first designs beside them. An SVG document.
std::string pareto_svg(const std::vector<RankedDesign>& designs,
                       const std::vector<RankedQuantity>& quantities, const std::string& title);

/// One HTML file that needs no network: the points by any two quantities, which link to the reports of the
/// runs, and the table. It stands in the folder of the designs' folder.
std::string designs_page(const std::vector<RankedDesign>& designs,
                         const std::vector<RankedQuantity>& quantities, const std::string& title);

}  // namespace wheelwright
