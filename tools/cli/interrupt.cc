#include "tools/cli/interrupt.h"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace emmy {
namespace {

// timeout and job schedulers send the same signal twice, to the program and to
// its group: what comes so soon is not a second wish.
constexpr int64_t kSameWish = 2'000'000'000;  // [ns]

// When the first signal came [ns], or none so far.
constexpr int64_t kNone = -1;
std::atomic<int64_t> first_signal = kNone;
static_assert(std::atomic<int64_t>::is_always_lock_free);

void OnSignal(int signal) {
  std::timespec time = {};
  clock_gettime(CLOCK_MONOTONIC, &time);
  const int64_t now = int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  int64_t first = kNone;
  if (first_signal.compare_exchange_strong(first, now)) return;
  if (now - first < kSameWish) return;
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
