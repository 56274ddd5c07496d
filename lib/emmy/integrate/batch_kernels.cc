// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/integrate/batch_kernels.h"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/integrate/batch_kernels.cc"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "emmy/integrate/ancf_batch-inl.h"
#include "emmy/integrate/conventional_batch-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// Fetches a block while another is stepped, in parts until it is there.
template <typename Block>
class Fetch {
 public:
  HWY_INLINE Fetch(const Block* block, int64_t num_steps)
      : position_(reinterpret_cast<const char*>(block)),
        end_(block == nullptr ? position_ : position_ + sizeof(Block)),
        part_((int64_t{sizeof(Block)} / kLine + num_steps - 1) / num_steps) {}

  HWY_INLINE void FetchPart() {
    for (int64_t i = 0; i < part_ && position_ != end_; ++i) {
      __builtin_prefetch(position_, 1, 2);
      position_ += kLine;
    }
  }

 private:
  static constexpr int64_t kLine = 64;
  static_assert(sizeof(Block) % kLine == 0);

  const char* position_;
  const char* end_;
  int64_t part_;  // Lines.
};

// The step of the packs from `lane` on that are stepped together, if one round
// ends it in all their lanes; else nothing is changed. Without a loop, so that
// fewer of the numbers between Round and Commit leave the registers.
template <typename PackStep, typename Block>
HWY_INLINE bool StepInOneRound(const BatchStep& step, int lane, Block* block) {
  const PackStep pack(step, lane, block);
  typename PackStep::Increment increment;
  Pack size;
  const Flag done = And(Alive(block->centre, lane),
                        pack.Round(pack.Start(), &increment, &size));
  if constexpr (PackStep::kTogether == 1) {
    if (!All(done)) return false;
    pack.Commit(Writer<true>(done), increment);
  } else {
    static_assert(PackStep::kTogether == 2);
    const PackStep next(step, lane + kPackLanes, block);
    typename PackStep::Increment next_increment;
    const Flag next_done =
        And(Alive(block->centre, lane + kPackLanes),
            next.Round(next.Start(), &next_increment, &size));
    if (!All(And(done, next_done))) return false;
    pack.Commit(Writer<true>(done), increment);
    next.Commit(Writer<true>(next_done), next_increment);
  }
  return true;
}

template <typename PackStep, typename Block>
HWY_INLINE void Advance(const BatchStep& step, int64_t num_steps, Block* block,
                        const Block* next, LaneFallback* fallback) {
  if (num_steps == 0) return;
  constexpr int kGroupLanes = PackStep::kTogether * kPackLanes;
  static_assert(kBatchLanes % kGroupLanes == 0);
  for (int lane = 0; lane < kBatchLanes; lane += kPackLanes) {
    PrepareCentre(step, lane, &block->centre);
  }
  Fetch<Block> fetch(next, num_steps);
  int64_t steps_of_one_round[kBatchLanes] = {};  // By a group's first lane.
  for (int64_t i = 0; i < num_steps; ++i) {
    fetch.FetchPart();
    for (int first = 0; first < kBatchLanes; first += kGroupLanes) {
      bool& one_round = block->centre.one_round[first];
      if (one_round && StepInOneRound<PackStep>(step, first, block)) {
        ++steps_of_one_round[first];
        continue;
      }
      one_round = true;
      for (int lane = first; lane < first + kGroupLanes; lane += kPackLanes) {
        bool pack_one_round = false;
        const Flag left = Iterate(PackStep(step, lane, block), lane,
                                  &block->centre, &pack_one_round);
        one_round = one_round && pack_one_round;
        if (None(left)) continue;
        HWY_ALIGN double flags[kBatchLanes];
        Store(OrZero(left, Broadcast(1.0)), flags);
        for (int k = 0; k < kPackLanes; ++k) {
          if (flags[k] != 0.0) fallback->TakeStep(i, lane + k);
        }
      }
    }
  }
  for (int lane = 0; lane < kBatchLanes; lane += kPackLanes) {
    const int64_t steps = steps_of_one_round[lane / kGroupLanes * kGroupLanes];
    double* const iterations = block->centre.iterations + lane;
    Store(Load(iterations) +
              Broadcast(PackStep::kCorrections * static_cast<double>(steps)),
          iterations);
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
