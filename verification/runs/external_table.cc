#include "verification/runs/external_table.h"

#include <nlohmann/json.hpp>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "emmy/io/case_file.h"
#include "verification/reference/json_file.h"
#include "verification/reference/project_directory.h"
#include "verification/runs/published_number.h"

namespace emmy::verification {
namespace {

using Json = nlohmann::json;

ExternalTable TableFromJson(const Json& json) {
  const Json& rows = json.at("rows");
  const auto num_rows = static_cast<Eigen::Index>(rows.size());
  const auto num_columns =
      static_cast<Eigen::Index>(json.at("columns").size()) - 1;
  ExternalTable table{.time = VectorXd(num_rows),
                      .values = MatrixXd(num_rows, num_columns)};
  for (Eigen::Index i = 0; i < num_rows; ++i) {
    const Json& row = rows.at(static_cast<size_t>(i));
    table.time(i) = PublishedNumber(row.at(0));
    for (Eigen::Index j = 0; j < num_columns; ++j) {
      table.values(i, j) = PublishedNumber(row.at(static_cast<size_t>(j) + 1));
    }
  }
  return table;
}

}  // namespace

absl::StatusOr<ExternalTable> ReadExternalTable(const std::string& name) {
  const std::string path = absl::StrCat(
      ProjectDirectory(), "/reference_data/external/", name, ".json");
  const absl::StatusOr<Json> json = ReadJsonFile(path);
  if (!json.ok()) return json.status();
  try {
    return TableFromJson(*json);
  } catch (const Json::exception& error) {
    return absl::DataLossError(absl::StrCat(path, ": ", error.what()));
  }
}

absl::StatusOr<ModelDescription> ReadExample(const std::string& name) {
  absl::StatusOr<Case> example = ReadCaseFile(
      absl::StrCat(ProjectDirectory(), "/examples/", name, ".json"));
  if (!example.ok()) return example.status();
  return std::move(example->model);
}

}  // namespace emmy::verification
