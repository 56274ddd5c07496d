// Counts the heap allocations of this program.
//
// The linker leads malloc, calloc, realloc and aligned_alloc of all objects
// and static libraries here (--wrap, see CMakeLists.txt), operator new is
// replaced. Calls from inside shared libraries are not seen.

#ifndef EMMY_TESTS_INTEGRATE_ALLOCATION_COUNTER_H_
#define EMMY_TESTS_INTEGRATE_ALLOCATION_COUNTER_H_

#include <cstdint>

namespace emmy {

struct AllocationCount {
  int64_t malloc = 0;  // Eigen's matrices of dynamic size.
  int64_t new_ = 0;    // Everything from the standard library.
};

AllocationCount AllocationsSoFar();

}  // namespace emmy

#endif  // EMMY_TESTS_INTEGRATE_ALLOCATION_COUNTER_H_
