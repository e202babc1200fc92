#pragma once

#include <string>

#include "wheelwright/base/interrupt.h"

namespace wheelwright {

/// "contact: load position 3 of 8, 120 steps so far".
std::string text(const ContactProgress& progress);

/// For commands that solve one shape: never requested; tells on standard error how far the contact is, every
/// two seconds.
Interrupt tell_contact_progress();

}  // namespace wheelwright
