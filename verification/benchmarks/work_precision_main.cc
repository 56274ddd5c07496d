// emmy_work_precision: what a digit costs. The paper's box, both formulations,
// orders two, four and six, several steps: error of the angular velocity at
// 10 s against the closed-form motion, and processor time per simulated second.

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

#include "verification/benchmarks/runge_kutta_body.h"
#include "verification/runs/motion_error.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"
#include "verification/timing/work_precision.h"

namespace emmy::verification {
namespace {

constexpr double kDuration = 10.0;  // [s]

// So stiff that the penalty's part of the error is below all others: as in the
// claims composition/ancf_order_6.
constexpr double kStiffPenalty = 1e17;  // [Pa]
constexpr double kPaperPenalty = 1e10;

double ProcessorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec);
}

// Of `run`, which simulates kDuration; median of `repetitions`, each of as many
// runs as take a hundredth of a second.
template <typename Function>
double SecondsPerSecond(int repetitions, const Function& run) {
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const double start = ProcessorSeconds();
    int runs = 0;
    double elapsed = 0.0;
    do {
      run();
      ++runs;
      elapsed = ProcessorSeconds() - start;
    } while (elapsed < 0.01);
    times.push_back(elapsed / (runs * kDuration));
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

struct Curve {
  WorkPrecisionSeries series;
  ModelDescription description;
  int order = 2;
};

std::vector<Curve> Curves() {
  std::vector<Curve> curves;
  for (const int order : {2, 4, 6}) {
    curves.push_back({{"conventional", order}, PaperBoxConventional(), order});
  }
  for (const int order : {2, 4, 6}) {
    curves.push_back({{"ANCF, 1e17 Pa", order},
                      PaperBoxAncf(kStiffPenalty, Start::kRelaxed),
                      order});
  }
  curves.push_back(
      {{"ANCF, 1e10 Pa", 2}, PaperBoxAncf(kPaperPenalty, Start::kRelaxed), 2});
  return curves;
}

// From coarse to fine: 0.2 s halved down to 0.39, 1.6 and 6.3 ms for orders
// two, four and six.
std::vector<double> StepsOf(int order) {
  std::vector<double> steps;
  const int halvings = order == 2 ? 9 : order == 4 ? 7 : 5;
  for (int i = 0; i <= halvings; ++i) steps.push_back(std::ldexp(0.2, -i));
  return steps;
}

absl::StatusOr<std::vector<WorkPrecisionPoint>> MeasureCurve(
    const Curve& curve, const BodyMotion& truth, int repetitions) {
  std::vector<WorkPrecisionPoint> points;
  for (const double time_step : StepsOf(curve.order)) {
    const auto num_steps =
        static_cast<int64_t>(std::lround(kDuration / time_step));
    IntegratorOptions options;
    options.order = curve.order;
    options.time_step = time_step;
    absl::Status failed;
    Vector3d omega = Vector3d::Zero();
    const double seconds = SecondsPerSecond(repetitions, [&] {
      absl::StatusOr<Run> run =
          Run::Start(curve.description, options, EnergyMomentumScheme);
      if (!run.ok()) {
        failed = run.status();
        return;
      }
      const absl::Status status = run->Advance(num_steps);
      if (!status.ok()) failed = status;
      omega = run->Motion().omega_locked;
    });
    if (!failed.ok()) return failed;
    points.push_back({curve.series, time_step, seconds,
                      (omega - truth.omega_locked).cwiseAbs().maxCoeff()});
  }
  return points;
}

std::vector<WorkPrecisionPoint> MeasureRungeKutta(const BodyMotion& truth,
                                                  int repetitions) {
  std::vector<WorkPrecisionPoint> points;
  for (const double time_step : StepsOf(4)) {
    const auto num_steps =
        static_cast<int64_t>(std::lround(kDuration / time_step));
    Vector3d omega = Vector3d::Zero();
    const double seconds = SecondsPerSecond(repetitions, [&] {
      RungeKuttaBody body({6750.0, 13500.0, 17550.0}, {0.3, 0.5, 0.8});
      for (int64_t i = 0; i < num_steps; ++i) body.Step(time_step);
      const auto& q = body.quaternion();
      const auto& w = body.angular_velocity();
      omega = Eigen::Quaterniond(q[0], q[1], q[2], q[3]) *
              Vector3d(w[0], w[1], w[2]);
    });
    points.push_back({{"Runge-Kutta", 4},
                      time_step,
                      seconds,
                      (omega - truth.omega_locked).cwiseAbs().maxCoeff()});
  }
  return points;
}

int Measure(const std::string& output, int repetitions) {
  const absl::StatusOr<std::vector<BodyMotion>> truth =
      ExactMotion({.interval = kDuration, .duration = kDuration});
  if (!truth.ok()) {
    std::cerr << truth.status().message() << '\n';
    return 1;
  }
  std::vector<WorkPrecisionPoint> points =
      MeasureRungeKutta(truth->back(), repetitions);
  for (const Curve& curve : Curves()) {
    const absl::StatusOr<std::vector<WorkPrecisionPoint>> measured =
        MeasureCurve(curve, truth->back(), repetitions);
    if (!measured.ok()) {
      std::cerr << curve.series.name << ", order " << curve.order << ": "
                << measured.status().message() << '\n';
      return 1;
    }
    points.insert(points.end(), measured->begin(), measured->end());
  }
  std::error_code error;
  std::filesystem::create_directories(output, error);
  const absl::Status written = WriteWorkPrecision(points, output);
  if (!written.ok()) std::cerr << written.message() << '\n';
  // Without gnuplot the data are there all the same.
  return written.ok() || written.code() == absl::StatusCode::kUnavailable ? 0
                                                                          : 1;
}

}  // namespace
}  // namespace emmy::verification

int main(int argc, char** argv) {
  CLI::App app(
      "Measures error at 10 s against processor time per simulated second for "
      "the paper's box, and draws it: work_precision.csv, .json and .svg.");
  std::string output = ".";
  int repetitions = 5;
  app.add_option("--output", output, "Directory to write to")->type_name("DIR");
  app.add_option("--repetitions", repetitions, "Of which the median counts")
      ->check(CLI::PositiveNumber);
  app.footer("Exit status: 0 measured and written; 1 not.");
  CLI11_PARSE(app, argc, argv);
  return emmy::verification::Measure(output, repetitions);
}
