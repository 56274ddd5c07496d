#include "emmy/io/text_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"

namespace emmy {
namespace {

struct CloseFile {
  // Written files are closed by WriteTextFile, which looks at the result.
  void operator()(std::FILE* file) const {
    static_cast<void>(std::fclose(file));
  }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

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
  return absl::DataLossError(
      absl::StrCat(path, ": cannot be written: ", std::strerror(error)));
}

absl::Status WriteTextFile(const std::string& path, absl::string_view text) {
  const std::string temporary = path + ".tmp";
  File file(std::fopen(temporary.c_str(), "wb"));
  if (file == nullptr) {
    return absl::PermissionDeniedError(
        absl::StrCat(path, ": cannot be written: ", std::strerror(errno)));
  }
  const bool written =
      std::fwrite(text.data(), 1, text.size(), file.get()) == text.size() &&
      std::fflush(file.get()) == 0 && fsync(fileno(file.get())) == 0;
  const int write_error = errno;
  const bool closed = std::fclose(file.release()) == 0;
  const int close_error = errno;
  std::error_code error;
  if (written && closed) {
    std::filesystem::rename(temporary, path, error);
    if (!error) return SyncFolderOf(path);
  }
  const std::string reason =
      error ? error.message()
            : std::strerror(written ? close_error : write_error);
  std::filesystem::remove(temporary, error);
  return absl::DataLossError(
      absl::StrCat(path, ": cannot be written: ", reason));
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
