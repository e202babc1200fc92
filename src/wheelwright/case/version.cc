#include "wheelwright/case/version.h"

namespace wheelwright {

std::string_view version() { return WHEELWRIGHT_VERSION; }

}  // namespace wheelwright
