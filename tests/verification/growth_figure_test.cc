#include "verification/timing/growth_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace emmy::verification {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Timing Measured(const std::string& name, double median) {
  Timing timing;
  timing.name = name;
  timing.median = median;
  return timing;
}

TEST(GrowthFigureTest, DrawsWhatWasMeasuredInMicroseconds) {
  TimingRun run;
  run.timings = {Measured("chain/boxes:100", 3e4),
                 Measured("chain/boxes:1000", 3e5)};
  const Figure figure = GrowthFigure(run);
  EXPECT_THAT(figure.columns[1].values, ElementsAre(100.0, 1000.0));
  EXPECT_THAT(figure.columns[2].values, ElementsAre(30.0, 300.0));
  EXPECT_THAT(figure.script, HasSubstr("chain of joined boxes"));
  EXPECT_THAT(figure.script, Not(HasSubstr("tree of joined boxes")));
}

}  // namespace
}  // namespace emmy::verification
