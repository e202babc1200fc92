#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace wheelwright {

/// Why a numerical stage failed. The optimization loop then rejects the trial shape and halves its step.
enum class FailureReason {
  disconnected_material,  ///< some material is not attached to the rim
  tread_cut_off,          ///< holes join around the whole wheel: the tread is not attached to the rim
  protected_band,         ///< a hole reaches the rows of cells kept full at the rim or the tread
  cut_quadrature,         ///< the quadrature of a cut cell does not satisfy the divergence theorem
  not_positive_definite,  ///< the stiffness could not be factored
  newton_stalled,         ///< the contact iteration did not converge
  no_contact,             ///< no point touches the ground
  rim_under_ground,       ///< the rim travels farther than the ring is thick
  material_overlaps,      ///< deformed edges of holes or tread cross each other
  not_finite,             ///< a NaN or an infinity appeared
  inaccurate_solution,    ///< the residual of a solve is too large
  negative_energy,        ///< a strain energy came out negative
  empty_shape,            ///< no material, or no boundary to move
  objective_jumped,       ///< the objective changed by more than a small step can explain
  too_narrow,             ///< walls or gaps remain below the minimum width
  unsupported_model,      ///< the solver has no equations for this model
  interrupted,            ///< the caller asked the computation to end early (base/interrupt.h)
  sliding,                ///< friction cannot hold the rim
  overload,               ///< the loads deform the wheel far beyond linear elasticity
};

/// The reason as a word for logs and history files, e.g. "newton_stalled".
constexpr const char* to_string(FailureReason reason) {
  switch (reason) {
    case FailureReason::disconnected_material:
      return "disconnected_material";
    case FailureReason::tread_cut_off:
      return "tread_cut_off";
    case FailureReason::protected_band:
      return "protected_band";
    case FailureReason::cut_quadrature:
      return "cut_quadrature";
    case FailureReason::not_positive_definite:
      return "not_positive_definite";
    case FailureReason::newton_stalled:
      return "newton_stalled";
    case FailureReason::no_contact:
      return "no_contact";
    case FailureReason::rim_under_ground:
      return "rim_under_ground";
    case FailureReason::material_overlaps:
      return "material_overlaps";
    case FailureReason::not_finite:
      return "not_finite";
    case FailureReason::inaccurate_solution:
      return "inaccurate_solution";
    case FailureReason::negative_energy:
      return "negative_energy";
    case FailureReason::empty_shape:
      return "empty_shape";
    case FailureReason::objective_jumped:
      return "objective_jumped";
    case FailureReason::too_narrow:
      return "too_narrow";
    case FailureReason::unsupported_model:
      return "unsupported_model";
    case FailureReason::interrupted:
      return "interrupted";
    case FailureReason::sliding:
      return "sliding";
    case FailureReason::overload:
      return "overload";
  }
  return "unknown";
}

/// A numerical failure: a value that the caller handles, never an exception.
struct Failure {
  FailureReason reason;
  std::string detail;  ///< one line: where, by how much, and what would help
  /// About the largest load at which a wheel does not fail so, where it is known [N/m in 2D, N in 3D].
  std::optional<double> largest_load = {};
};

/// "REASON: DETAIL".
inline std::string to_string(const Failure& failure) {
  return std::string(to_string(failure.reason)) + ": " + failure.detail;
}

/// Holds either a T or the error E, by default a numerical Failure, that prevented it.
template <class T, class E = Failure>
class [[nodiscard]] Expected {
 public:
  Expected(T value) : content_(std::move(value)) {}
  Expected(E failure) : content_(std::move(failure)) {}

  explicit operator bool() const { return std::holds_alternative<T>(content_); }
  const T& operator*() const& { return std::get<T>(content_); }
  T& operator*() & { return std::get<T>(content_); }
  T&& operator*() && { return std::get<T>(std::move(content_)); }
  const T* operator->() const { return &std::get<T>(content_); }
  T* operator->() { return &std::get<T>(content_); }
  const E& failure() const { return std::get<E>(content_); }

 private:
  std::variant<T, E> content_;
};

}  // namespace wheelwright
