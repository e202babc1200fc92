#include "wheelwright/app/contact_progress.h"

#include <fmt/format.h>

#include <memory>

#include "wheelwright/app/terminal.h"
#include "wheelwright/base/stopwatch.h"

namespace wheelwright {

std::string text(const ContactProgress& progress) {
  const std::string load =
      progress.n_loads > 1 ? fmt::format("load {} of {}, ", progress.load + 1, progress.n_loads) : "";
  return fmt::format("contact: {}position {} of {}, {} steps so far", load, progress.position + 1,
                     progress.n_positions, progress.newton_steps);
}

Interrupt print_contact_progress() {
  constexpr double seconds_between = 2;
  return Interrupt({}, [watch = std::make_shared<Stopwatch>()](const ContactProgress& progress) {
    if (watch->seconds() < seconds_between) return;
    watch->lap();
    print_err("{}\n", text(progress));
  });
}

}  // namespace wheelwright
