#include "emmy/io/history.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/string_view.h"
#include "emmy/base/crc64.h"
#include "emmy/diagnostics/body_motion.h"
#include "emmy/diagnostics/structure_motion.h"
#include "emmy/io/temporary_file.h"

namespace emmy {
namespace {

constexpr std::array<const char*, 3> kAxes = {"_x", "_y", "_z"};

void AddNames(const std::string& name, std::vector<std::string>* columns) {
  for (const char* axis : kAxes) columns->push_back(name + axis);
}

void AddBodyNames(const std::string& body, std::vector<std::string>* columns) {
  AddNames(body + ".position", columns);
  AddNames(body + ".velocity", columns);
  columns->push_back(body + ".quaternion_w");
  AddNames(body + ".quaternion", columns);
  AddNames(body + ".omega", columns);
  AddNames(body + ".omega_polar", columns);
  AddNames(body + ".omega_polar_exact", columns);
}

void AddValues(const Vector3d& vector, std::vector<double>* row) {
  row->insert(row->end(), vector.begin(), vector.end());
}

void AddBodyValues(const BodyMotion& motion, std::vector<double>* row) {
  AddValues(motion.position, row);
  AddValues(motion.velocity, row);
  row->insert(row->end(), motion.quaternion.begin(), motion.quaternion.end());
  AddValues(motion.omega_locked, row);
  AddValues(motion.omega_polar, row);
  AddValues(motion.omega_polar_exact, row);
}

}  // namespace

std::vector<double> HistoryRow(const Model& model, const State& state,
                               const Invariants& invariants, int iterations) {
  std::vector<double> row = {static_cast<double>(state.step),
                             state.time.value,
                             invariants.kinetic_energy.ToDouble(),
                             invariants.penalty_energy.ToDouble(),
                             invariants.elastic_energy.ToDouble(),
                             invariants.gravity_energy.ToDouble(),
                             invariants.load_work.ToDouble(),
                             invariants.TotalEnergy().ToDouble()};
  AddValues(invariants.momentum.ToDouble(), &row);
  AddValues(invariants.angular_momentum.ToDouble(), &row);
  row.push_back(iterations);
  for (size_t body = 0; body < model.bodies().size(); ++body) {
    AddBodyValues(ObserveBody(model, state, body), &row);
  }
  for (size_t node = 0; node < model.nodes().size(); ++node) {
    const PointMotion motion = ObserveNode(model, state, node);
    AddValues(motion.position, &row);
    AddValues(motion.velocity, &row);
  }
  for (size_t line = 0; line < model.lines().size(); ++line) {
    const LineObservation observation = ObserveLine(model, state, line);
    row.push_back(observation.strain);
    row.push_back(observation.force);
  }
  return row;
}

namespace {

// As %.17g, whatever the locale.
void AppendNumber(double value, std::string* line) {
  std::array<char, 32> buffer;
  const std::to_chars_result result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                    std::chars_format::general, 17);
  line->append(buffer.data(), result.ptr);
}

// A name as a field of a CSV file (RFC 4180).
std::string CsvField(const std::string& name) {
  if (name.find_first_of(",\"\r\n") == std::string::npos) return name;
  return absl::StrCat("\"", absl::StrReplaceAll(name, {{"\"", "\"\""}}), "\"");
}

absl::Status CannotWrite(const std::string& path, int error) {
  return absl::DataLossError(
      absl::StrCat(path, ": cannot be written: ", std::strerror(error)));
}

}  // namespace

std::vector<std::string> HistoryColumns(const Model& model) {
  std::vector<std::string> columns = {
      "step",           "time",           "kinetic_energy", "penalty_energy",
      "elastic_energy", "gravity_energy", "load_work",      "total_energy"};
  AddNames("momentum", &columns);
  AddNames("angular_momentum", &columns);
  columns.push_back("newton_iterations");
  for (const ModelBody& body : model.bodies()) {
    AddBodyNames(body.name, &columns);
  }
  for (const ModelNode& node : model.nodes()) {
    AddNames(node.name + ".position", &columns);
    AddNames(node.name + ".velocity", &columns);
  }
  for (const ModelLine& line : model.lines()) {
    columns.push_back(line.name + ".strain");
    columns.push_back(line.name + ".force");
  }
  return columns;
}

void HistoryWriter::CloseFile::operator()(std::FILE* file) const {
  // No row has gone through its buffer: nothing is left to fail.
  static_cast<void>(std::fclose(file));
}

HistoryWriter::HistoryWriter(std::string path, std::FILE* file,
                             std::vector<std::string> columns)
    : path_(std::move(path)), file_(file), columns_(std::move(columns)) {}

