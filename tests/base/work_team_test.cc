#include "emmy/base/work_team.h"

#include <gtest/gtest.h>

#include <vector>

namespace emmy {
namespace {

TEST(WorkTeamTest, EveryItemIsDoneOnceInEveryRun) {
  for (const size_t size : {1U, 2U, 3U, 8U}) {
    WorkTeam team(size);
    ASSERT_EQ(team.size(), size);
    for (const size_t count : {0U, 1U, 2U, 7U, 100U}) {
      std::vector<int> times(count, 0);
      std::vector<int> calls(size, 0);
      for (int run = 0; run < 50; ++run) {
        team.Run(count, [&](size_t member, size_t first, size_t last) {
          ++calls[member];
          for (size_t i = first; i < last; ++i) ++times[i];
        });
      }
      EXPECT_EQ(times, std::vector<int>(count, 50)) << size;
      EXPECT_EQ(calls, std::vector<int>(size, 50)) << size;
    }
  }
}

}  // namespace
}  // namespace emmy
