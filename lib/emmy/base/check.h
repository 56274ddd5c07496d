// Stops the program, with the values at fault, on a caller's mistake.
//
// For mistakes of the program only. Bad input is an absl::Status, and a
// numerical outcome is a report.

#ifndef EMMY_BASE_CHECK_H_
#define EMMY_BASE_CHECK_H_

#include <sstream>
#include <string>

namespace emmy {

// Writes file, line, the condition and `values` to standard error; aborts.
[[noreturn]] void FailCheck(const char* file, int line, const char* condition,
                            const std::string& values);

}  // namespace emmy

// EMMY_CHECK(a.allFinite(), "a = " << a.transpose()) stops if `a` is not finite
// and shows it. `values` is a chain of <<, formatted only on failure.
#define EMMY_CHECK(condition, values)                     \
  do {                                                    \
    if (!(condition)) [[unlikely]] {                      \
      std::ostringstream emmy_check_stream;               \
      emmy_check_stream.precision(17);                    \
      emmy_check_stream << values; /* NOLINT: a chain. */ \
      ::emmy::FailCheck(__FILE__, __LINE__, #condition,   \
                        emmy_check_stream.str());         \
    }                                                     \
  } while (false)

#endif  // EMMY_BASE_CHECK_H_
