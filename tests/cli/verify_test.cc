// emmy verify and emmy regenerate, as a user types them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cli/program.h"
#include "tests/support/schema_checker.h"

namespace emmy {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class VerifyTest : public ProgramTest {};
class RegenerateTest : public ProgramTest {};

TEST_F(VerifyTest, ListsTheClaimsAndMeasuresNothing) {
  const ProgramResult result = Run("verify --list");
  EXPECT_EQ(result.exit_status, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("conservation/energy"),
                                HasSubstr("order/ancf_body")));
  EXPECT_THAT(result.out, Not(HasSubstr("margin")));
}

TEST_F(VerifyTest, RunsOneClaimAndSaysThatItHolds) {
  const ProgramResult result = Run("verify --only external/positions");
  EXPECT_EQ(result.exit_status, 0) << result.out;
  EXPECT_THAT(result.out, AllOf(HasSubstr("external/positions"),
                                HasSubstr("1 of 1 claims hold (quick level)")));
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(VerifyTest, IsTheSameEveryTime) {
  const std::string command =
      "verify --only figures/paper_6 --only external/positions";
  EXPECT_EQ(Run(command).out, Run(command).out);
}

TEST_F(VerifyTest, UnknownClaimIsBadInputAndTheClaimsAreListed) {
  const ProgramResult result = Run("verify --only no/such --output out");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("there is no claim \"no/such\""),
                                HasSubstr("conservation/energy")));
  EXPECT_THAT(Files(), IsEmpty());
}

TEST_F(VerifyTest, UnknownLevelIsBadInput) {
  EXPECT_EQ(Run("verify --level slow").exit_status, 2);
}

TEST_F(VerifyTest, WritesReportAndFigures) {
  const ProgramResult result =
      Run("verify --only figures/paper_6 --output out/report");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  const auto report = nlohmann::json::parse(Read("out/report/report.json"));
  EXPECT_EQ(report.at("pass"), true);
  EXPECT_EQ(report.at("claims").at(0).at("id"), "figures/paper_6");
  EXPECT_EQ(report.at("command"),
            "emmy verify --only figures/paper_6 --output out/report");
  EXPECT_GT(report.at("claims").at(0).at("wall_seconds"), 0.0);
  EXPECT_THAT(Read("out/report/index.html"), HasSubstr("All 1 claims hold"));
  EXPECT_THAT(Read("out/report/junit.xml"), HasSubstr("failures=\"0\""));
  EXPECT_THAT(Read("out/report/paper_figure_6.csv"), HasSubstr("time [s]"));
  EXPECT_THAT(Read("out/report/paper_figure_6.gp"), HasSubstr("plot data"));
}

TEST_F(VerifyTest, ReportIsValidByItsSchema) {
  EXPECT_EQ(Run("verify --only figures/paper_6 --only penalty/locked_error "
                "--output out")
                .exit_status,
            0);
  const auto schema = nlohmann::json::parse(
      std::ifstream(EMMY_SOURCE_DIR "/verification/report/report.schema.json"));
  EXPECT_TRUE(SchemaChecker(schema).IsValid(
      nlohmann::json::parse(Read("out/report.json"))));
}

// A pendulum under a gravity that is not the published one: the claim fails.
TEST_F(VerifyTest, ClaimThatFailsIsSaidEverywhereAndIsTheExitStatus) {
  const ProgramResult result = Shell(
      "cp -r '" EMMY_SOURCE_DIR "/reference_data' '" EMMY_SOURCE_DIR
      "/examples' . && sed -i s/-9.81/-9.82/ examples/simple_pendulum.json && "
      "EMMY_PROJECT_DIRECTORY=. \"$EMMY\" verify "
      "--only external/pendulum_phase --only external/positions --output out");
  EXPECT_EQ(result.exit_status, 1) << result.err;
  const std::string command =
      "emmy verify --only external/pendulum_phase --level quick";
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("FAILED external/pendulum_phase"),
                    HasSubstr("1 of 2 claims hold"), HasSubstr(command)));
  const auto report = nlohmann::json::parse(Read("out/report.json"));
  EXPECT_EQ(report.at("pass"), false);
  const auto& values = report.at("claims").at(1).at("values");
  EXPECT_NEAR(values.at(0).at("value").get<double>(),
              1.0 - std::sqrt(9.81 / 9.82), 1e-7);
  EXPECT_THAT(Read("out/index.html"),
              AllOf(HasSubstr("verdict red"), HasSubstr("1 of 2 claims failed"),
                    HasSubstr("id=\"failures\""), HasSubstr(command),
                    HasSubstr("<data value=\"2.9999999999999997e-08\"")));
  EXPECT_THAT(Read("out/junit.xml"),
              AllOf(HasSubstr("failures=\"1\""), HasSubstr(command)));
}

// Or it would write on into a pipe that nobody reads.
TEST_F(VerifyTest, GnuplotIsStartedWithSigpipeAsUsual) {
  Write("gnuplot", "#!/bin/sh\ngrep SigIgn: /proc/$$/status >\"$SEEN\"\n");
  Shell(
      "chmod +x gnuplot; SEEN=\"$PWD/seen\" PATH=\"$PWD:$PATH\" \"$EMMY\" "
      "verify --only figures/paper_6 --output out");
  const std::string seen = Read("seen");
  ASSERT_GT(seen.size(), std::string("SigIgn:").size());
  const auto ignored =
      std::stoull(seen.substr(std::string("SigIgn:").size()), nullptr, 16);
  EXPECT_EQ(ignored >> (SIGPIPE - 1) & 1U, 0u) << seen;
}

TEST_F(VerifyTest, WithoutGnuplotThereIsAPageAllTheSame) {
  const ProgramResult result =
      Shell("PATH=none; \"$EMMY\" verify --only figures/paper_6 --output out");
  EXPECT_EQ(result.exit_status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("paper_figure_6.svg: not drawn"));
  EXPECT_THAT(Read("out/index.html"), HasSubstr("Not drawn"));
}

TEST_F(RegenerateTest, CheckFindsTheStoredDataCurrent) {
  const ProgramResult result = Run(
      "regenerate --check --only paper_box_ancf --only paper_box_conventional");
  EXPECT_EQ(result.exit_status, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("paper_box_ancf.json: current"));
}

TEST_F(RegenerateTest, CheckWritesNothingAndSaysWhatWouldChange) {
  const ProgramResult result = Shell(
      "EMMY_PROJECT_DIRECTORY=. \"$EMMY\" regenerate --check "
      "--only paper_box_ancf");
  EXPECT_EQ(result.exit_status, 1);
  EXPECT_THAT(result.out, HasSubstr("paper_box_ancf.json: would change"));
  EXPECT_THAT(Files(), IsEmpty());
}

TEST_F(RegenerateTest, WritesBelowTheProjectAndThenIsCurrent) {
  const std::string command =
      "EMMY_PROJECT_DIRECTORY=. \"$EMMY\" regenerate "
      "--only paper_box_conventional";
  EXPECT_THAT(Shell(command).out, HasSubstr("written"));
  EXPECT_THAT(Shell(command).out, HasSubstr("current"));
  EXPECT_THAT(Files(), Contains("reference_data"));
}

TEST_F(RegenerateTest, UnknownNameIsBadInputAndTheNamesAreListed) {
  const ProgramResult result = Run("regenerate --only no_such");
  EXPECT_EQ(result.exit_status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("there is no \"no_such\""),
                                HasSubstr("paper_box_ancf")));
}

}  // namespace
}  // namespace emmy
