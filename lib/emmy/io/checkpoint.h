// Checkpoints: a run between two steps, in a file, to go on from bit for bit.
//
// emmy-checkpoint/1: the line "emmy-checkpoint/1", the length of the content,
// the content, and Crc64 of all before it. The content is a fixed list of
// fields; numbers are eight bytes, the least significant first, doubles in
// their IEEE form, so that every bit comes back. NaN and infinity are neither
// written nor read.
//
// Besides the state it holds what cannot be had from state and case: the
// factorisations that structures keep from step to step, the largest errors so
// far, and where the history ended. The start of the run is not in it: it is
// made again from the case, which is why the case must be the same.
//
// The number changes with the list of fields and with what a field means, from
// the first release on. What was written before that (with a column more of
// what Extrapolation keeps) is refused for its sizes.
//
//   Checkpoint checkpoint{.case_name = loaded.description.name,
//                         .case_checksum = CaseChecksum(loaded.description),
//                         .build = CheckpointBuild(),
//                         .state = loaded.state,
//                         .kept = integrator.Keep(),
//                         .extremes = monitor.extremes()};
// and after ReadCheckpoint and CheckSameCase
//   integrator.Restore(checkpoint.kept);
//   monitor.Resume(checkpoint.state, checkpoint.extremes);

#ifndef EMMY_IO_CHECKPOINT_H_
#define EMMY_IO_CHECKPOINT_H_

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "emmy/base/export.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/integrate/coupled_tangent.h"
#include "emmy/io/case.h"
#include "emmy/io/history.h"
#include "emmy/model/state.h"

namespace emmy {

// What the file holds.
struct Checkpoint {
  std::string case_name;       // Case::name, for messages.
  uint64_t case_checksum = 0;  // CaseChecksum
  std::string build;           // CheckpointBuild() of the writer.
  State state;                 // After its last step, compensations included.
  std::vector<KeptTangent> kept;  // EnergyMomentumIntegrator::Keep.
  InvariantExtremes extremes;     // InvariantMonitor::extremes.
  int64_t total_iterations = 0;   // Of all steps so far.
  int64_t max_iterations = 0;     // Of one step.
  int64_t last_iterations = 0;    // Of the step that led to `state`.
  double wall_seconds = 0.0;      // Spent so far.
  // The rows up to `state` of a run that writes a history.
  std::optional<HistoryPosition> history;
};

// Crc64 of the canonical text of a case (WriteCase): of what is computed, not
// of how the file is written or which values came from the command line.
EMMY_EXPORT uint64_t CaseChecksum(const Case& value);

// Version, compiler and flags, on which the last bits may depend.
EMMY_EXPORT std::string CheckpointBuild();

// The bytes of the file. Fails with kInternal, naming the field, if a number is
// not finite.
EMMY_EXPORT absl::StatusOr<std::string> EncodeCheckpoint(
    const Checkpoint& checkpoint);

// The inverse. Fails with kInvalidArgument and the reason if the bytes are not
// a whole, undamaged checkpoint of a version that is known. Memory is bounded
// by the number of bytes, whatever they say.
EMMY_EXPORT absl::StatusOr<Checkpoint> DecodeCheckpoint(
    absl::string_view bytes);

// The same with a file, which is replaced as a whole or not at all and is on
// the disk on return; messages begin with `path`.
EMMY_EXPORT absl::Status WriteCheckpoint(const std::string& path,
                                         const Checkpoint& checkpoint);
// DecodeCheckpoint of the content of a file; messages begin with `path`.
EMMY_EXPORT absl::StatusOr<Checkpoint> ReadCheckpoint(const std::string& path);

// Fails with kInvalidArgument and the reason unless the checkpoint is one of a
// run of this case, whose state at the start is `start`.
EMMY_EXPORT absl::Status CheckSameCase(const Checkpoint& checkpoint,
                                       const Case& value, const State& start);

}  // namespace emmy

#endif  // EMMY_IO_CHECKPOINT_H_
