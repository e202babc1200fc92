#pragma once

#include <memory>
#include <mutex>

#include "wheelwright/base/interrupt.h"

namespace wheelwright {

/// The interrupt for use by several threads, which poll and report one at a time.
inline Interrupt shared_by_threads(const Interrupt& interrupt) {
  const auto mutex = std::make_shared<std::mutex>();
  return Interrupt(
      [interrupt, mutex] {
        const std::scoped_lock lock(*mutex);
        return interrupt.requested();
      },
      [interrupt, mutex](const ContactProgress& progress) {
        const std::scoped_lock lock(*mutex);
        interrupt.report(progress);
      });
}

}  // namespace wheelwright
