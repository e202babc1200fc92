#include "wheelwright/run/checkpoints/provenance.h"

#include <fmt/format.h>

#include "wheelwright/case/design_radii.h"
#include "wheelwright/case/version.h"
#include "wheelwright/case/write.h"

namespace wheelwright {

std::string program_text() {
  return fmt::format("wheelwright {}, commit {}, compiled by {}", version(),
                     commit().empty() ? "unknown" : commit(), compiler());
}

Provenance provenance(const Case& c) {
  Case computed = at_middle_radii(c);  // a run chooses radii itself
  computed.title = {};
  computed.output = {};
  computed.expectations = {};
  computed.optimizer.iterations = {};
  computed.optimizer.tolerance = {};
  return {to_toml(computed), program_text()};
}

}  // namespace wheelwright
