#include "tools/cli/interrupt.h"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace emmy {
namespace {

// timeout and job schedulers send the same signal twice, to the program and to
// its group: what comes so soon is not a second wish.
constexpr std::time_t kSameWish = 1;  // [s]

// When the first signal came [s], or none so far.
constexpr int64_t kNone = -1;
std::atomic<int64_t> first_signal = kNone;
static_assert(std::atomic<int64_t>::is_always_lock_free);

void OnSignal(int signal) {
  std::timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  int64_t first = kNone;
  if (first_signal.compare_exchange_strong(first, now.tv_sec)) return;
  if (now.tv_sec - first <= kSameWish) return;
  static_cast<void>(std::signal(signal, SIG_DFL));
  static_cast<void>(std::raise(signal));
}

}  // namespace

void CatchInterrupts() {
  static_cast<void>(std::signal(SIGINT, OnSignal));
  static_cast<void>(std::signal(SIGTERM, OnSignal));
}

bool IsInterrupted() { return first_signal != kNone; }

}  // namespace emmy
