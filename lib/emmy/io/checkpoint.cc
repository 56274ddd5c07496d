#include "emmy/io/checkpoint.h"

#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "emmy/base/build_info.h"
#include "emmy/base/crc64.h"
#include "emmy/io/case_writer.h"
#include "emmy/io/text_file.h"
#include "emmy/model/validation.h"

namespace emmy {
namespace {

constexpr std::string_view kFormat = "emmy-checkpoint/";
constexpr std::string_view kFirstLine = "emmy-checkpoint/1\n";
constexpr size_t kWord = 8;

void AppendWord(uint64_t word, std::string* bytes) {
  for (size_t i = 0; i < kWord; ++i) {
    bytes->push_back(static_cast<char>((word >> (8 * i)) & 0xFFU));
  }
}

uint64_t WordAt(std::string_view bytes, size_t position) {
  uint64_t word = 0;
  for (size_t i = 0; i < kWord; ++i) {
    word |= uint64_t{static_cast<unsigned char>(bytes[position + i])}
            << (8 * i);
  }
  return word;
}

uint64_t Checksum(std::string_view bytes) { return Crc64(bytes); }

// Fields to bytes. After the first error nothing counts.
class Encoder {
 public:
  void Whole(const char* /*name*/, uint64_t value) {
    AppendWord(value, &bytes_);
  }
  void Whole(const char* /*name*/, int64_t value) {
    AppendWord(static_cast<uint64_t>(value), &bytes_);
  }
  void Number(const char* name, double value) {
    if (!std::isfinite(value) && status_.ok()) {
      status_ = absl::InternalError(
          absl::StrCat("no checkpoint: ", name, " is not finite"));
    }
    AppendWord(std::bit_cast<uint64_t>(value), &bytes_);
  }
  void Text(const char* name, const std::string& text) {
    Whole(name, uint64_t{text.size()});
    bytes_ += text;
  }
  template <typename Derived>
  void Numbers(const char* name, const Eigen::PlainObjectBase<Derived>& m) {
    Whole(name, int64_t{m.rows()});
    Whole(name, int64_t{m.cols()});
    for (Eigen::Index i = 0; i < m.size(); ++i) Number(name, m.data()[i]);
  }
  // Makes room for the entries that will be passed next.
  template <typename T>
  void Size(const char* name, const std::vector<T>& list) {
    Whole(name, uint64_t{list.size()});
  }
  template <typename T>
  void Presence(const char* name, const std::optional<T>& value) {
    Whole(name, uint64_t{value.has_value() ? 1U : 0U});
  }

  const absl::Status& status() const { return status_; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  absl::Status status_;
};

// Bytes to fields. After the first error fields get defaults.
class Decoder {
 public:
  explicit Decoder(std::string_view bytes) : bytes_(bytes) {}

  void Whole(const char* name, uint64_t& value) {
    value = 0;
    if (!status_.ok()) return;
    if (left() < kWord) return Fail(name, "is missing");
    value = WordAt(bytes_, position_);
    position_ += kWord;
  }
  // Never negative in a checkpoint, and countable in double.
  void Whole(const char* name, int64_t& value) {
    uint64_t word = 0;
    Whole(name, word);
    if (word > static_cast<uint64_t>(kMaxSteps)) {
      word = 0;
      Fail(name, "is out of range");
    }
    value = static_cast<int64_t>(word);
  }
  void Number(const char* name, double& value) {
    uint64_t word = 0;
    Whole(name, word);
    value = std::bit_cast<double>(word);
    if (!std::isfinite(value)) {
      value = 0.0;
      Fail(name, "is not finite");
    }
  }
  void Text(const char* name, std::string& text) {
    text.clear();
    uint64_t size = 0;
    Whole(name, size);
    if (size > left()) return Fail(name, "is longer than the file");
    text = bytes_.substr(position_, size);
    position_ += size;
  }
  template <typename Derived>
  void Numbers(const char* name, Eigen::PlainObjectBase<Derived>& m) {
    int64_t rows = 0;
    int64_t columns = 0;
    Whole(name, rows);
    Whole(name, columns);
    if (!status_.ok()) return;
    const auto is_fixed = [](int64_t size, int fixed) {
      return fixed == Eigen::Dynamic || size == fixed;
    };
    constexpr int64_t kLargest = std::numeric_limits<int32_t>::max();
    if (rows > kLargest || columns > kLargest ||
        !is_fixed(rows, Derived::RowsAtCompileTime) ||
        !is_fixed(columns, Derived::ColsAtCompileTime) ||
        static_cast<uint64_t>(rows * columns) > left() / kWord) {
      return Fail(name, "has a wrong size");
    }
    m.resize(rows, columns);
    for (Eigen::Index i = 0; i < m.size(); ++i) Number(name, m.data()[i]);
  }
  template <typename T>
  void Size(const char* name, std::vector<T>& list) {
    uint64_t size = 0;
    Whole(name, size);
    // Each entry has at least a word.
    if (size > left() / kWord) return Fail(name, "is longer than the file");
    list.resize(size);
  }
  template <typename T>
  void Presence(const char* name, std::optional<T>& value) {
    uint64_t present = 0;
    Whole(name, present);
    if (present > 1) return Fail(name, "must be there or not");
    if (present == 1) value.emplace();
  }

