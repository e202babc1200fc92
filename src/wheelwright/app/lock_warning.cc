#include "wheelwright/app/lock_warning.h"

#include <fmt/format.h>

#include "wheelwright/app/case_input.h"
#include "wheelwright/files/file_content.h"
#include "wheelwright/run/checkpoints/lock_reach.h"

namespace wheelwright {

void warn_of_local_locks(const std::filesystem::path& folder) {
  const auto place = std::filesystem::absolute(folder).lexically_normal();
  if (const auto why = why_locks_are_local(file_content("/proc/self/mountinfo"), place))
    print_warning(stderr,
                  fmt::format("{}: its locks do not reach other machines ({}): work in it on one machine "
                              "only, or mount the folder with locks that all machines see",
                              folder.string(), *why));
}

}  // namespace wheelwright
