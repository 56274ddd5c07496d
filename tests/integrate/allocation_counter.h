// Counts the heap allocations of this program.
//
// The linker leads malloc, calloc, realloc and aligned_alloc of all objects
// and static libraries here (--wrap, see CMakeLists.txt), operator new is
// replaced. Calls from inside shared libraries are not seen.

#ifndef EMMY_TESTS_INTEGRATE_ALLOCATION_COUNTER_H_
#define EMMY_TESTS_INTEGRATE_ALLOCATION_COUNTER_H_

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/support/test_run.h"

namespace emmy {

struct AllocationCount {
  int64_t malloc = 0;  // Eigen's matrices of dynamic size.
  int64_t new_ = 0;    // Everything from the standard library.
};

AllocationCount AllocationsSoFar();

// All steps have to converge.
inline void ExpectStepsAllocateNothing(TestRun& run, int num_steps) {
  bool ok = true;
  const AllocationCount before = AllocationsSoFar();
  for (int i = 0; i < num_steps; ++i) ok = run.Step().ok() && ok;
  const AllocationCount after = AllocationsSoFar();
  EXPECT_TRUE(ok);
  EXPECT_EQ(after.malloc, before.malloc);
  EXPECT_EQ(after.new_, before.new_);
}

}  // namespace emmy

#endif  // EMMY_TESTS_INTEGRATE_ALLOCATION_COUNTER_H_
