// A case: a model, how to integrate it, and what to write. The content of a
// case file; docs/case_format.md says what each key means.

#ifndef EMMY_IO_CASE_H_
#define EMMY_IO_CASE_H_

#include <cstdint>
#include <optional>
#include <string>

#include "emmy/base/export.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/model/model_description.h"

namespace emmy {

// The integrator of a case.
enum class Method {
  kEnergyMomentum,  // EnergyMomentumIntegrator.
};

// How a case is integrated, and for how long.
struct IntegratorSettings {
  Method method = Method::kEnergyMomentum;  // There is no other.
  int order = 2;                            // 2, 4 or 6.
  double time_step = 0.0;                   // h [s], > 0.
  double duration = 0.0;                    // T [s], > 0.
  // Relative tolerance of the iteration, in (0, 1); without one it runs until
  // round-off stops it.
  std::optional<double> tolerance;
};

// What a case file says.
struct Case {
  std::string name;               // Stands in the summary.
  std::string purpose;            // One sentence.
  ModelDescription model;         // As BuildModel takes it.
  IntegratorSettings integrator;  // How, and for how long.
  int64_t output_every = 1;  // Steps from one written row to the next, >= 1.
};

// The largest number of steps a case may ask for, so that counting steps in
// double is exact.
inline constexpr double kMaxSteps = 9007199254740992.0;  // 2^53

// The smallest number of whole steps that reaches the duration,
//   N = ceil(T / h),
// where a quotient within 4 u of a whole number counts as that number (u =
// 2^-53): T, h and T / h are each rounded, and 0.3 s are three steps of 0.1 s.
// Needs 0 < T, 0 < h and T / h <= kMaxSteps.
EMMY_EXPORT int64_t NumberOfSteps(const IntegratorSettings& settings);

// What `settings` ask of the integrator; all else as it comes.
EMMY_EXPORT IntegratorOptions OptionsOf(const IntegratorSettings& settings,
                                        int num_threads = 1);

}  // namespace emmy

#endif  // EMMY_IO_CASE_H_
