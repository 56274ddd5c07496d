// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/integrate/batch_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/integrate/batch_kernels.cc"
// Vectors of a length unknown to the compiler cannot be members.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_RVV)
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "emmy/integrate/ancf_batch-inl.h"
#include "emmy/integrate/conventional_batch-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// The share of one step of `num_steps` in fetching `block`.
template <typename Block>
HWY_INLINE void Fetch(const Block* block, int64_t step, int64_t num_steps) {
  constexpr int64_t kLine = 64;
  constexpr int64_t kLines = (int64_t{sizeof(Block)} + kLine - 1) / kLine;
  const char* const start = reinterpret_cast<const char*>(block);
  const int64_t end = kLines * (step + 1) / num_steps;
  for (int64_t line = kLines * step / num_steps; line < end; ++line) {
    __builtin_prefetch(start + kLine * line, 1, 2);
  }
}

template <typename PackStep, typename Block>
HWY_INLINE void Advance(const BatchStep& step, int64_t num_steps, Block* block,
                        const Block* next, LaneFallback* fallback) {
  for (int lane = 0; lane < kBatchLanes; lane += kPackLanes) {
    PrepareCentre(step, lane, &block->centre);
  }
  for (int64_t i = 0; i < num_steps; ++i) {
    if (next != nullptr) Fetch(next, i, num_steps);
    for (int lane = 0; lane < kBatchLanes; lane += kPackLanes) {
      const Flag left = PackStep(step, lane, block).Advance();
      if (None(left)) continue;
      HWY_ALIGN double flags[kBatchLanes];
      Store(OrZero(left, Broadcast(1.0)), flags);
      for (int k = 0; k < kPackLanes; ++k) {
        if (flags[k] != 0.0) fallback->TakeStep(i, lane + k);
      }
    }
  }
}

void AdvanceAncf(const BatchStep& step, int64_t num_steps, AncfBlock* block,
                 const AncfBlock* next, LaneFallback* fallback) {
  Advance<AncfPackStep>(step, num_steps, block, next, fallback);
}
void AdvanceConventional(const BatchStep& step, int64_t num_steps,
                         ConventionalBlock* block,
                         const ConventionalBlock* next,
                         LaneFallback* fallback) {
  Advance<ConventionalPackStep>(step, num_steps, block, next, fallback);
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(AdvanceAncf);
HWY_EXPORT(AdvanceConventional);

void AdvanceBlock(const BatchStep& step, int64_t num_steps, AncfBlock* block,
                  const AncfBlock* next, LaneFallback* fallback) {
  HWY_DYNAMIC_DISPATCH(AdvanceAncf)(step, num_steps, block, next, fallback);
}
void AdvanceBlock(const BatchStep& step, int64_t num_steps,
                  ConventionalBlock* block, const ConventionalBlock* next,
                  LaneFallback* fallback) {
  HWY_DYNAMIC_DISPATCH(AdvanceConventional)
  (step, num_steps, block, next, fallback);
}

}  // namespace emmy
#endif  // HWY_ONCE
