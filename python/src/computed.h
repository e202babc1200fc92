#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include "errors.h"
#include "wheelwright/base/interrupt.h"
#include "wheelwright/base/process_settings.h"

namespace wheelwright::python {

/// Lets Ctrl-C end a computation: polled by it, without the GIL. What a signal's handler raises is kept until
/// the computation has ended.
class Signals {
 public:
  /// Whether a handler has raised something. Asks Python at most every 20 ms.
  bool raised() {
    const std::scoped_lock lock(mutex_);
    if (error_) return true;
    const auto now = std::chrono::steady_clock::now();
    if (now < ask_again_) return false;
    ask_again_ = now + std::chrono::milliseconds(20);
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) error_.emplace();
    return error_.has_value();
  }

  /// What was raised, once. With the GIL.
  void rethrow() {
    if (!error_) return;
    py::error_already_set error = *std::move(error_);
    error_.reset();
    throw error;
  }

 private:
  std::mutex mutex_;
  std::chrono::steady_clock::time_point ask_again_ = std::chrono::steady_clock::now();
  std::optional<py::error_already_set> error_;
};

/// An interrupt that signals request. They must outlive it.
inline Interrupt interrupt_by(Signals& signals) {
  return Interrupt([&signals] { return signals.raised(); });
}

/// While one exists, other threads of Python run, and BLAS computes with one thread.
class Computing {
  py::gil_scoped_release release_;
  OneBlasThread one_thread_;
};

/// compute(interrupt) in this way; its failure, and Ctrl-C, as exceptions.
template <class Compute>
auto computed(const Compute& compute) {
  Signals signals;
  auto result = [&] {
    const Computing computing;
    return compute(interrupt_by(signals));
  }();
  signals.rethrow();
  return value_of(std::move(result));
}

/// The same of a computation that cannot be interrupted, nor fail.
template <class Compute>
auto without_gil(const Compute& compute) {
  const Computing computing;
  return compute();
}

}  // namespace wheelwright::python
