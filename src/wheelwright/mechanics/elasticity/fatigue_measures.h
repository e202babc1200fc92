#pragma once

#include <span>
#include <vector>

#include "wheelwright/mechanics/elasticity/symmetric_tensor.h"

namespace wheelwright {

// Measures of the history of stresses or strains of a material point over a turn. None depends on the order
// of the samples, at least one; each is the same in every frame. A turn is the cycle: the wheel repeats it,
// so that no cycles need to be counted (rainflow).

/// The measure and its derivatives with respect to the samples on which it depends.
struct HistoryMeasure {
  double value = 0;
  struct Slope {
    int sample;
    SymmetricTensor by_tensor;  ///< a component beside the diagonal stands for two
  };
  std::vector<Slope> slopes = {};
};

/// The largest eigenvalue of the strains.
HistoryMeasure largest_principal(std::span<const SymmetricTensor> strains);

/// sqrt(J2)_a + alpha max p of stresses [Pa] (B. Crossland, Proc. Int. Conf. Fatigue of Metals, 1956): the
/// radius of the smallest ball around the path of the stress deviators s, measured by sqrt(s:s / 2), and the
/// largest hydrostatic stress p = tr(sigma) / 3.
HistoryMeasure crossland(std::span<const SymmetricTensor> stresses, double pressure_factor);

/// max (tau + alpha p) of stresses [Pa] (K. Dang Van, ASTM STP 1191, 1993): tau is the largest shear stress
/// of s
/// - s*, with s* the center of that ball, to which the material shakes down.
HistoryMeasure dang_van(std::span<const SymmetricTensor> stresses, double pressure_factor);

/// a / (1 - m / R_m) of stresses [Pa], with the amplitude a and the mean m >= 0 of the von Mises stress with
/// the sign of the trace (J. Goodman, 1899), and a where m < 0. R_m: `ultimate_strength` [Pa]; means above
/// 0.999 R_m count as that.
HistoryMeasure goodman(std::span<const SymmetricTensor> stresses, double ultimate_strength);

}  // namespace wheelwright
