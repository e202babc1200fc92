#pragma once

#include <string>

#include "wheelwright/base/interrupt.h"

namespace wheelwright {

/// "contact: position 3 of 8, 120 steps so far", with the load if there are several.
std::string text(const ContactProgress& progress);

/// For commands that solve one shape: an interrupt that is never requested and prints the progress of the
/// contact solver on standard error every two seconds.
Interrupt print_contact_progress();

}  // namespace wheelwright
