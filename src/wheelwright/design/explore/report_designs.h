#pragma once

#include <string>
#include <vector>

#include "wheelwright/design/explore/design.h"

namespace wheelwright {

// Reports of an exploration or a sweep. The designs are in the order of ranked().

/// A design with its place among all of them.
struct RankedDesign : RatedDesign {
  int front;  ///< in the requested quantities (design/explore/pareto.h); 0: no result, or a bound is violated
  std::string
      outline;  ///< the `d` of an SVG path of the wheel, 100 units wide about the origin; may be empty
};

/// Designs in the order of their fronts, and within a front of the first quantity; then those that violate a
/// bound; those without results come last.
std::vector<RankedDesign> ranked(const std::vector<RatedDesign>& designs,
                                 const std::vector<RankedQuantity>& quantities);

/// For programs, one row per design: its place, parameters, and its numbers in the units of summary.json.
std::string designs_csv(const std::vector<RankedDesign>& designs);
std::string designs_json(const std::vector<RankedDesign>& designs,
                         const std::vector<RankedQuantity>& quantities);

/// For display: the first rows, with the requested quantities.
std::string designs_table(const std::vector<RankedDesign>& designs,
                          const std::vector<RankedQuantity>& quantities, int max_rows);

/// Plots of the designs by the first quantity and each of the others (by itself, if it is the only one):
/// points, large on the front, next to the wheels of its first designs. An SVG document.
std::string pareto_svg(const std::vector<RankedDesign>& designs,
                       const std::vector<RankedQuantity>& quantities, const std::string& title);

/// One HTML file that needs no network: the points by any two quantities, which link to the reports of the
/// runs, and the table. It belongs in the parent of the designs' folder.
std::string designs_page(const std::vector<RankedDesign>& designs,
                         const std::vector<RankedQuantity>& quantities, const std::string& title);

}  // namespace wheelwright
