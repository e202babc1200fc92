#include "wheelwright/run/checkpoints/case_file.h"

#include <fmt/format.h>

#include "wheelwright/case/write.h"
#include "wheelwright/files/atomic_file.h"
#include "wheelwright/run/checkpoints/own_drawings.h"
#include "wheelwright/run/checkpoints/provenance.h"

namespace wheelwright {

void write_case_file(const std::filesystem::path& folder, const Case& c) {
  write_drawings(folder, c);
  write_atomically(folder / case_file, fmt::format("# {}\n\n{}", program_text(), to_toml(c)));
}

}  // namespace wheelwright
