// The largest models that `emmy generate` makes: label `slow`.

#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>

#include "absl/strings/str_cat.h"
#include "tests/cli/program.h"

namespace emmy {
namespace {

struct Largest {
  const char* model;
  int size;  // As `emmy generate --help` says.
  friend void PrintTo(const Largest& l, std::ostream* os) { *os << l.model; }
};

class LargestGeneratedTest : public ProgramTest,
                             public ::testing::WithParamInterface<Largest> {};

// 256 MiB is what `emmy run` reads (docs/case_format.md).
TEST_P(LargestGeneratedTest, IsNoLargerThanWhatIsRead) {
  const ProgramResult made =
      Run(absl::StrCat("generate ", GetParam().model, " --size ",
                       GetParam().size, " --output case.json"));
  ASSERT_EQ(made.exit_status, 0) << made.err;
  const ProgramResult counted = Shell("wc -c < case.json");
  EXPECT_LE(std::stoll(counted.out), int64_t{256} << 20);
  const ProgramResult next = Run(absl::StrCat("generate ", GetParam().model,
                                              " --size ", GetParam().size + 1));
  EXPECT_EQ(next.exit_status, 2);
}

INSTANTIATE_TEST_SUITE_P(
    Models, LargestGeneratedTest,
    ::testing::Values(Largest{"net", 450}, Largest{"cable_net", 450},
                      Largest{"chain", 400000},
                      Largest{"conventional_chain", 400000},
                      Largest{"trussed_boxes", 150000}),
    [](const auto& largest) { return std::string(largest.param.model); });

}  // namespace
}  // namespace emmy
