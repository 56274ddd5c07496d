#include "verification/report/json_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "emmy/io/json_text.h"
#include "verification/report/html_claim.h"

namespace emmy::verification {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson Number(double value) {
  if (std::isfinite(value)) return value;
  if (std::isnan(value)) return "nan";
  return value > 0.0 ? "inf" : "-inf";
}

OrderedJson OutcomeJson(const Outcome& outcome) {
  const Claim& claim = *outcome.claim;
  OrderedJson json;
  json["id"] = claim.id;
  json["group"] = claim.group();
  json["sentence"] = claim.sentence;
  json["equations"] = claim.equations;
  json["reference"] = ReferenceName(claim.reference);
  json["metric"] = claim.metric;
  json["unit"] = claim.unit;
  json["bound"] = {{"lower", Number(claim.bound.lower)},
                   {"upper", Number(claim.bound.upper)},
                   {"derivation", claim.bound.derivation}};
  json["pass"] = outcome.pass;
  json["margin"] = Number(outcome.margin);
  json["values"] = OrderedJson::array();
  for (const MetricValue& value : outcome.result.values) {
    json["values"].push_back(
        {{"label", value.label}, {"value", Number(value.value)}});
  }
  json["failure"] = outcome.failure;
  json["notes"] = outcome.result.notes;
  json["figures"] = OrderedJson::array();
  for (const Figure& figure : outcome.result.figures) {
    json["figures"].push_back({{"title", figure.title},
                               {"image", figure.name + ".svg"},
                               {"data", figure.name + ".csv"},
                               {"script", figure.name + ".gp"}});
  }
  json["wall_seconds"] = outcome.wall_seconds;
  json["command"] = RerunCommand(outcome);
  return json;
}

}  // namespace

std::string JsonReport(const std::vector<Outcome>& outcomes,
                       const Environment& environment) {
  OrderedJson json;
  json["format"] = "emmy-report/1";
  json["pass"] =
      !outcomes.empty() && std::all_of(outcomes.begin(), outcomes.end(),
                                       [](const Outcome& o) { return o.pass; });
  json["level"] = outcomes.empty() ? "" : LevelName(outcomes[0].level);
  json["date"] = environment.date;
  json["wall_seconds"] = environment.wall_seconds;
  json["build"] = {{"version", environment.build.version},
                   {"compiler", environment.build.compiler},
                   {"flags", environment.build.flags}};
  json["machine"] = {{"processor", environment.processor},
                     {"system", environment.system},
                     {"threads", environment.threads}};
  json["command"] = environment.command;
  json["claims"] = OrderedJson::array();
  for (const Outcome& outcome : outcomes) {
    json["claims"].push_back(OutcomeJson(outcome));
  }
  return FormatJson(json);
}

}  // namespace emmy::verification
