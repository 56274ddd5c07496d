#include "verification/reference/reference_table.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/io/json_text.h"
#include "verification/reference/json_file.h"

namespace emmy::verification {
namespace {

constexpr char kFormat[] = "emmy-reference/1";

bool SameBits(double a, double b) {
  uint64_t bits_a = 0;
  uint64_t bits_b = 0;
  std::memcpy(&bits_a, &a, sizeof(a));
  std::memcpy(&bits_b, &b, sizeof(b));
  return bits_a == bits_b;
}

ReferenceTable TableFromJson(const nlohmann::json& json) {
  ReferenceTable table;
  table.name = json.at("name").get<std::string>();
  table.kind = json.at("kind").get<std::string>();
  table.source = json.at("source").get<std::string>();
  table.command = json.at("command").get<std::string>();
  table.version = json.at("version").get<std::string>();
  table.compiler = json.at("compiler").get<std::string>();
  for (const nlohmann::json& column : json.at("columns")) {
    table.columns.push_back(
        {.name = column.at("name").get<std::string>(),
         .unit = column.at("unit").get<std::string>(),
         .uncertainty = column.at("uncertainty").get<double>()});
  }
  for (const nlohmann::json& row : json.at("rows")) {
    table.rows.push_back(row.get<std::vector<double>>());
  }
  return table;
}

absl::Status CheckShape(const nlohmann::json& json,
                        const ReferenceTable& table) {
  if (json.at("format") != kFormat) {
    return absl::DataLossError(
        absl::StrCat("/format: must be \"", kFormat, "\""));
  }
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (table.rows[i].size() != table.columns.size()) {
      return absl::DataLossError(
          absl::StrCat("/rows/", i, ": must have ", table.columns.size(),
                       " numbers, got ", table.rows[i].size()));
    }
  }
  return absl::OkStatus();
}

}  // namespace

std::string FormatReference(const ReferenceTable& table) {
  nlohmann::ordered_json json;
  json["format"] = kFormat;
  json["name"] = table.name;
  json["kind"] = table.kind;
  json["source"] = table.source;
  json["command"] = table.command;
  json["version"] = table.version;
  json["compiler"] = table.compiler;
  json["columns"] = nlohmann::ordered_json::array();
  for (const ReferenceColumn& column : table.columns) {
    json["columns"].push_back({{"name", column.name},
                               {"unit", column.unit},
                               {"uncertainty", column.uncertainty}});
  }
  json["rows"] = table.rows;
  return FormatJson(json);
}

absl::StatusOr<ReferenceTable> ReadReference(const std::string& path) {
  const absl::StatusOr<nlohmann::json> json = ReadJsonFile(path);
  if (!json.ok()) return json.status();
  try {
    ReferenceTable table = TableFromJson(*json);
    const absl::Status status = CheckShape(*json, table);
    if (!status.ok()) {
      return absl::DataLossError(absl::StrCat(path, ": ", status.message()));
    }
    return table;
  } catch (const nlohmann::json::exception& error) {
    return absl::DataLossError(absl::StrCat(path, ": ", error.what()));
  }
}

std::string DescribeDifference(const ReferenceTable& stored,
                               const ReferenceTable& computed) {
  if (stored.columns.size() != computed.columns.size() ||
      stored.rows.size() != computed.rows.size()) {
    return absl::StrFormat(
        "shape: %d rows of %d columns stored, %d rows of %d columns computed\n",
        stored.rows.size(), stored.columns.size(), computed.rows.size(),
        computed.columns.size());
  }
  std::string text;
  for (size_t c = 0; c < stored.columns.size(); ++c) {
    const ReferenceColumn& column = stored.columns[c];
    if (column.name != computed.columns[c].name ||
        column.unit != computed.columns[c].unit) {
      absl::StrAppendFormat(&text, "column %d: %s [%s] stored, %s [%s] now\n",
                            c, column.name, column.unit,
                            computed.columns[c].name, computed.columns[c].unit);
      continue;
    }
    size_t count = 0;
    size_t worst_row = 0;
    double worst = 0.0;
    for (size_t r = 0; r < stored.rows.size(); ++r) {
      const double old_value = stored.rows[r][c];
      const double new_value = computed.rows[r][c];
      if (SameBits(old_value, new_value)) continue;
      const double difference = std::abs(new_value - old_value);
      // The first is taken whatever it is, a NaN is kept.
      if (count == 0 || (!std::isnan(worst) && !(difference <= worst))) {
        worst = difference;
        worst_row = r;
      }
      ++count;
    }
    if (count == 0) continue;
    absl::StrAppendFormat(
        &text,
        "%s: %d of %d numbers differ, most by %.3g %s in row %d: %.17g stored, "
        "%.17g computed\n",
        column.name, count, stored.rows.size(), worst, column.unit, worst_row,
        stored.rows[worst_row][c], computed.rows[worst_row][c]);
  }
  return text;
}

}  // namespace emmy::verification
