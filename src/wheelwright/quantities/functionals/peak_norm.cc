#include "wheelwright/quantities/functionals/peak_norm.h"

#include <cmath>

namespace wheelwright {

PeakNorm::Value PeakNorm::value(double peak, double integral, double unit) const {
  const double norm = unit * std::pow(integral, 1.0 / exponent);
  return {correction ? *correction : norm > 0 ? peak / norm : 0, norm};
}

}  // namespace wheelwright
