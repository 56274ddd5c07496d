#include "tools/cli/run_files.h"

#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "emmy/io/text_file.h"

namespace emmy {
namespace {

namespace fs = std::filesystem;

// The name without links and dots, as far as it exists.
fs::path Canonical(const std::string& name) {
  std::error_code error;
  const fs::path target = FollowLinks(name).value_or(name);
  fs::path canonical = fs::weakly_canonical(fs::absolute(target, error), error);
  return error ? target : canonical;
}

}  // namespace

bool IsSameFile(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored) || Canonical(a) == Canonical(b);
}

absl::Status CheckFilesApart(const RunFiles& files) {
  struct Purpose {
    const char* name;
    std::string path;
  };
  std::vector<Purpose> purposes = {{"the case", files.case_path}};
  if (!files.output.empty()) {
    purposes.push_back({"the history", files.history()});
    purposes.push_back({"the summary", files.summary()});
  }
  if (!files.resume.empty()) {
    purposes.push_back({"the checkpoint to go on from", files.resume});
  }
  if (!files.checkpoint.empty() &&
      (files.resume.empty() || !IsSameFile(files.checkpoint, files.resume))) {
    purposes.push_back({"the checkpoint", files.checkpoint});
  }
  for (size_t i = 0; i < purposes.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if (IsSameFile(purposes[i].path, purposes[j].path)) {
        return absl::InvalidArgumentError(
            absl::StrCat(purposes[i].path, ": must not be ", purposes[j].name,
                         " and ", purposes[i].name, " at once"));
      }
    }
  }
  return absl::OkStatus();
}

absl::Status CheckCheckpointIsNew(const RunFiles& files) {
  const std::string& path = files.checkpoint;
  std::error_code ignored;
  if (path.empty() || !fs::exists(path, ignored)) return absl::OkStatus();
  if (!files.resume.empty() && IsSameFile(path, files.resume)) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(absl::StrCat(
      path, ": exists: go on from it by --resume ", path, ", or remove it"));
}

MadeFolder::~MadeFolder() {
  for (const std::string& folder : made_) rmdir(folder.c_str());
}

absl::Status MadeFolder::Make(const std::string& path) {
  std::error_code ignored;
  for (fs::path folder = path;
       !folder.empty() && !fs::exists(fs::symlink_status(folder, ignored));
       folder = folder.parent_path()) {
    made_.push_back(folder.string());
  }
  return MakeDirectory(path);
}

std::string CheckNotEmpty(const std::string& name) {
  return name.empty() ? "must be a name, got an empty one" : "";
}

}  // namespace emmy
