#pragma once

namespace wheelwright {

/// The problem on the full ring B whose energy is the dual norm of tractions on Gamma_C in J_p2 (61).
enum class DualNorm {
  elasticity,  ///< -div sigma(w) = 0, sigma(w)n = g (68)
  poisson,     ///< -E Laplace w = 0, E dw/dn = g, for every component of w (Remark 7)
};

}  // namespace wheelwright
