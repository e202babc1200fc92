#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "wheelwright/run/run.h"
#include "wheelwright/server/local_server.h"
#include "wheelwright/watch/board.h"
#include "wheelwright/watch/designs.h"
#include "wheelwright/watch/numbers.h"
#include "wheelwright/watch/page_commands.h"

namespace wheelwright {

/// The case as a run computes it that is watched: without an end by its number of shapes, without files of
/// shapes on the way, and with a checkpoint every few seconds.
Case watched_case(Case c);

/// What connects pages with one run: the addresses that they use, the commands that they give and what they
/// are shown. It knows the run by its events and its queue of commands alone. Any thread may call the routes.
template <int dim>
class WatchSession {
 public:
  /// The queue must outlive the session.
  explicit WatchSession(CommandQueue& commands, OfferedDesigns designs = {});

  /// Makes a run that takes its commands from the queue known to pages, before it is executed.
  void watch(Run<dim>& run);

  /// For a server, which the session must outlive.
  std::vector<Route> routes();

  /// Answers the pages that wait; none waits any longer.
  void close();

 private:
  PageAnswer frame(const PageRequest& request) const;
  PageAnswer command(const PageRequest& request);
  PageAnswer loaded(const PageRequest& request) const;
  PageAnswer numbers(const PageRequest& request) const;
  PageAnswer exported_file(const PageRequest& request) const;
  PageAnswer report() const;
  PageAnswer save(const PageRequest& request) const;
  PageAnswer take(const PageRequest& request);
  PageAnswer obeyed(Command command);

  std::filesystem::path folder_;  ///< of the run
  OfferedDesigns designs_;
  std::shared_ptr<Board<dim>> board_;
  std::shared_ptr<WatchedNumbers<dim>> numbers_;
  std::shared_ptr<PageCommands> commands_;
};

}  // namespace wheelwright
