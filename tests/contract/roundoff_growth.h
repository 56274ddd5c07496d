// The energy error of an ensemble of runs, and its growth law.

#ifndef EMMY_TESTS_CONTRACT_ROUNDOFF_GROWTH_H_
#define EMMY_TESTS_CONTRACT_ROUNDOFF_GROWTH_H_

#include <cstdint>
#include <vector>

#include "emmy/diagnostics/invariants.h"
#include "tests/support/growth_law.h"
#include "tests/support/paper_box.h"

namespace emmy {

// The paper's box with ω shifted by `index` units in the last place or so:
// the same motion, other roundings.
inline RigidBodyDescription ShiftedBox(Formulation formulation, double penalty,
                                       int index) {
  RigidBodyDescription box = PaperBox(formulation, penalty);
  box.angular_velocity *= 1.0 + index * 0x1p-50;
  return box;
}

// From 10³ on, half a decade apart.
inline std::vector<int64_t> NumbersOfSteps(int64_t last) {
  std::vector<int64_t> steps;
  for (const int64_t n : {1000, 3162, 10000, 31623, 100000, 316228, 1000000}) {
    if (n <= last) steps.push_back(n);
  }
  return steps;
}

// `make_run(index)` gives a run with model(), state() and Advance().
template <typename MakeRun>
GrowthLaw MeasureGrowth(const MakeRun& make_run, int64_t last_step,
                        int num_runs = 32) {
  const std::vector<int64_t> steps = NumbersOfSteps(last_step);
  std::vector<std::vector<double>> errors(steps.size());
  for (int index = 0; index < num_runs; ++index) {
    auto run = make_run(index);
    const DoubleDouble start =
        MeasureInvariants(run.model(), run.state()).TotalEnergy();
    int64_t done = 0;
    for (size_t k = 0; k < steps.size(); ++k) {
      if (!run.Advance(steps[k] - done)) return {};
      done = steps[k];
      const DoubleDouble energy =
          MeasureInvariants(run.model(), run.state()).TotalEnergy();
      errors[k].push_back((energy - start).ToDouble() / start.ToDouble());
    }
  }
  return FitGrowthLaw(steps, errors);
}

}  // namespace emmy

#endif  // EMMY_TESTS_CONTRACT_ROUNDOFF_GROWTH_H_
