#include "wheelwright/case/version.h"

namespace wheelwright {

std::string_view version() { return WHEELWRIGHT_VERSION; }

std::string_view compiler() {
#ifdef __clang__
  return __VERSION__;  // begins with its name
#else
  return "GCC " __VERSION__;
#endif
}

}  // namespace wheelwright
