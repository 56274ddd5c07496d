#include "verification/timing/growth_figure.h"

#include <string>
#include <vector>

#include "absl/strings/str_format.h"
#include "verification/timing/timing_report.h"

namespace emmy::verification {

Figure GrowthFigure(const TimingRun& run) {
  Figure figure;
  figure.name = "growth";
  figure.title = "Time of a step against size";
  std::vector<double> curve;
  std::vector<double> sizes;
  std::vector<double> times;
  std::string plot;
  int number = 0;
  for (const Growth& growth : Growths()) {
    ++number;
    bool is_measured = false;
    for (const auto& [size, name] : growth.sizes) {
      const Timing* const timing = run.Find(name);
      if (timing == nullptr) continue;
      is_measured = true;
      curve.push_back(number);
      sizes.push_back(size);
      times.push_back(1e-3 * timing->median);
    }
    if (!is_measured) continue;
    absl::StrAppendFormat(&plot,
                          "data using ($1 == %d ? $2 : NaN):3 with linespoints "
                          "lt %d pt 7 title '%s', \\\n    ",
                          number, number, growth.sentence);
  }
  figure.columns = {{"curve", curve},
                    {"nodes or boxes", sizes},
                    {"time of a step [us]", times}};
  figure.height = 640;
  figure.powers_of_ten = true;
  figure.script = absl::StrFormat(
      R"(set xlabel 'nodes or boxes'
set ylabel 'time of a step [µs]'
set key below left vertical maxrows 6
plot %s0.3*x with lines lc rgb 'gray' dt 2 title 'as the size'
)",
      plot);
  return figure;
}

}  // namespace emmy::verification
