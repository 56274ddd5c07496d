#include "tools/cli/interrupt.h"

#include <csignal>
#include <ctime>

namespace emmy {
namespace {

// timeout and job schedulers send the same signal twice, to the program and to
// its group: what comes so soon is not a second wish.
constexpr std::time_t kSameWish = 1;  // [s]

volatile std::sig_atomic_t interrupted = 0;
std::timespec first_signal = {};

void OnSignal(int signal) {
  std::timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (interrupted == 0) {
    interrupted = 1;
    first_signal = now;
    return;
  }
  if (now.tv_sec - first_signal.tv_sec <= kSameWish) return;
  static_cast<void>(std::signal(signal, SIG_DFL));
  static_cast<void>(std::raise(signal));
}

}  // namespace

void CatchInterrupts() {
  static_cast<void>(std::signal(SIGINT, OnSignal));
  static_cast<void>(std::signal(SIGTERM, OnSignal));
}

bool IsInterrupted() { return interrupted != 0; }

}  // namespace emmy
