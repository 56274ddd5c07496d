// Steps of a block of bodies, with the instruction set chosen when the program
// runs. The bits are the same with every one that has fused multiply-add.

#ifndef EMMY_INTEGRATE_BATCH_KERNELS_H_
#define EMMY_INTEGRATE_BATCH_KERNELS_H_

#include <cstdint>

#include "emmy/integrate/batch_blocks.h"

namespace emmy {

// Takes the step of a lane for which the closed-form tangent was too slow, by
// other means, or marks the lane as no longer alive. `step` counts from 0 at
// the start of the call.
class LaneFallback {
 public:
  virtual ~LaneFallback() = default;
  virtual void TakeStep(int64_t step, int lane) = 0;
};

// Advances all lanes that are alive by `num_steps` steps. Several steps are
// done while a block is in the nearest cache, and `next`, if not null, is
// fetched meanwhile.
void AdvanceBlock(const BatchStep& step, int64_t num_steps, AncfBlock* block,
                  const AncfBlock* next, LaneFallback* fallback);
void AdvanceBlock(const BatchStep& step, int64_t num_steps,
                  ConventionalBlock* block, const ConventionalBlock* next,
                  LaneFallback* fallback);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_BATCH_KERNELS_H_
