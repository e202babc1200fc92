#include "app/commands/verify.h"

#include <fmt/format.h>

#include "app/exit_code.h"

namespace wheelwright {

int verify_command(const Case&, const RunOptions&) {
  fmt::print(stderr, "wheelwright verify: not built yet\n");
  return exit_bug;
}

}  // namespace wheelwright
