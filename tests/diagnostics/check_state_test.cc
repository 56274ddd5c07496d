#include "emmy/diagnostics/check_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "emmy/model/model_builder.h"
#include "tests/support/paper_box.h"

namespace emmy {
namespace {

using ::testing::HasSubstr;

class CheckStateTest : public ::testing::Test {
 protected:
  std::string Message() const {
    return std::string(CheckState(built_.model, built_.state,
                                  MeasureInvariants(built_.model, built_.state))
                           .message());
  }

  BuiltModel built_ = BuildModel(ModelOf(PaperBox())).value();
};

TEST_F(CheckStateTest, AStartIsSound) { EXPECT_EQ(Message(), ""); }

TEST_F(CheckStateTest, EnergyIsFinite) {
  built_.state.velocity.value(3) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Message(), "energy or momentum is not finite");
}

// The mirror image has the same strains, zero, and the same energy.
TEST_F(CheckStateTest, ABodyIsNotInsideOut) {
  built_.state.position.value.segment<3>(3) *= -1.0;
  EXPECT_THAT(Message(), HasSubstr("body \"box\" has turned inside out: the "
                                   "determinant of its gradient vectors must "
                                   "be > 0, got -1;"));
}

TEST_F(CheckStateTest, ABodyIsNotFlat) {
  built_.state.position.value.segment<3>(3).setZero();
  EXPECT_THAT(Message(), HasSubstr("got 0;"));
}

}  // namespace
}  // namespace emmy
