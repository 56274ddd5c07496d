#include "verification/timing/work_precision.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace emmy::verification {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<WorkPrecisionPoint> Points() {
  return {{{"a", 2}, 0.2, 1e-6, 1e-2},
          {{"a", 2}, 0.1, 2e-6, 2.5e-3},
          {{"a", 4}, 0.1, 6e-6, 1e-5}};
}

TEST(WorkPrecisionTest, CountsSeriesByNameAndOrder) {
  EXPECT_THAT(WorkPrecisionFigure(Points()).columns[0].values,
              ElementsAre(1.0, 1.0, 2.0));
}

TEST(WorkPrecisionTest, WritesEveryPointAsJson) {
  EXPECT_THAT(WorkPrecisionJson(Points()),
              HasSubstr("\"omega_error\": 0.0025"));
}

}  // namespace
}  // namespace emmy::verification