absl::StatusOr<HistoryWriter> HistoryWriter::Create(const std::string& path,
                                                    const Model& model) {
  absl::StatusOr<HistoryWriter> writer = Open(path, model);
  if (!writer.ok()) return writer;
  absl::Status status = writer->Begin();
  if (!status.ok()) return status;
  return writer;
}

absl::StatusOr<HistoryWriter> HistoryWriter::Open(const std::string& path,
                                                  const Model& model) {
  // No mode of fopen makes a file but leaves what is in it, to be replaced.
  const int descriptor =
      open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  std::FILE* file = descriptor < 0 ? nullptr : fdopen(descriptor, "wb");
  if (file != nullptr) return HistoryWriter(path, file, HistoryColumns(model));
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  return absl::FailedPreconditionError(
      absl::StrCat(path, ": cannot be opened: ", std::strerror(error)));
}

absl::Status HistoryWriter::Begin() {
  // Devices and pipes have nothing to be emptied of.
  if (ftruncate(fileno(file_.get()), 0) != 0 && errno != EINVAL) {
    return CannotWrite(path_, errno);
  }
  return WriteLine(absl::StrJoin(columns_, ",",
                                 [](std::string* out, const std::string& name) {
                                   absl::StrAppend(out, CsvField(name));
                                 }));
}

absl::StatusOr<HistoryWriter> HistoryWriter::Resume(
    const std::string& path, const Model& model,
    const HistoryPosition& position) {
  const auto cannot_open = [&path](absl::string_view reason) {
    return absl::FailedPreconditionError(
        absl::StrCat(path, ": cannot be continued: ", reason));
  };
  // A device or pipe has no rows to go on from, and may block when opened.
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    return cannot_open(error ? error.message() : "is not a regular file");
  }
  std::FILE* file = std::fopen(path.c_str(), "r+b");
  if (file == nullptr) return cannot_open(std::strerror(errno));
  HistoryWriter writer(path, file, HistoryColumns(model));
  std::string chunk(size_t{1} << 16, '\0');
  while (writer.end_.bytes < position.bytes) {
    const size_t wanted = static_cast<size_t>(
        std::min<uint64_t>(chunk.size(), position.bytes - writer.end_.bytes));
    const size_t count = std::fread(chunk.data(), 1, wanted, file);
    writer.end_.checksum =
        Crc64(std::string_view(chunk.data(), count), writer.end_.checksum);
    writer.end_.bytes += count;
    if (count < wanted) {
      return cannot_open(absl::StrCat("has ", writer.end_.bytes,
                                      " bytes, the checkpoint was written at ",
                                      position.bytes));
    }
  }
  if (writer.end_.checksum != position.checksum) {
    return cannot_open("is not the history of the checkpoint, or was changed");
  }
  std::filesystem::resize_file(path, position.bytes, error);
  if (error) return cannot_open(error.message());
  // The stream has served for reading; rows go past it.
  if (lseek(fileno(file), 0, SEEK_END) < 0) {
    return cannot_open(std::strerror(errno));
  }
  return writer;
}

absl::StatusOr<HistoryPosition> HistoryWriter::Sync() {
  // Terminals and pipes cannot be synced, and are not continued either.
  if (fsync(fileno(file_.get())) != 0 && errno != EINVAL && errno != EROFS) {
    return CannotWrite(path_, errno);
  }
  return end_;
}

absl::Status HistoryWriter::Write(const Model& model, const State& state,
                                  const Invariants& invariants,
                                  int iterations) {
  const std::vector<double> row =
      HistoryRow(model, state, invariants, iterations);
  std::string line;
  for (size_t i = 0; i < row.size(); ++i) {
    if (!std::isfinite(row[i])) {
      return absl::InternalError(absl::StrCat(
          path_, ": ", columns_[i], " is not finite at step ", state.step));
    }
    if (i > 0) line += ',';
    AppendNumber(row[i], &line);
  }
  return WriteLine(line);
}

absl::Status HistoryWriter::WriteLine(const std::string& line) {
  const std::string text = line + "\n";
  // Not by the stream, which would write a row in pieces of its buffer's size.
  const int error = WriteAll(fileno(file_.get()), text);
  if (error == 0) {
    end_.bytes += text.size();
    end_.checksum = Crc64(text, end_.checksum);
    return absl::OkStatus();
  }
  file_.reset();
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path_, ignored)) {
    std::filesystem::resize_file(path_, end_.bytes, ignored);
  }
  return CannotWrite(path_, error);
}

}  // namespace emmy
