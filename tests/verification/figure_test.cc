#include "verification/figures/figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "verification/registry.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;

std::string Text(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Figure Sample() {
  return {.name = "sample",
          .title = "A sample",
          .columns = {{"time [s]", {0.0, 0.1}}, {"x [m]", {1.0, 2.0}}},
          .script = "set xlabel 'Time [s]'\nplot data using 1:2 title 'x'\n",
          .width = 640,
          .height = 480};
}

TEST(FigureTest, CsvHasAHeaderAndReadsBackTheSameNumbers) {
  EXPECT_EQ(FigureCsv(Sample()),
            "time [s],x [m]\n0,1\n0.10000000000000001,2\n");
}

TEST(FigureTest, WritesDataScriptAndImage) {
  const std::filesystem::path directory =
      std::filesystem::path(::testing::TempDir()) / "emmy it's a figure";
  std::filesystem::create_directories(directory);
  const absl::Status status = WriteFigure(Sample(), directory.string());
  EXPECT_EQ(Text(directory / "sample.csv"), FigureCsv(Sample()));
  EXPECT_EQ(Text(directory / "sample.gp"), FigureScript(Sample()));
  if (absl::IsUnavailable(status)) GTEST_SKIP() << status;
  ASSERT_TRUE(status.ok()) << status;
  EXPECT_THAT(Text(directory / "sample.svg"), HasSubstr("Time [s]"));
}

TEST(FigureTest, PowersOfTenAreAskedForBeforeTheScript) {
  Figure figure = Sample();
  const std::string plain = FigureScript(figure);
  figure.powers_of_ten = true;
  const std::string preamble =
      plain.substr(0, plain.size() - figure.script.size());
  EXPECT_EQ(
      FigureScript(figure),
      preamble + "set logscale xy\nset format '10^{%T}'\n" + figure.script);
}

TEST(FigureTest, SaysSoIfItCannotBeDrawn) {
  Figure wrong = Sample();
  wrong.script = "plot no_such_variable\n";
  const absl::Status status = WriteFigure(wrong, ::testing::TempDir());
  EXPECT_TRUE(absl::IsUnavailable(status));
  EXPECT_THAT(status.message(), HasSubstr("sample.svg: not drawn"));
}

TEST(FigureTest, EveryFigureOfAClaimIsDrawn) {
  for (const char* id : {"figures/paper_5", "figures/paper_6",
                         "figures/energy_error", "order/conventional_body"}) {
    const Outcome outcome = RunClaim(*FindClaim(id), ClaimSetting());
    ASSERT_FALSE(outcome.result.figures.empty()) << id;
    for (const Figure& figure : outcome.result.figures) {
      const absl::Status status = WriteFigure(figure, ::testing::TempDir());
      // NOLINTNEXTLINE(cert-env33-c): a program of this name is meant.
      if (absl::IsUnavailable(status) && std::system("gnuplot -V") != 0) {
        GTEST_SKIP() << status;
      }
      EXPECT_TRUE(status.ok()) << status;
    }
  }
}

}  // namespace
}  // namespace emmy::verification
