#pragma once

#include <memory>
#include <mutex>

#include "wheelwright/base/interrupt.h"

namespace wheelwright {

/// The interrupt for several threads at a time: they ask and tell one after the other.
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
