#include "wheelwright/app/slow_stage.h"

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "wheelwright/app/terminal.h"

namespace wheelwright {

SlowStage::SlowStage(std::string what, double seconds)
    : timer_([what = std::move(what), seconds](const std::stop_token& stop) {
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any wake;
        wake.wait_for(lock, stop, std::chrono::duration<double>(seconds), [] { return false; });
        if (!stop.stop_requested()) print_err("{} ...\n", what);
      }) {}

}  // namespace wheelwright
