// Runs the program `emmy` as a user's shell would, in a folder of its own.

#ifndef EMMY_TESTS_CLI_PROGRAM_H_
#define EMMY_TESTS_CLI_PROGRAM_H_

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace emmy {

struct ProgramResult {
  int exit_status = -1;  // -1: ended by a signal.
  std::string out;
  std::string err;
};

class ProgramTest : public ::testing::Test {
 protected:
  ProgramTest();
  ~ProgramTest() override;

  // Runs `emmy <arguments>` in the folder; the shell reads `arguments`.
  ProgramResult Run(const std::string& arguments) const;
  // Runs any shell command there; `$EMMY` is the program.
  ProgramResult Shell(const std::string& command) const;

  void Write(const std::string& name, const std::string& text) const;
  std::string Read(const std::string& name) const;
  // Names of the files and folders in the folder, sorted.
  std::vector<std::string> Files() const;

 private:
  std::string folder_;
  std::string streams_;  // Where the two streams are kept, beside the folder.
};

// `text` with its only `from` replaced by `to`.
std::string Replaced(std::string text, const std::string& from,
                     const std::string& to);

// A valid case: the box of the paper, 10 steps.
extern const char kBoxCase[];

}  // namespace emmy

#endif  // EMMY_TESTS_CLI_PROGRAM_H_
