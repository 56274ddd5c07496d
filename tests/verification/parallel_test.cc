#include "verification/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace emmy::verification {
namespace {

TEST(ForEachInParallelTest, DoesEachOnceWhateverTheNumberOfThreads) {
  for (const int num_threads : {0, 1, 2, 8}) {
    for (const size_t count : {size_t{0}, size_t{1}, size_t{100}}) {
      std::vector<std::atomic<int>> times(count);
      ForEachInParallel(count, num_threads, [&](size_t i) { ++times[i]; });
      for (const std::atomic<int>& n : times) EXPECT_EQ(n, 1) << num_threads;
    }
  }
}

}  // namespace
}  // namespace emmy::verification
