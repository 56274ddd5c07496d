// Work of uneven length, shared among threads.

#ifndef EMMY_VERIFICATION_PARALLEL_H_
#define EMMY_VERIFICATION_PARALLEL_H_

#include <cstddef>
#include <functional>

namespace emmy::verification {

// Calls work(i) once for each i < count, on `num_threads` threads: whichever
// is done takes the next. Returns when all are.
void ForEachInParallel(size_t count, int num_threads,
                       const std::function<void(size_t)>& work);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_PARALLEL_H_
