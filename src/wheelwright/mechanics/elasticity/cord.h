#pragma once

#include "wheelwright/mechanics/elasticity/element.h"

namespace wheelwright {

/// The stiffness of a cord on the outer face of a cell, on the dofs of the cell: `stiffness` times the
/// integral of the hoop strains of both fields over the face. `stiffness` is that of the cord's section per
/// width along the axle, E A per width [N/m]. It resists only strain along the azimuth.
template <int dim>
Matrix cord_stiffness(const ElasticElement<dim>& element, double stiffness);

}  // namespace wheelwright
