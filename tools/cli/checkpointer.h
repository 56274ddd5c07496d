// When a run writes its checkpoint, and where.

#ifndef EMMY_TOOLS_CLI_CHECKPOINTER_H_
#define EMMY_TOOLS_CLI_CHECKPOINTER_H_

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "emmy/io/checkpoint.h"

namespace emmy {

struct CheckpointSettings {
  std::string path;              // None: no checkpoints.
  std::optional<int64_t> every;  // Steps; else about once a minute.
};

// Does nothing without a path, and nothing after its first error.
class Checkpointer {
 public:
  using Make = std::function<absl::StatusOr<Checkpoint>()>;

  // `make` says what a checkpoint of now would be.
  Checkpointer(CheckpointSettings settings, Make make);

  // To be called after every step.
  void Stepped(int64_t step);

  // Writes now, unless there already is the one of this step.
  void Write(int64_t step);

  // A file has been written that a later run can go on from.
  bool has_written() const { return last_step_ >= 0; }
  const absl::Status& status() const { return status_; }

 private:
  using Clock = std::chrono::steady_clock;

  bool IsDue(int64_t step) const;

  CheckpointSettings settings_;
  Make make_;
  int64_t last_step_ = -1;
  Clock::time_point next_;
  absl::Status status_;
};

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_CHECKPOINTER_H_
