#include "emmy/base/work_team.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
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

// The others end their work before it is thrown on; the team works on.
TEST(WorkTeamTest, WhatAMemberThrowsComesToTheCallerWhenAllAreDone) {
  WorkTeam team(4);
  for (const size_t thrower : {0U, 3U}) {
    std::vector<int> times(4000, 0);
    const auto work = [&](size_t member, size_t first, size_t last) {
      if (member == thrower) throw std::runtime_error("full");
      for (size_t i = first; i < last; ++i) ++times[i];
    };
    EXPECT_THROW(team.Run(times.size(), work), std::runtime_error);
    std::vector<int> expected(4000, 1);
    std::fill_n(expected.begin() + 1000 * static_cast<int>(thrower), 1000, 0);
    EXPECT_EQ(times, expected) << thrower;
    team.Run(times.size(), [&](size_t, size_t first, size_t last) {
      for (size_t i = first; i < last; ++i) times[i] = 7;
    });
    EXPECT_EQ(times, std::vector<int>(4000, 7));
  }
}

}  // namespace
}  // namespace emmy
