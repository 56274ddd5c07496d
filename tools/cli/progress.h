// A moving bar on standard error, for people who wait.

#ifndef EMMY_TOOLS_CLI_PROGRESS_H_
#define EMMY_TOOLS_CLI_PROGRESS_H_

#include <chrono>
#include <cstdint>
#include <string>

namespace emmy {

// "[====>     ]  42 %  step 420 of 1000  0:12 left": `elapsed` seconds after
// the step `first_step`.
std::string ProgressText(int64_t first_step, int64_t step, int64_t num_steps,
                         double elapsed);

// Draws nothing unless standard error is a terminal, nothing in the first
// second, and at most ten times a second after that.
class Progress {
 public:
  // A run from `first_step` to `num_steps`.
  Progress(int64_t first_step, int64_t num_steps, bool quiet);
  ~Progress() { Clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Update(int64_t step);

  // Removes the bar, so that other text can be written.
  void Clear();

 private:
  using Clock = std::chrono::steady_clock;

  int64_t first_step_;
  int64_t num_steps_;
  bool enabled_;
  bool visible_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;
};

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_PROGRESS_H_
