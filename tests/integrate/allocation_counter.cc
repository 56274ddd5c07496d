#include "tests/integrate/allocation_counter.h"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {
std::atomic<int64_t> malloc_count = 0;
std::atomic<int64_t> new_count = 0;
}  // namespace

// The names that --wrap asks for.
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
void* __real_malloc(size_t size);
void* __real_calloc(size_t count, size_t size);
void* __real_realloc(void* pointer, size_t size);
void* __real_aligned_alloc(size_t alignment, size_t size);

void* __wrap_malloc(size_t size) {
  ++malloc_count;
  return __real_malloc(size);
}
void* __wrap_calloc(size_t count, size_t size) {
  ++malloc_count;
  return __real_calloc(count, size);
}
void* __wrap_realloc(void* pointer, size_t size) {
  ++malloc_count;
  return __real_realloc(pointer, size);
}
void* __wrap_aligned_alloc(size_t alignment, size_t size) {
  ++malloc_count;
  return __real_aligned_alloc(alignment, size);
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
}

void* operator new(size_t size) {
  ++new_count;
  if (void* pointer = __real_malloc(size)) return pointer;
  throw std::bad_alloc();
}
void operator delete(void* pointer) noexcept { std::free(pointer); }
void operator delete(void* pointer, size_t) noexcept { std::free(pointer); }

namespace emmy {

AllocationCount AllocationsSoFar() {
  return {.malloc = malloc_count, .new_ = new_count};
}

}  // namespace emmy
