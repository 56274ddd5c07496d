// history.csv: the motion as a table, a row per output step.
//
// One header row; then numbers with 17 significant digits, so that reading
// them gives the same doubles. Columns: step, time [s]; energies [J]; momentum
// [kg m/s]; angular momentum about the inertial origin [kg m^2/s]; iterations
// of the step; for each body position [m], velocity [m/s], quaternion and the
// three angular velocities [rad/s] of BodyMotion, inertial frame; for each node
// position and velocity; for each truss and spring strain and force [N].
//
// The file grows by whole rows while the run goes on, each by one call to the
// system; if that fails, what part of it was written is cut off again. Only a
// program that is killed or a machine that stops within the call may leave part
// of a row, without its end of line. NaN and infinity are never written.

#ifndef EMMY_IO_HISTORY_H_
#define EMMY_IO_HISTORY_H_

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "emmy/base/export.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"

namespace emmy {

// The names of the columns, without quotation marks.
EMMY_EXPORT std::vector<std::string> HistoryColumns(const Model& model);

// The end of a row in a history.
struct HistoryPosition {
  uint64_t bytes = 0;     // Length of the file up to there,
  uint64_t checksum = 0;  // and Crc64 of that.
};

// A row in the order of HistoryColumns. `iterations` is that of the step that
// led to `state`.
EMMY_EXPORT std::vector<double> HistoryRow(const Model& model,
                                           const State& state,
                                           const Invariants& invariants,
                                           int iterations);

class EMMY_EXPORT HistoryWriter {
 public:
  // Makes or replaces the file and writes the header row. Fails with
  // kFailedPrecondition if it cannot be opened, kDataLoss if it cannot be
  // written. Messages begin with `path`.
  static absl::StatusOr<HistoryWriter> Create(const std::string& path,
                                              const Model& model);

  // The two parts of Create: Open makes the file or leaves what is in it, and
  // fails with kFailedPrecondition; then Begin replaces that by the header row,
  // and fails with kDataLoss: call nothing else then.
  static absl::StatusOr<HistoryWriter> Open(const std::string& path,
                                            const Model& model);
  // The second part.
  absl::Status Begin();

  // Opens the file to go on at `position`, and cuts off what is beyond it.
  // Fails with kFailedPrecondition if the file does not begin with what the
  // position belongs to.
  static absl::StatusOr<HistoryWriter> Resume(const std::string& path,
                                              const Model& model,
                                              const HistoryPosition& position);

  // Appends a row. `iterations` is that of the step that led to `state`, 0 at
  // the start. Fails, leaving the rows before, if a value is not finite (its
  // column is named) or the file cannot be written; do not call again then.
  absl::Status Write(const Model& model, const State& state,
                     const Invariants& invariants, int iterations);

  // Waits until all rows are on the disk; then where the next one will begin.
  absl::StatusOr<HistoryPosition> Sync();

  // As given.
  const std::string& path() const { return path_; }

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const;
  };

  HistoryWriter(std::string path, std::FILE* file,
                std::vector<std::string> columns);

  absl::Status WriteLine(const std::string& line);

  std::string path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::vector<std::string> columns_;
  HistoryPosition end_;  // Of the last complete row.
};

}  // namespace emmy

#endif  // EMMY_IO_HISTORY_H_
