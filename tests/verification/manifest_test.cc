#include "verification/reference/manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "emmy/io/text_file.h"
#include "verification/reference/project_directory.h"

namespace emmy::verification {
namespace {

using ::testing::HasSubstr;

// What git itself says: printf 'hello\n' | git hash-object --stdin.
TEST(GitBlobHashTest, IsTheHashThatGitPrints) {
  EXPECT_EQ(GitBlobHash("hello\n"), "ce013625030ba8dba906f756967f9e9ca394464a");
  EXPECT_EQ(GitBlobHash(""), "e69de29bb2d1d6434b8b29ae775ad8c2e48c5391");
}

class ManifestTest : public ::testing::Test {
 protected:
  ManifestTest() {
    std::filesystem::remove_all(root_);
    std::filesystem::create_directories(root_ + "/reference_data/external");
  }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(root_ + "/reference_data/" + name) << text;
  }
  std::string Make() const {
    const absl::StatusOr<std::string> manifest = MakeManifest(root_);
    return manifest.ok() ? *manifest : std::string(manifest.status().message());
  }

  const std::string root_ =
      ::testing::TempDir() + "emmy_manifest_" +
      ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::string data_ =
      R"({"kind": "published", "source": {"published": "A book"},
          "command": "emmy verify"})";
};

TEST_F(ManifestTest, SaysWhatEachFileIsAndWhereItIsFrom) {
  Write("external/a.json", data_);
  const std::string manifest = Make();
  EXPECT_THAT(manifest, HasSubstr("\"reference_data/external/a.json\""));
  EXPECT_THAT(manifest, HasSubstr("\"A book\""));
  EXPECT_THAT(manifest, HasSubstr(GitBlobHash(data_)));
}

TEST_F(ManifestTest, AFileWithoutASourceIsAnErrorThatNamesIt) {
  Write("b.json", R"({"kind": "regression", "command": "x"})");
  EXPECT_EQ(Make(), "reference_data/b.json: /source: expected a text");
}

TEST_F(ManifestTest, NamesFilesThatChangedCameOrWent) {
  Write("a.json", data_);
  Write("b.json", data_);
  const std::string before = Make();
  EXPECT_EQ(DescribeManifestDifference(before, before), "");
  Write("a.json", data_ + "\n");
  std::filesystem::remove(root_ + "/reference_data/b.json");
  Write("c.json", data_);
  const std::string text = DescribeManifestDifference(before, Make());
  EXPECT_THAT(text, HasSubstr("reference_data/a.json: changed"));
  EXPECT_THAT(text, HasSubstr("reference_data/b.json: is gone"));
  EXPECT_THAT(text, HasSubstr("reference_data/c.json: not in the manifest"));
}

// Published data are not computed: only the hash says that nobody touched
// them.
TEST(StoredManifestTest, IsThatOfTheStoredData) {
  const std::string root = ProjectDirectory();
  const absl::StatusOr<std::string> now = MakeManifest(root);
  ASSERT_TRUE(now.ok()) << now.status();
  const absl::StatusOr<std::string> stored =
      ReadTextFile(root + "/reference_data/manifest.json", size_t{1} << 20);
  ASSERT_TRUE(stored.ok()) << stored.status();
  EXPECT_EQ(DescribeManifestDifference(*stored, *now), "")
      << "if that is intended: emmy regenerate --only manifest";
}

}  // namespace
}  // namespace emmy::verification
