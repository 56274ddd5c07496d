#include "emmy/io/summary.h"

#include <nlohmann/json.hpp>

#include "emmy/base/build_info.h"
#include "emmy/base/check.h"
#include "emmy/io/json_text.h"

namespace emmy {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Text that may have file names in it, which are any bytes.
OrderedJson RecordJson(const std::string& text) {
  return OrderedJson::parse(OrderedJson(text).dump(
      -1, ' ', false, OrderedJson::error_handler_t::replace));
}
OrderedJson RecordJson(double x) { return x; }
OrderedJson RecordJson(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

template <typename Record>
OrderedJson RecordJson(const Record& record) {
  return {{"initial", RecordJson(record.initial)},
          {"final", RecordJson(record.final)},
          {"max_error", record.max_error},
          {"scale", record.scale},
          {"max_relative_error", record.max_relative_error()},
          {"conserved", record.conserved}};
}

}  // namespace

std::string StatusName(RunStatus status) {
  switch (status) {
    case RunStatus::kCompleted:
      return "completed";
    case RunStatus::kFailed:
      return "failed";
    case RunStatus::kInterrupted:
      return "interrupted";
  }
  EMMY_CHECK(false, static_cast<int>(status));
}

std::string WriteSummary(const RunSummary& summary) {
  const BuildInfo build = GetBuildInfo();
  OrderedJson json = {{"format", "emmy-summary/1"},
                      {"case", summary.case_name},
                      {"status", StatusName(summary.status)}};
  if (!summary.message.empty()) json["message"] = RecordJson(summary.message);
  json["steps"] = summary.steps;
  json["time"] = summary.time;
  json["wall_seconds"] = summary.wall_seconds;
  json["degrees_of_freedom"] = summary.degrees_of_freedom;
  json["invariants"] = {
      {"energy", RecordJson(summary.energy)},
      {"momentum", RecordJson(summary.momentum)},
      {"angular_momentum", RecordJson(summary.angular_momentum)}};
  json["newton"] = {{"mean_iterations", summary.mean_iterations},
                    {"max_iterations", summary.max_iterations}};
  json["build"] = {{"version", build.version},
                   {"compiler", build.compiler},
                   {"flags", build.flags}};
  return FormatJson(json) + "\n";
}

}  // namespace emmy
