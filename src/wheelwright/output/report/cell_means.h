#pragma once

#include <span>
#include <vector>

#include "wheelwright/output/report/pressure_csv.h"

namespace wheelwright {

/// One point for each load position and cell at the tread, along the ground: the mean of the cell's points,
/// by their weights, with the sum of these. Forces do not change. Where a cell is only partly in contact the
/// pressures at its points are not accurate, unlike their mean, so curves are drawn through the means.
std::vector<ContactPoint> cell_means(std::span<const ContactPoint> points);

}  // namespace wheelwright
