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
  std::string layers = {};  ///< the same of the circles between layers of materials
};

/// Designs that differ by less than their errors in a quantity, by their names.
struct UndecidedDesigns {
  std::string quantity;  ///< its word
  std::vector<std::string> designs;
};

/// Finds among the designs with numbers on a finer grid those whose lead over the next one is smaller than
/// the errors.
std::vector<UndecidedDesigns> undecided_designs(const std::vector<RankedDesign>& designs,
                                                const std::vector<RankedQuantity>& quantities);

/// One readable line.
std::string text(const UndecidedDesigns& undecided);

/// Designs in the order of their fronts, and within a front of the first quantity; then those that violate a
/// bound; those without results come last. The fronts of designs with numbers on a finer grid are those of
/// these numbers, among themselves. Numbers of different grids are not compared: the other designs have the
/// fronts of their own grid, and within a front they come after those on the finer grid.
std::vector<RankedDesign> ranked(const std::vector<RatedDesign>& designs,
                                 const std::vector<RankedQuantity>& quantities);

/// For programs, one row per design: its place, parameters, and its numbers in the units of summary.json:
/// those of its own grid, and if there are some of a finer one, these with their errors.
std::string designs_csv(const std::vector<RankedDesign>& designs);
std::string designs_json(const std::vector<RankedDesign>& designs,
                         const std::vector<RankedQuantity>& quantities);

/// For display: the first rows, with the requested quantities, on the finer grid with their errors if they
/// are known there; designs that violate a bound, on either grid, are marked.
std::string designs_table(const std::vector<RankedDesign>& designs,
                          const std::vector<RankedQuantity>& quantities, int max_rows);

/// Plots of the designs by the first quantity and each of the others (by itself, if it is the only one):
/// points, large on the front, with bars of their errors, next to the wheels of its first designs. An SVG
/// document.
std::string pareto_svg(const std::vector<RankedDesign>& designs,
                       const std::vector<RankedQuantity>& quantities, const std::string& title);

/// One HTML file that needs no network: the points by any two quantities, which link to the reports of the
/// runs, and the table. It belongs in the parent of the designs' folder.
std::string designs_page(const std::vector<RankedDesign>& designs,
                         const std::vector<RankedQuantity>& quantities, const std::string& title);

}  // namespace wheelwright
