#include "verification/reference/reference_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "emmy/io/text_file.h"
#include "verification/reference/artifact.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

ReferenceTable Sample() {
  ReferenceTable table;
  table.name = "sample";
  table.kind = "regression";
  table.source = "a test";
  table.command = "none";
  table.version = "1.2.3";
  table.compiler = "GNU 12";
  table.columns = {{"time", "s", 0.0}, {"x", "m", 1e-9}};
  table.rows = {{0.0, 1.0 / 3.0},
                {0.1, -0.0},
                {1e-300, std::numeric_limits<double>::denorm_min()}};
  return table;
}

std::string Write(const std::string& text) {
  std::string path = ::testing::TempDir() + "/reference_table_test.json";
  EXPECT_TRUE(WriteTextFile(path, text).ok());
  return path;
}

TEST(ReferenceTableTest, ReadsBackEveryBitAndTheProvenance) {
  const absl::StatusOr<ReferenceTable> read =
      ReadReference(Write(FormatReference(Sample())));
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_THAT(DescribeDifference(*read, Sample()), IsEmpty());
  EXPECT_EQ(read->compiler, "GNU 12");
  EXPECT_EQ(read->version, "1.2.3");
  EXPECT_EQ(read->columns[1].uncertainty, 1e-9);
}

TEST(ReferenceTableTest, ProvenanceIsNotADifference) {
  ReferenceTable other = Sample();
  other.compiler = "Clang 14";
  other.version = "9";
  EXPECT_THAT(DescribeDifference(Sample(), other), IsEmpty());
}

TEST(ReferenceTableTest, SaysWhichColumnDiffersAndByHowMuch) {
  ReferenceTable other = Sample();
  other.rows[0][1] += 1e-3;
  other.rows[2][1] += 2e-3;
  const std::string text = DescribeDifference(Sample(), other);
  EXPECT_THAT(text, HasSubstr("x: 2 of 3 numbers differ, most by 0.002 m in "
                              "row 2"));
}

TEST(ReferenceTableTest, OneUlpTheSignOfZeroAndNanAreDifferences) {
  for (const auto& [row, value] :
       {std::pair<size_t, double>{0, std::nextafter(1.0 / 3.0, 1.0)},
        {1, 0.0},
        {1, std::nan("")}}) {
    ReferenceTable other = Sample();
    other.rows[row][1] = value;
    EXPECT_THAT(DescribeDifference(Sample(), other), HasSubstr("x: 1 of 3"));
  }
}

TEST(ReferenceTableTest, AnotherShapeOrUnitIsADifference) {
  ReferenceTable shorter = Sample();
  shorter.rows.pop_back();
  EXPECT_THAT(DescribeDifference(Sample(), shorter), HasSubstr("2 rows"));
  ReferenceTable feet = Sample();
  feet.columns[1].unit = "ft";
  EXPECT_THAT(DescribeDifference(Sample(), feet), HasSubstr("x [ft]"));
}

TEST(ReferenceTableTest, ABadFileIsNamedWithItsFault) {
  EXPECT_THAT(ReadReference("/no/such/file.json").status().message(),
              HasSubstr("/no/such/file.json"));
  EXPECT_THAT(ReadReference(Write("{")).status().message(),
              HasSubstr("reference_table_test.json"));
  ReferenceTable ragged = Sample();
  ragged.rows[1].pop_back();
  EXPECT_THAT(ReadReference(Write(FormatReference(ragged))).status().message(),
              HasSubstr("/rows/1: must have 2 numbers, got 1"));
}

TEST(ArtifactTest, WritesWhatIsMissingAndThenHasNothingToSay) {
  const std::string root = ::testing::TempDir() + "/artifact_test";
  const Artifact* artifact = FindArtifact("paper_box_conventional");
  ASSERT_NE(artifact, nullptr);
  ASSERT_TRUE(artifact->write(root).ok());
  const absl::StatusOr<std::string> after = artifact->compare(root);
  ASSERT_TRUE(after.ok());
  EXPECT_THAT(*after, IsEmpty());
  // A stored file with other numbers is a difference.
  const std::string path = root + "/" + artifact->path;
  ReferenceTable table = *ReadReference(path);
  table.rows[20][5] += 1.0;
  ASSERT_TRUE(WriteTextFile(path, FormatReference(table)).ok());
  EXPECT_THAT(*artifact->compare(root), HasSubstr("most by 1 "));
}

TEST(ArtifactTest, MissingFileIsADifference) {
  const absl::StatusOr<std::string> missing =
      FindArtifact("paper_box_ancf")->compare("/no/such/root");
  ASSERT_TRUE(missing.ok());
  EXPECT_THAT(*missing, HasSubstr("paper_box_ancf.json"));
}

}  // namespace
}  // namespace emmy::verification
