// Random cases of valid structure, for round trips through the file format.

#ifndef EMMY_TESTS_IO_RANDOM_CASE_H_
#define EMMY_TESTS_IO_RANDOM_CASE_H_

#include <random>

#include "emmy/io/case.h"

namespace emmy {

// Uses every alternative of every variant; numbers of every magnitude a double
// has, with all their bits. Names are not resolved.
Case RandomCase(std::mt19937_64& random);

}  // namespace emmy

#endif  // EMMY_TESTS_IO_RANDOM_CASE_H_
