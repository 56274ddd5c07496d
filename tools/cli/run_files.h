// The files of a run: none is two things at once, and a run that is refused
// leaves none.

#ifndef EMMY_TOOLS_CLI_RUN_FILES_H_
#define EMMY_TOOLS_CLI_RUN_FILES_H_

#include <string>
#include <vector>

#include "absl/status/status.h"

namespace emmy {

// Names as the user gave them; "": none.
struct RunFiles {
  std::string case_path;
  std::string output;  // The folder.
  std::string checkpoint;
  std::string resume;

  std::string history() const { return output + "/history.csv"; }
  std::string summary() const { return output + "/summary.json"; }
};

// Whether both names lead to one file, which need not exist yet.
bool IsSameFile(const std::string& a, const std::string& b);

// Fails if one file is named for two purposes, of which one would be lost. Only
// `checkpoint` and `resume` may be the same.
absl::Status CheckFilesApart(const RunFiles& files);

// Fails if the checkpoint would replace a file, other than the one to go on
// from: it may be worth days.
absl::Status CheckCheckpointIsNew(const RunFiles& files);

// A folder with its parents. Those it has made are removed again, if nothing is
// in them, unless Keep() was called.
class MadeFolder {
 public:
  MadeFolder() = default;
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;

  absl::Status Make(const std::string& path);
  void Keep() { made_.clear(); }

 private:
  std::vector<std::string> made_;  // The innermost first.
};

// For options: what is wrong with the name of a file or folder; "" if nothing.
std::string CheckNotEmpty(const std::string& name);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_RUN_FILES_H_
