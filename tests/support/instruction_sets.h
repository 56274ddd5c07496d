// Code that Highway compiled for several instruction sets, run with each.

#ifndef EMMY_TESTS_SUPPORT_INSTRUCTION_SETS_H_
#define EMMY_TESTS_SUPPORT_INSTRUCTION_SETS_H_

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>
#include <vector>

namespace emmy {

// 0: the best that this processor has, as without a choice.
inline void ChooseInstructionSet(int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

class InstructionSetTest : public ::testing::Test {
 protected:
  // Whatever the test chose.
  ~InstructionSetTest() override { ChooseInstructionSet(0); }

  // Those that this processor has. Where it can have two, one alone is a
  // failure: there would be nothing to compare. Every x86 processor of 64 bits
  // since 2006 has SSSE3 besides what the compiler takes for granted.
  static std::vector<int64_t> InstructionSets() {
    std::vector<int64_t> targets = hwy::SupportedAndGeneratedTargets();
#if defined(__x86_64__)
    EXPECT_GE(targets.size(), 2U);
#endif
    return targets;
  }
};

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_INSTRUCTION_SETS_H_
