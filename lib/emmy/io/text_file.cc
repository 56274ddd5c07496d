#include "emmy/io/text_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "emmy/io/temporary_file.h"

namespace emmy {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const {
    static_cast<void>(std::fclose(file));
  }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

absl::Status CannotWrite(const std::string& path, int error) {
  return absl::DataLossError(
      absl::StrCat(path, ": cannot be written: ", std::strerror(error)));
}

// The same where nothing has been written yet.
absl::Status CannotOpen(const std::string& path, int error) {
  return absl::PermissionDeniedError(CannotWrite(path, error).message());
}

// Standard output or standard error, if that is what `path` leads to, as
// /dev/stdout does; else -1. `status` is that of `path`.
int StandardStream(const std::string& path, const struct stat& status) {
  std::error_code ignored;
  if (!std::filesystem::is_symlink(path, ignored)) return -1;
  for (const int descriptor : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat stream = {};
    if (fstat(descriptor, &stream) == 0 && stream.st_dev == status.st_dev &&
        stream.st_ino == status.st_ino) {
      return descriptor;
    }
  }
  return -1;
}

// To what cannot be replaced, such as a device or a pipe. Closes `descriptor`,
// which is negative if there is none and errno says why.
absl::Status WriteInPlace(const std::string& path, int descriptor,
                          absl::string_view text) {
  if (descriptor < 0) return CannotOpen(path, errno);
  const int error = WriteAll(descriptor, text);
  close(descriptor);
  return error == 0 ? absl::OkStatus() : CannotWrite(path, error);
}

}  // namespace

absl::StatusOr<std::string> ReadTextFile(const std::string& path,
                                         size_t max_bytes) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return absl::InvalidArgumentError("is a directory, must be a file");
  }
  const File file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) {
    return absl::NotFoundError(
        absl::StrCat("cannot be opened: ", std::strerror(errno)));
  }
  std::string text;
  constexpr size_t kChunk = size_t{1} << 16;
  while (text.size() <= max_bytes) {
    const size_t size = text.size();
    text.resize(size + kChunk);
    const size_t count = std::fread(&text[size], 1, kChunk, file.get());
    text.resize(size + count);
    if (count == 0) break;
  }
  if (std::ferror(file.get()) != 0) {
    return absl::DataLossError(
        absl::StrCat("cannot be read: ", std::strerror(errno)));
  }
  if (text.size() > max_bytes) {
    return absl::InvalidArgumentError(
        absl::StrCat("larger than ", max_bytes >> 20, " MiB"));
  }
  return text;
}

absl::Status SyncFolderOf(const std::string& path) {
  const std::filesystem::path folder =
      std::filesystem::path(path).parent_path();
  const int descriptor =
      open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  const bool synced = descriptor >= 0 && fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  // Some file systems have no such operation, and need none.
  if (synced || error == EINVAL || error == ENOTSUP) return absl::OkStatus();
  return CannotWrite(path, error);
}

absl::StatusOr<std::string> FollowLinks(const std::string& path) {
  constexpr int kMaxLinks = 40;  // As the system itself.
  std::filesystem::path target(path);
  std::error_code error;
  for (int i = 0; i < kMaxLinks; ++i) {
    if (!std::filesystem::is_symlink(target, error)) return target.string();
    const std::filesystem::path next =
        std::filesystem::read_symlink(target, error);
    if (error) break;
    target = target.parent_path() / next;  // `next`, if it begins with "/".
  }
  return CannotOpen(path, error ? error.value() : ELOOP);
}

absl::Status WriteTextFile(const std::string& path, absl::string_view text) {
  struct stat status = {};
  const bool exists = stat(path.c_str(), &status) == 0;
  const int stream = exists ? StandardStream(path, status) : -1;
  if (stream >= 0) return WriteInPlace(path, dup(stream), text);
  if (exists && !S_ISREG(status.st_mode)) {
    return WriteInPlace(path, open(path.c_str(), O_WRONLY | O_CLOEXEC), text);
  }
  const absl::StatusOr<std::string> target = FollowLinks(path);
  if (!target.ok()) return target.status();
  TemporaryFile file;
  int error = file.Create(*target);
  if (error != 0) return CannotOpen(path, error);
  error = file.Write(text);
  if (error == 0) error = file.Replace();
  if (error != 0) return CannotWrite(path, error);
  return SyncFolderOf(*target);
}

absl::Status CheckReplaceable(const std::string& path) {
  struct stat status = {};
  if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    return S_ISDIR(status.st_mode) ? CannotOpen(path, EISDIR)
                                   : absl::OkStatus();
  }
  const absl::StatusOr<std::string> target = FollowLinks(path);
  if (!target.ok()) return target.status();
  TemporaryFile file;
  const int error = file.Create(*target);
  return error == 0 ? absl::OkStatus() : CannotOpen(path, error);
}

void RemoveTextFile(const std::string& path) {
  const absl::StatusOr<std::string> target = FollowLinks(path);
  std::error_code ignored;
  if (target.ok() && std::filesystem::is_regular_file(*target, ignored)) {
    std::filesystem::remove(*target, ignored);
  }
}

absl::Status MakeDirectory(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return absl::OkStatus();
  const bool file_exists = std::filesystem::exists(path, ignored);
  return absl::InvalidArgumentError(absl::StrCat(
      path, ": cannot be made a directory: ",
      file_exists ? "a file of that name exists" : error.message()));
}

}  // namespace emmy
