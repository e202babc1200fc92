#include "wheelwright/app/commands/commands.h"

namespace wheelwright {

// The list. make_NAME() is in the file NAME.cc, make_export_() in export.cc.
#define WHEELWRIGHT_COMMANDS(apply) \
  apply(run);                       \
  apply(resume);                    \
  apply(explore);                   \
  apply(sweep);                     \
  apply(designs);                   \
  apply(analyze);                   \
  apply(compare);                   \
  apply(watch);                     \
  apply(report);                    \
  apply(verify);                    \
  apply(export_);                   \
  apply(check);                     \
  apply(init);                      \
  apply(docs);                      \
  apply(reference)

#define WHEELWRIGHT_DECLARE(name) std::unique_ptr<Subcommand> make_##name()
WHEELWRIGHT_COMMANDS(WHEELWRIGHT_DECLARE);
#undef WHEELWRIGHT_DECLARE

std::vector<std::unique_ptr<Subcommand>> make_commands() {
  std::vector<std::unique_ptr<Subcommand>> commands;
#define WHEELWRIGHT_ADD(name) commands.push_back(make_##name())
  WHEELWRIGHT_COMMANDS(WHEELWRIGHT_ADD);
#undef WHEELWRIGHT_ADD
  return commands;
}

#undef WHEELWRIGHT_COMMANDS

}  // namespace wheelwright
