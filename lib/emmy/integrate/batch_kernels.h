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
// done while a block is in the nearest cache.
void AdvanceBlock(const BatchStep& step, int64_t num_steps, AncfBlock* block,
                  LaneFallback* fallback);
void AdvanceBlock(const BatchStep& step, int64_t num_steps,
                  ConventionalBlock* block, LaneFallback* fallback);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_BATCH_KERNELS_H_
