#include "wheelwright/app/output_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "wheelwright/app/terminal.h"
#include "wheelwright/files/written_files.h"

namespace wheelwright {

bool may_write_to(const std::string& folder, std::span<const std::string_view> names) {
  const auto in_the_way = WrittenFiles(folder).standing(names);
  if (in_the_way.empty()) return true;
  print_err("{}: already contains {}; choose another folder, or move it away\n", folder,
            fmt::format("{}", fmt::join(in_the_way, ", ")));
  return false;
}

}  // namespace wheelwright
