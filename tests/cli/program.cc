#include "tests/cli/program.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace emmy {
namespace {

namespace fs = std::filesystem;

std::string ReadAll(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  EXPECT_TRUE(in.good()) << path;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

const char kBoxCase[] = R"({
  "format": "emmy-case/1",
  "name": "box",
  "rigid_bodies": [
    {
      "name": "box",
      "box": {"size": [3, 2, 1], "density": 2700},
      "penalty": 1e10,
      "orientation": {"quaternion": [1, 0, 0, 0]},
      "angular_velocity": [0.3, 0.5, 0.8]
    }
  ],
  "integrator": {
    "method": "energy_momentum",
    "time_step": 1e-3,
    "duration": 1e-2
  }
})";

ProgramTest::ProgramTest() {
  std::string pattern = ::testing::TempDir() + "emmy_cli_XXXXXX";
  const char* made = mkdtemp(pattern.data());
  EXPECT_NE(made, nullptr);
  streams_ = pattern;
  folder_ = pattern + "/work";
  fs::create_directory(folder_);
}

ProgramTest::~ProgramTest() {
  std::error_code ignored;
  fs::remove_all(streams_, ignored);
}

ProgramResult ProgramTest::Run(const std::string& arguments) const {
  return Shell("\"$EMMY\" " + arguments);
}

ProgramResult ProgramTest::Shell(const std::string& command) const {
  const std::string line =
      "cd '" + folder_ + "' && EMMY='" EMMY_PROGRAM "' && { " + command +
      "\n} >'" + streams_ + "/out' 2>'" + streams_ + "/err' </dev/null";
  const int status = std::system(line.c_str());  // NOLINT: a shell is meant.
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          ReadAll(streams_ + "/out"), ReadAll(streams_ + "/err")};
}

void ProgramTest::Write(const std::string& name,
                        const std::string& text) const {
  std::ofstream(folder_ + "/" + name, std::ios::binary) << text;
}

std::string ProgramTest::Read(const std::string& name) const {
  return ReadAll(folder_ + "/" + name);
}

std::vector<std::string> ProgramTest::Files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string Replaced(std::string text, const std::string& from,
                     const std::string& to) {
  const size_t position = text.find(from);
  EXPECT_NE(position, std::string::npos) << from;
  EXPECT_EQ(text.find(from, position + 1), std::string::npos) << from;
  return text.replace(position, from.size(), to);
}

}  // namespace emmy
