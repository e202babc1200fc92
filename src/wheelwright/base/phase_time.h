#pragma once

#include <array>
#include <string>

namespace wheelwright {

/// Wall time of one phase of a computation.
struct PhaseTime {
  std::string phase;
  double seconds;
};

/// The phases of one trial shape in order: the only place of their names.
namespace phase {
inline constexpr const char *cut = "cut", *assembly = "assembly", *factorization = "factorization",
                            *contact = "contact", *recovery = "recovery", *functionals = "functionals",
                            *adjoint = "adjoint", *gradient = "gradient", *evolution = "evolution";
}
inline constexpr std::array<const char*, 9> phase_names{phase::cut,     phase::assembly, phase::factorization,
                                                        phase::contact, phase::recovery, phase::functionals,
                                                        phase::adjoint, phase::gradient, phase::evolution};

}  // namespace wheelwright
