#include "wheelwright/app/commands/commands.h"
#include "wheelwright/app/exit_code.h"
#include "wheelwright/app/terminal.h"
#include "wheelwright/case/write.h"
#include "wheelwright/run/commands/command_reference.h"
#include "wheelwright/run/commands/commands.h"

namespace wheelwright {
namespace {

class ReferenceCommand : public Subcommand {
 public:
  ReferenceCommand() : Subcommand("reference", "Print the reference page for all keys of a case file") {}

  void declare(Options& options) override {
    options.flag("--commands", of_commands_, "Print that of the commands in a commands.jsonl");
  }

  int run() override {
    print_lines(stdout, of_commands_ ? command_reference_markdown(commands_of_every_run())
                                     : case_reference_markdown());
    return exit_done;
  }

 private:
  bool of_commands_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_reference() { return std::make_unique<ReferenceCommand>(); }

}  // namespace wheelwright
