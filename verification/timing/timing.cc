#include "verification/timing/timing.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"

namespace emmy::verification {
namespace {

using OrderedJson = nlohmann::ordered_json;

// Keys of Google Benchmark's that are not counters of ours.
bool IsOwnKey(const std::string& key) {
  static const char* const kKeys[] = {
      "family_index",     "per_family_instance_index",
      "repetitions",      "repetition_index",
      "threads",          "iterations",
      "real_time",        "cpu_time",
      "items_per_second", "bytes_per_second"};
  return std::any_of(std::begin(kKeys), std::end(kKeys),
                     [&key](const char* own) { return key == own; });
}

double Nanoseconds(double time, const std::string& unit) {
  if (unit == "us") return 1e3 * time;
  if (unit == "ms") return 1e6 * time;
  if (unit == "s") return 1e9 * time;
  return time;
}

double Median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half]
                                : 0.5 * (values[half - 1] + values[half]);
}

struct Samples {
  std::vector<double> times;
  std::map<std::string, std::vector<double>> counters;
  std::string label;
  std::string error;
};

// Names without the settings that Google Benchmark appends.
std::string PlainName(const std::string& name) {
  std::string plain = name;
  for (const char* const suffix :
       {"/min_time:", "/iterations:", "/repeats:", "/real_time"}) {
    plain = plain.substr(0, plain.find(suffix));
  }
  return plain;
}

void AddRow(const OrderedJson& row, Samples* samples) {
  samples->label = row.value("label", "");
  if (row.value("error_occurred", false)) {
    samples->error = row.value("error_message", "failed");
    return;
  }
  // A benchmark with threads of its own measures by the clock, and says so in
  // its name. One that does several steps in an iteration counts them.
  const bool by_clock =
      row.value("name", "").find("/real_time") != std::string::npos;
  const double steps = row.value("body_steps", 1.0);
  samples->times.push_back(
      Nanoseconds(row.at(by_clock ? "real_time" : "cpu_time").get<double>(),
                  row.at("time_unit").get<std::string>()) /
      steps);
  for (const auto& [key, value] : row.items()) {
    if (value.is_number() && !IsOwnKey(key)) {
      samples->counters[key].push_back(value.get<double>());
    }
  }
}

std::string ProcessorText(const OrderedJson& context) {
  std::string text =
      absl::StrFormat("%d x %d MHz", context.value("num_cpus", 0),
                      context.value("mhz_per_cpu", 0));
  for (const OrderedJson& cache :
       context.value("caches", OrderedJson::array())) {
    if (cache.value("type", "") == "Instruction") continue;
    absl::StrAppend(&text, ", L", cache.value("level", 0), " ",
                    cache.value("size", 0) / 1024, " KiB");
  }
  return text;
}

TimingRun Collect(const OrderedJson& json) {
  TimingRun run;
  const OrderedJson& context = json.at("context");
  run.date = context.value("date", "");
  run.processor = ProcessorText(context);
  run.program = context.value("emmy", "");
  std::vector<std::string> order;
  std::map<std::string, Samples> all;
  for (const OrderedJson& row : json.at("benchmarks")) {
    if (row.value("run_type", "iteration") != "iteration") continue;
    const std::string name =
        PlainName(row.value("run_name", row.at("name").get<std::string>()));
    if (all.count(name) == 0) order.push_back(name);
    AddRow(row, &all[name]);
  }
  for (const std::string& name : order) {
    const Samples& samples = all[name];
    Timing& timing = run.timings.emplace_back();
    timing.name = name;
    timing.error = samples.error;
    timing.label = samples.label;
    timing.repetitions = static_cast<int>(samples.times.size());
    timing.median = Median(samples.times);
    if (!samples.times.empty()) {
      const auto [least, most] =
          std::minmax_element(samples.times.begin(), samples.times.end());
      timing.spread = (*most - *least) / timing.median;
    }
    for (const auto& [key, values] : samples.counters) {
      timing.counters[key] = Median(values);
    }
  }
  return run;
}

}  // namespace

const Timing* TimingRun::Find(const std::string& name) const {
  for (const Timing& timing : timings) {
    if (timing.name == name && timing.error.empty()) return &timing;
  }
  return nullptr;
}

absl::StatusOr<TimingRun> ReadTimings(const std::string& path) {
  std::ifstream in(path);
  if (!in) return absl::NotFoundError(absl::StrCat(path, ": cannot open"));
  std::string text((std::istreambuf_iterator<char>(in)),
                   std::istreambuf_iterator<char>());
  // Spreads of counters that are zero are written so, which is not JSON.
  absl::StrReplaceAll({{": NaN", ": null"}, {": Infinity", ": null"}}, &text);
  const OrderedJson json =
      OrderedJson::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) {
    return absl::DataLossError(absl::StrCat(path, ": not valid JSON"));
  }
  // The one place where that library's exceptions are met: values of the wrong
  // type in a file that is not ours.
  try {
    return Collect(json);
  } catch (const OrderedJson::exception& error) {
    return absl::DataLossError(absl::StrCat(
        path, ": not written by Google Benchmark: ", error.what()));
  }
}

}  // namespace emmy::verification
