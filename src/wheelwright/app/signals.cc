#include "wheelwright/app/signals.h"

#include <unistd.h>

namespace wheelwright {
namespace {

// A signal handler can access only globals.
volatile std::sig_atomic_t noted_stop = 0;
volatile std::sig_atomic_t save_requested = 0;

constexpr int exit_code_base = 128;

void note_stop(int signal) {
  if (noted_stop == SIGINT || noted_stop == SIGTERM) ::_exit(exit_code_base + signal);
  noted_stop = signal;
}

void note_hang_up(int) {
  if (noted_stop == 0) noted_stop = SIGHUP;
}

void note_save_request(int) { save_requested = 1; }

}  // namespace

Signals::Signals() {
  noted_stop = 0;
  save_requested = 0;
  const auto handle = [this](int signal, void (*handler)(int)) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) return;
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    ::sigaction(signal, &action, nullptr);
    before_[signal] = before;
  };
  handle(SIGINT, note_stop);
  handle(SIGTERM, note_stop);
  handle(SIGHUP, note_hang_up);
  handle(SIGUSR1, note_save_request);
  handle(SIGXFSZ, SIG_IGN);
}

Signals::~Signals() {
  for (const auto& [signal, action] : before_) ::sigaction(signal, &action, nullptr);
}

std::optional<int> Signals::stop() const {
  const int signal = noted_stop;
  return signal == 0 ? std::nullopt : std::optional(signal);
}

std::optional<Command> Signals::next_command() {
  if (save_requested != 0) {
    save_requested = 0;
    return Save{};
  }
  if (!stop() || stop_is_passed_on_) return {};
  stop_is_passed_on_ = true;
  return Stop{};
}

}  // namespace wheelwright
