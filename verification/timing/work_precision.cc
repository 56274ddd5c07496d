#include "verification/timing/work_precision.h"

#include <map>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/io/text_file.h"

namespace emmy::verification {
namespace {

// 1, 2, … in the order in which series come.
std::vector<double> SeriesNumbers(
    const std::vector<WorkPrecisionPoint>& points) {
  std::vector<double> numbers;
  for (size_t i = 0; i < points.size(); ++i) {
    const bool same = i > 0 &&
                      points[i].series.name == points[i - 1].series.name &&
                      points[i].series.order == points[i - 1].series.order;
    numbers.push_back(i == 0 ? 1.0 : numbers.back() + (same ? 0.0 : 1.0));
  }
  return numbers;
}

// Colour by name, point by order, so that both can be told apart.
std::string PlotCommand(const std::vector<WorkPrecisionPoint>& points,
                        const std::vector<double>& numbers) {
  std::map<std::string, int> colours;
  std::string plot;
  for (size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && numbers[i] == numbers[i - 1]) continue;
    const WorkPrecisionSeries& series = points[i].series;
    const int colour =
        colours.emplace(series.name, static_cast<int>(colours.size()) + 1)
            .first->second;
    const int point = series.order == 2 ? 7 : series.order == 4 ? 5 : 9;
    absl::StrAppendFormat(
        &plot,
        "%s data using ($1 == %d ? 1e6 * $4 : NaN):(floored($5)) with "
        "linespoints lt %d pt %d title '%s, order %d'",
        plot.empty() ? "plot" : ", \\\n    ", static_cast<int>(numbers[i]),
        colour, point, series.name, series.order);
  }
  return plot + "\n";
}

}  // namespace

Figure WorkPrecisionFigure(const std::vector<WorkPrecisionPoint>& points) {
  Figure figure;
  figure.name = "work_precision";
  figure.title = "Error at 10 s against processor time";
  std::vector<double> order;
  std::vector<double> step;
  std::vector<double> seconds;
  std::vector<double> error;
  for (const WorkPrecisionPoint& point : points) {
    order.push_back(point.series.order);
    step.push_back(point.time_step);
    seconds.push_back(point.seconds);
    error.push_back(point.error);
  }
  const std::vector<double> numbers = SeriesNumbers(points);
  figure.columns = {{"series", numbers},
                    {"order", order},
                    {"time step [s]", step},
                    {"processor time per simulated second [s]", seconds},
                    {"error of angular velocity at 10 s [rad/s]", error}};
  figure.height = 640;
  figure.powers_of_ten = true;
  // Zero has no logarithm; below round-off all is the same.
  figure.script = absl::StrCat(
      R"(set xlabel 'processor time per simulated second [µs]'
set ylabel 'error of ω at 10 s [rad/s]'
set key outside right top
floored(x) = x > 1e-17 ? x : 1e-17
)",
      PlotCommand(points, numbers));
  return figure;
}

std::string WorkPrecisionJson(const std::vector<WorkPrecisionPoint>& points) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const WorkPrecisionPoint& point : points) {
    list.push_back({{"method", point.series.name},
                    {"order", point.series.order},
                    {"time_step", point.time_step},
                    {"seconds_per_simulated_second", point.seconds},
                    {"omega_error", point.error}});
  }
  return list.dump(1) + "\n";
}

absl::Status WriteWorkPrecision(const std::vector<WorkPrecisionPoint>& points,
                                const std::string& directory) {
  absl::Status status =
      WriteTextFile(absl::StrCat(directory, "/work_precision.json"),
                    WorkPrecisionJson(points));
  if (!status.ok()) return status;
  return WriteFigure(WorkPrecisionFigure(points), directory);
}

}  // namespace emmy::verification