  absl::Status status() const {
    if (status_.ok() && left() > 0) {
      return absl::InvalidArgumentError("has more fields than it should");
    }
    return status_;
  }

 private:
  size_t left() const { return bytes_.size() - position_; }
  void Fail(const char* name, const char* what) {
    if (!status_.ok()) return;
    status_ = absl::InvalidArgumentError(absl::StrCat(name, " ", what));
  }

  std::string_view bytes_;
  size_t position_ = 0;
  absl::Status status_;
};

// The sums and sequences of a state; `Sum` and `Vector` may be const.
template <typename Coder, typename Sum>
void CodeSum(Coder& coder, const char* name, Sum& sum) {
  coder.Number(name, sum.value);
  coder.Number(name, sum.compensation);
}
template <typename Coder, typename Vector>
void CodeVector(Coder& coder, const char* name, Vector& vector) {
  coder.Numbers(name, vector.value);
  coder.Numbers(name, vector.compensation);
}
template <typename Coder, typename Sequence>
void CodeSequence(Coder& coder, const char* name, Sequence& sequence) {
  coder.Numbers(name, sequence.next);
  coder.Numbers(name, sequence.differences);
}

template <typename Coder, typename StateType>
void CodeState(Coder& coder, StateType& state) {
  coder.Whole("step", state.step);
  CodeSum(coder, "time", state.time);
  CodeVector(coder, "position", state.position);
  CodeVector(coder, "velocity", state.velocity);
  CodeVector(coder, "strain", state.strain);
  CodeVector(coder, "end_velocity", state.end_velocity);
  CodeSum(coder, "load_work", state.load_work);
  CodeSequence(coder, "acceleration", state.acceleration);
  CodeSequence(coder, "multiplier", state.multiplier);
}

// All fields in their order: the format, for writing and reading alike.
template <typename Coder, typename CheckpointType>
void CodeFields(Coder& coder, CheckpointType& checkpoint) {
  coder.Text("case", checkpoint.case_name);
  coder.Whole("case checksum", checkpoint.case_checksum);
  coder.Text("build", checkpoint.build);
  CodeState(coder, checkpoint.state);
  coder.Size("factorisations", checkpoint.kept);
  for (auto& kept : checkpoint.kept) {
    coder.Numbers("factorised matrix", kept.matrix);
    coder.Numbers("factorised position", kept.positions);
    coder.Numbers("turn since factorisation", kept.turn);
    coder.Whole("fewest iterations with the factor", kept.fewest_iterations);
    coder.Whole("iterations beyond those", kept.excess_iterations);
  }
  for (auto& error : checkpoint.extremes.max_error) {
    coder.Number("largest error", error);
  }
  for (auto& scale : checkpoint.extremes.scale) coder.Number("scale", scale);
  coder.Whole("iterations", checkpoint.total_iterations);
  coder.Whole("largest iterations", checkpoint.max_iterations);
  coder.Whole("last iterations", checkpoint.last_iterations);
  coder.Number("wall time", checkpoint.wall_seconds);
  coder.Presence("history", checkpoint.history);
  if (checkpoint.history.has_value()) {
    coder.Whole("history length", checkpoint.history->bytes);
    coder.Whole("history checksum", checkpoint.history->checksum);
  }
}

absl::Status CutOff(size_t bytes) {
  return absl::InvalidArgumentError(
      absl::StrCat("the checkpoint is cut off after ", bytes, " bytes"));
}

// The content between first line and checksum, if both are right.
absl::StatusOr<std::string_view> Content(std::string_view bytes) {
  const std::string_view begin = bytes.substr(0, kFormat.size());
  if (begin != kFormat.substr(0, begin.size()) || bytes.empty()) {
    return absl::InvalidArgumentError("is not a checkpoint");
  }
  const size_t line_end = bytes.substr(0, 40).find('\n');
  if (line_end == std::string_view::npos) return CutOff(bytes.size());
  const std::string_view line = bytes.substr(0, line_end);
  if (line != kFirstLine.substr(0, kFirstLine.size() - 1)) {
    std::string shown(line);
    for (char& c : shown) {
      if (c < ' ' || c > '~') c = '?';
    }
    return absl::InvalidArgumentError(
        absl::StrCat("has the format ", shown,
                     "; this version of emmy reads emmy-checkpoint/1 only"));
  }
  const size_t start = kFirstLine.size() + kWord;
  if (bytes.size() < start + kWord) return CutOff(bytes.size());
  const uint64_t size = WordAt(bytes, kFirstLine.size());
  if (size > bytes.size() - start - kWord) return CutOff(bytes.size());
  const size_t end = start + static_cast<size_t>(size);
  if (end + kWord < bytes.size()) {
    return absl::InvalidArgumentError(
        "the checkpoint is damaged: there is something after its end");
  }
  if (WordAt(bytes, end) != Checksum(bytes.substr(0, end))) {
    return absl::InvalidArgumentError(
        "the checkpoint is damaged: its checksum is wrong");
  }
  return bytes.substr(start, end - start);
}

// The sizes of all arrays of a state.
std::vector<Eigen::Index> Sizes(const State& state) {
  std::vector<Eigen::Index> sizes;
  for (const CompensatedVector* v :
       {&state.position, &state.velocity, &state.strain, &state.end_velocity}) {
    sizes.push_back(v->value.size());
    sizes.push_back(v->compensation.size());
  }
  for (const Extrapolation* e : {&state.acceleration, &state.multiplier}) {
    sizes.push_back(e->next.size());
    sizes.push_back(e->differences.rows());
    sizes.push_back(e->differences.cols());
  }
  return sizes;
}

}  // namespace

uint64_t CaseChecksum(const Case& value) { return Crc64(WriteCase(value)); }

std::string CheckpointBuild() {
  const BuildInfo build = GetBuildInfo();
  return absl::StrCat("emmy ", build.version, ", ", build.compiler, ", ",
                      build.flags);
}

absl::StatusOr<std::string> EncodeCheckpoint(const Checkpoint& checkpoint) {
  Encoder content;
  CodeFields(content, checkpoint);
  if (!content.status().ok()) return content.status();
  std::string bytes(kFirstLine);
  AppendWord(content.bytes().size(), &bytes);
  bytes += content.bytes();
  AppendWord(Checksum(bytes), &bytes);
  return bytes;
}

absl::StatusOr<Checkpoint> DecodeCheckpoint(absl::string_view bytes) {
  const absl::StatusOr<std::string_view> content =
      Content(std::string_view(bytes.data(), bytes.size()));
  if (!content.ok()) return content.status();
  Decoder decoder(*content);
  Checkpoint checkpoint;
  CodeFields(decoder, checkpoint);
  const absl::Status status = decoder.status();
  if (status.ok()) return checkpoint;
  return absl::InvalidArgumentError(
      absl::StrCat("the checkpoint is damaged: ", status.message()));
}

absl::Status WriteCheckpoint(const std::string& path,
                             const Checkpoint& checkpoint) {
  const absl::StatusOr<std::string> bytes = EncodeCheckpoint(checkpoint);
  if (bytes.ok()) return WriteTextFile(path, *bytes);
  return absl::Status(bytes.status().code(),
                      absl::StrCat(path, ": ", bytes.status().message()));
}

absl::StatusOr<Checkpoint> ReadCheckpoint(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) &&
      !std::filesystem::is_regular_file(path, ignored)) {
    return absl::InvalidArgumentError(
        absl::StrCat(path, ": is not a regular file"));
  }
  constexpr size_t kMaxBytes = size_t{1} << 36;
  const absl::StatusOr<std::string> bytes = ReadTextFile(path, kMaxBytes);
  absl::Status status = bytes.status();
  if (bytes.ok()) {
    absl::StatusOr<Checkpoint> checkpoint = DecodeCheckpoint(*bytes);
    if (checkpoint.ok()) return checkpoint;
    status = checkpoint.status();
  }
  return absl::Status(status.code(),
                      absl::StrCat(path, ": ", status.message()));
}

absl::Status CheckSameCase(const Checkpoint& checkpoint, const Case& value,
                           const State& start) {
  if (checkpoint.case_checksum != CaseChecksum(value)) {
    return absl::InvalidArgumentError(
        checkpoint.case_name == value.name
            ? absl::StrCat("is a checkpoint of another version of the case ",
                           NameText(value.name),
                           ": a value was changed, in the file or by --set")
            : absl::StrCat("is a checkpoint of the case ",
                           NameText(checkpoint.case_name), ", this is ",
                           NameText(value.name)));
  }
  if (Sizes(checkpoint.state) != Sizes(start)) {
    return absl::InvalidArgumentError(
        "the checkpoint is damaged: its state does not fit the model");
  }
  return absl::OkStatus();
}

}  // namespace emmy
