#include "tools/cli/interrupt.h"

#include <csignal>

namespace emmy {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void OnSignal(int signal) {
  interrupted = 1;
  static_cast<void>(std::signal(signal, SIG_DFL));
}

}  // namespace

void CatchInterrupts() {
  static_cast<void>(std::signal(SIGINT, OnSignal));
  static_cast<void>(std::signal(SIGTERM, OnSignal));
}

bool IsInterrupted() { return interrupted != 0; }

}  // namespace emmy
