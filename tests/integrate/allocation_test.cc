#include <gtest/gtest.h>

#include "emmy/model/model_builder.h"
#include "tests/integrate/allocation_counter.h"
#include "tests/support/paper_box.h"
#include "tests/support/test_run.h"

namespace emmy {
namespace {

ModelDescription ThreeBodies() {
  ModelDescription description = ModelOf(PaperBox());
  RigidBodyDescription body = PaperBox(Formulation::kConventional);
  body.name = "conventional";
  description.rigid_bodies.push_back(body);
  body = PaperBox(Formulation::kAncf, 1e4);
  body.name = "soft";
  description.rigid_bodies.push_back(body);
  return description;
}

// The counter works, inside the library too: building allocates both by
// Eigen (malloc) and by the standard library (new).
TEST(AllocationCounterTest, SeesWhatTheLibraryAllocates) {
  const ModelDescription description = ThreeBodies();
  const AllocationCount before = AllocationsSoFar();
  const auto built = BuildModel(description);
  const AllocationCount after = AllocationsSoFar();
  ASSERT_TRUE(built.ok());
  EXPECT_GT(after.malloc, before.malloc);
  EXPECT_GT(after.new_, before.new_);
}

class AllocationTest : public ::testing::TestWithParam<double> {};

TEST_P(AllocationTest, AStepThatConvergesAllocatesNothing) {
  for (const bool full_newton : {false, true}) {
    TestRun run(ThreeBodies(),
                IntegratorOptions{.time_step = GetParam(),
                                  .always_full_newton = full_newton});
    ExpectStepsAllocateNothing(run, 20);
  }
}

INSTANTIATE_TEST_SUITE_P(TimeSteps, AllocationTest,
                         ::testing::Values(1e-3, 0.1));

}  // namespace
}  // namespace emmy
