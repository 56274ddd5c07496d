#include "tools/cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "absl/strings/str_format.h"

namespace emmy {
namespace {

constexpr std::chrono::milliseconds kFirst(1000);
constexpr std::chrono::milliseconds kInterval(100);

bool HasTerminal() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 &&
         (terminal == nullptr || std::string(terminal) != "dumb");
}

// "0:07", "1:02:03".
std::string Clock(double seconds) {
  const auto total =
      static_cast<int64_t>(std::ceil(std::clamp(seconds, 0.0, 1e9)));
  const int64_t hours = total / 3600;
  const int64_t minutes = total / 60 % 60;
  if (hours == 0) return absl::StrFormat("%d:%02d", minutes, total % 60);
  return absl::StrFormat("%d:%02d:%02d", hours, minutes, total % 60);
}

}  // namespace

std::string ProgressText(int64_t first_step, int64_t step, int64_t num_steps,
                         double elapsed) {
  constexpr int kWidth = 24;
  const double part = std::clamp(
      static_cast<double>(step) / static_cast<double>(num_steps), 0.0, 1.0);
  const auto filled = static_cast<size_t>(part * kWidth);
  std::string bar(filled, '=');
  if (filled < kWidth) bar += '>';
  bar.resize(kWidth, ' ');
  const auto done = static_cast<double>(step - first_step);
  const auto to_do = static_cast<double>(num_steps - step);
  const std::string left =
      done > 0.0 ? Clock(elapsed * to_do / done) + " left" : "";
  return absl::StrFormat("[%s] %3d %%  step %d of %d  %s", bar,
                         static_cast<int>(100.0 * part), step, num_steps, left);
}

Progress::Progress(int64_t first_step, int64_t num_steps, bool quiet)
    : first_step_(first_step),
      num_steps_(std::max<int64_t>(num_steps, 1)),
      enabled_(!quiet && HasTerminal()),
      next_(start_ + kFirst) {}

void Progress::Update(int64_t step) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  visible_ = true;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  // To the left margin, the text, and away with the rest of the line.
  static_cast<void>(std::fprintf(
      stderr, "\r%s\033[K",
      ProgressText(first_step_, step, num_steps_, elapsed).c_str()));
  static_cast<void>(std::fflush(stderr));
}

void Progress::Clear() {
  if (!visible_) return;
  visible_ = false;
  static_cast<void>(std::fputs("\r\033[K", stderr));
  static_cast<void>(std::fflush(stderr));
}

}  // namespace emmy
