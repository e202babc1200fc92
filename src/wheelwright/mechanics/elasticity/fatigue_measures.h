#pragma once

#include <memory>
#include <span>
#include <vector>

#include "wheelwright/mechanics/elasticity/symmetric_tensor.h"

namespace wheelwright {

// Measures of the history of stresses or strains of a material point over a turn. None depends on the order
// of the samples, at least one; each is the same in every frame. A turn is the cycle: the wheel repeats it,
// so that no cycles need to be counted (rainflow).

using TensorHistory = std::span<const SymmetricTensor>;

/// A measure of one history, to which it refers.
class MeasuredHistory {
 public:
  virtual ~MeasuredHistory() = default;

  /// The measure.
  virtual double value() const = 0;

  /// One value per sample. The largest is near the measure, by a few per cent at most, and depends smoothly
  /// on the history, unlike maxima and eigenvalues.
  virtual std::vector<double> samples() const = 0;

  /// The derivative of sum_j factor_j samples_j with respect to every tensor, of which a component beside the
  /// diagonal stands for two. Factors that are 0 cost little.
  virtual std::vector<SymmetricTensor> slopes(std::span<const double> factors) const = 0;
};

// The measures of a history, of(history, least): samples, and a value, that are less than `least` > 0 may be
// given as 0, which saves time.

/// The largest eigenvalue of the strains; that of a sample as the norm of exponent 16 of the positive ones.
struct LargestPrincipal {
  std::unique_ptr<const MeasuredHistory> of(TensorHistory strains, double least = 0) const;
};

// The samples of the last three are those of a ball that depends smoothly on the history (SmoothBall), their
// values those of the smallest one.

/// sqrt(J2)_a + alpha max p of stresses [Pa] (B. Crossland, Proc. Int. Conf. Fatigue of Metals, 1956): the
/// radius of the smallest ball around the path of the stress deviators s, measured by sqrt(s:s / 2), and the
/// largest hydrostatic stress p = tr(sigma) / 3.
struct Crossland {
  double pressure_factor;  ///< alpha
  std::unique_ptr<const MeasuredHistory> of(TensorHistory stresses, double least = 0) const;
};

/// max (tau + alpha p) of stresses [Pa] (K. Dang Van, ASTM STP 1191, 1993): tau is the largest shear stress
/// of s - s*, with s* the center of that ball, to which the material shakes down; that of a sample is
/// Hosford's of exponent 16, half of (sum of (e_i - e_k)^16 / 2)^(1/16) over the pairs of eigenvalues.
struct DangVan {
  double pressure_factor;  ///< alpha
  std::unique_ptr<const MeasuredHistory> of(TensorHistory stresses, double least = 0) const;
};

/// a / (1 - m / R_m) of stresses [Pa] (J. Goodman, 1899), and a where m < 0, with the von Mises stress a =
/// sqrt(3 J2)_a of the amplitude and the mean m of the largest and the smallest trace: amplitude and mean of
/// a uniaxial stress. (The von Mises stress with the sign of the trace, which is used as well, jumps where
/// the trace vanishes, and has half of the amplitude there.) Means above 0.999 R_m count as that. The samples
/// all have the measure of a smooth maximum and minimum of the trace.
struct Goodman {
  double ultimate_strength;  ///< R_m [Pa]
  std::unique_ptr<const MeasuredHistory> of(TensorHistory stresses, double least = 0) const;
};

}  // namespace wheelwright
