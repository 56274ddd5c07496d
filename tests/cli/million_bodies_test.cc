// A case of a million bodies: label `slow`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/str_cat.h"
#include "tests/cli/program.h"

namespace emmy {
namespace {

constexpr int kBodies = 1000000;

class MillionBodiesTest : public ProgramTest {
 protected:
  // Boxes in a row that turn, the last one `last_size` m wide; 110 MB.
  void WriteCaseWith(const std::string& last_size) const {
    std::string text =
        R"({"format": "emmy-case/1", "name": "many", "rigid_bodies": [)";
    for (int i = 0; i < kBodies; ++i) {
      absl::StrAppend(&text, i > 0 ? ",\n" : "\n", R"({"name": "b)", i,
                      R"(", "box": {"size": [1, 1, )",
                      i + 1 < kBodies ? "1" : last_size,
                      R"(], "density": 1}, "penalty": 1e6, "position": [)",
                      2 * i, R"(, 0, 0], "angular_velocity": [0, 1, 0]})");
    }
    absl::StrAppend(&text, R"(], "integrator": {"method": "energy_momentum", )"
                           R"("time_step": 1e-3, "duration": 2e-3}})");
    Write("many.json", text);
  }

  // Text, JSON tree, description, model, integrator and state take about 4 kB
  // a body; with twice that the program may not ask for more than it needs.
  // Sanitizers reserve address space of their own.
  ProgramResult RunWithin8GiB() const {
    const char* const limit =
        Shell("ulimit -v 8388608; \"$EMMY\" --version").exit_status == 0
            ? "ulimit -v 8388608; "
            : "";
    return Shell(absl::StrCat(limit, "\"$EMMY\" run many.json --quiet"));
  }
};

TEST_F(MillionBodiesTest, AreReadAndStepped) {
  WriteCaseWith("1");
  const ProgramResult result = RunWithin8GiB();
  ASSERT_EQ(result.exit_status, 0) << result.err;
  const nlohmann::json summary = nlohmann::json::parse(result.out);
  EXPECT_EQ(summary["status"], "completed");
  EXPECT_EQ(summary["steps"], 2);
  EXPECT_EQ(summary["degrees_of_freedom"], 12 * kBodies);
  // A body's energy is kept to some roundings, and sums are compensated.
  EXPECT_LE(summary["invariants"]["energy"]["max_relative_error"], 1e-15);
}

TEST_F(MillionBodiesTest, TheLastIsNamedIfItIsAtFault) {
  WriteCaseWith("0");
  const ProgramResult result = RunWithin8GiB();
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_EQ(result.err,
            "many.json: /rigid_bodies/999999/box/size/2: must be a finite "
            "number > 0 [m], got 0\n");
}

}  // namespace
}  // namespace emmy
