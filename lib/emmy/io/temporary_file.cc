#include "emmy/io/temporary_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <random>
#include <system_error>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"

namespace emmy {
namespace {

constexpr size_t kDigits = 16;
constexpr char kSuffix[] = ".tmp";

// What the names of all temporary files for `target` begin with.
std::string Prefix(const std::filesystem::path& target) {
  constexpr size_t kMaxName = 200;  // Of 255 that file systems take.
  return absl::StrCat(target.filename().string().substr(0, kMaxName), ".emmy-");
}

std::string RandomDigits() {
  std::random_device random;
  const uint64_t high = random();
  return absl::StrCat(absl::Hex(high << 32U | random(), absl::kZeroPad16));
}

bool IsTemporary(absl::string_view name, const std::string& prefix) {
  if (name.size() != prefix.size() + kDigits + sizeof(kSuffix) - 1 ||
      !absl::StartsWith(name, prefix) || !absl::EndsWith(name, kSuffix)) {
    return false;
  }
  const absl::string_view digits = name.substr(prefix.size(), kDigits);
  return digits.find_first_not_of("0123456789abcdef") ==
         absl::string_view::npos;
}

// Removes the file if no writer holds it any more.
void RemoveIfLeft(const std::string& name) {
  const int descriptor =
      open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return;
  if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) unlink(name.c_str());
  close(descriptor);
}

void RemoveLeftovers(const std::filesystem::path& folder,
                     const std::string& prefix) {
  std::error_code error;
  std::filesystem::directory_iterator entry(folder, error);
  while (!error && entry != std::filesystem::directory_iterator()) {
    if (IsTemporary(entry->path().filename().string(), prefix)) {
      RemoveIfLeft(entry->path().string());
    }
    entry.increment(error);
  }
}

// The lock is ours and the name still there. Between making and locking
// another program may have taken the file for one that was left; where there
// are no locks, it cannot have.
bool Hold(int descriptor) {
  if (flock(descriptor, LOCK_EX) != 0) return errno != EINTR;
  struct stat status = {};
  return fstat(descriptor, &status) != 0 || status.st_nlink > 0;
}

}  // namespace

TemporaryFile::~TemporaryFile() {
  if (!name_.empty()) unlink(name_.c_str());
  if (descriptor_ >= 0) close(descriptor_);
}

int TemporaryFile::Create(const std::string& target) {
  target_ = target;
  const std::filesystem::path path(target);
  const std::filesystem::path folder =
      path.has_parent_path() ? path.parent_path() : ".";
  const std::string prefix = Prefix(path);
  RemoveLeftovers(folder, prefix);
  constexpr int kAttempts = 100;
  for (int i = 0; i < kAttempts; ++i) {
    const std::string name =
        (folder / absl::StrCat(prefix, RandomDigits(), kSuffix)).string();
    descriptor_ =
        open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) return errno;
    if (Hold(descriptor_)) {
      name_ = name;
      return 0;
    }
    unlink(name.c_str());
    close(descriptor_);
    descriptor_ = -1;
  }
  return EEXIST;
}

int TemporaryFile::Write(absl::string_view text) {
  const int error = WriteAll(descriptor_, text);
  if (error != 0) return error;
  return fsync(descriptor_) == 0 ? 0 : errno;
}

int TemporaryFile::Replace() {
  if (std::rename(name_.c_str(), target_.c_str()) != 0) return errno;
  name_.clear();
  return 0;
}

int WriteAll(int descriptor, absl::string_view text) {
  while (!text.empty()) {
    const ssize_t count = write(descriptor, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    text.remove_prefix(static_cast<size_t>(count));
  }
  return 0;
}

}  // namespace emmy
