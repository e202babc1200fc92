#pragma once

#include <string>
#include <vector>

#include "wheelwright/output/report/described_wheel.h"
#include "wheelwright/shape/geometry/contour.h"

namespace wheelwright {

/// A wheel to compare with others; 2D only, because outlines are plane.
struct ComparedWheel {
  DescribedWheel<2> numbers;
  std::vector<Contour> contours;
};

/// For display: every quantity of every wheel, with its change from the first wheel.
std::string wheels_table(const std::vector<ComparedWheel>& wheels);

/// For programs: the same in SI units, named at the end of the keys. Numbers read back to the same double.
/// `within_errors` names the wheels that differ by less than their errors, with the keys of the numbers.
std::string wheels_json(const std::vector<ComparedWheel>& wheels);

/// The overlaid outlines of all wheels, to the same scale: the first filled, the others as coloured lines.
std::string overlay_svg(const std::vector<ComparedWheel>& wheels);

}  // namespace wheelwright
