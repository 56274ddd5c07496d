#include "verification/parallel.h"

#include <algorithm>
#include <atomic>

#include "emmy/base/work_team.h"

namespace emmy::verification {

void ForEachInParallel(size_t count, int num_threads,
                       const std::function<void(size_t)>& work) {
  WorkTeam team(static_cast<size_t>(std::max(num_threads, 1)));
  std::atomic<size_t> next = 0;
  // Not the ranges of the team, which are for work of even length.
  team.Run(team.size(),
           [&](size_t /*member*/, size_t /*first*/, size_t /*last*/) {
             for (size_t i = next++; i < count; i = next++) work(i);
           });
}

}  // namespace emmy::verification
