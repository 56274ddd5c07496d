#include "emmy/model/state_size.h"

#include <gtest/gtest.h>

#include "emmy/model/model_builder.h"
#include "tests/support/structures.h"

namespace emmy {
namespace {

TEST(StateSizeTest, IsThatOfTheModel) {
  for (const Formulation formulation :
       {Formulation::kAncf, Formulation::kConventional}) {
    const BuiltModel built = BuildModel(BoxWithTruss(formulation)).value();
    EXPECT_EQ(SizeOf(built.state), SizeOf(built.model));
    EXPECT_GT(SizeOf(built.state).strain, 0);
  }
}

}  // namespace
}  // namespace emmy
