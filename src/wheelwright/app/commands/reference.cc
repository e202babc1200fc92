#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/case/write.h"

namespace wheelwright {
namespace {

class ReferenceCommand : public Subcommand {
 public:
  ReferenceCommand() : Subcommand("reference", "Print the reference page for all keys of a case file") {}

  int run() override {
    print_lines(stdout, case_reference_markdown());
    return exit_done;
  }
};

}  // namespace

std::unique_ptr<Subcommand> make_reference() { return std::make_unique<ReferenceCommand>(); }

}  // namespace wheelwright
