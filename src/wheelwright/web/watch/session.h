#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "wheelwright/run/session/run.h"
#include "wheelwright/web/server/local_server.h"
#include "wheelwright/web/watch/board.h"
#include "wheelwright/web/watch/designs.h"
#include "wheelwright/web/watch/errors.h"
#include "wheelwright/web/watch/numbers.h"
#include "wheelwright/web/watch/page_commands.h"

namespace wheelwright {

/// The case for a watched run: without a limit on shapes, without files of intermediate shapes, and with a
/// checkpoint every few seconds.
Case watched_case(Case c);

/// Connects pages with one run: the addresses that they use, their commands, and what they are shown. It
/// knows the run only through its events and its command queue. The routes are thread-safe.
template <int dim>
class WatchSession {
 public:
  /// The queue must outlive the session. Pages can send commands of these kinds.
  explicit WatchSession(CommandQueue& commands, OfferedDesigns designs = {},
                        CommandKinds kinds = commands_of_every_run());

  /// Connects a run that takes its commands from the queue, before it is executed.
  void watch(Run<dim>& run);

  /// For a server, which the session must outlive.
  std::vector<Route> routes();

  /// Answers all waiting pages; none waits any longer.
  void close();

 private:
  PageAnswer frame(const PageRequest& request) const;
  PageAnswer command(const PageRequest& request);
  PageAnswer loaded(const PageRequest& request) const;
  PageAnswer numbers(const PageRequest& request) const;
  PageAnswer errors() const;
  PageAnswer estimate_errors();
  PageAnswer exported_file(const PageRequest& request) const;
  PageAnswer report() const;
  PageAnswer save(const PageRequest& request) const;
  PageAnswer take(const PageRequest& request);
  PageAnswer executed(Command command);

  std::filesystem::path folder_;  ///< of the run
  OfferedDesigns designs_;
  CommandKinds kinds_;
  std::shared_ptr<Board<dim>> board_;
  std::shared_ptr<WatchedNumbers<dim>> numbers_;
  std::shared_ptr<WatchedErrors<dim>> errors_;
  std::shared_ptr<PageCommands> commands_;
};

}  // namespace wheelwright
