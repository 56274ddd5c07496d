// Whole files in and out, with errors that say what the system said.

#ifndef EMMY_IO_TEXT_FILE_H_
#define EMMY_IO_TEXT_FILE_H_

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace emmy {

// The bytes of the file. Fails if it cannot be read or holds more than
// `max_bytes`; reads no more than that. Messages do not name the file.
absl::StatusOr<std::string> ReadTextFile(const std::string& path,
                                         size_t max_bytes);

// Replaces the file as a whole: `path` holds either its old content or `text`,
// never a part, even if the machine stops; on return `text` is on the disk.
// Until then it is beside it, in a TemporaryFile. Where `path` is a link, the
// file it leads to is replaced; what is there and no regular file (a device, a
// pipe, /dev/stdout) is written to. Messages begin with the path. Fails with
// kDataLoss if part may have been written, else with kPermissionDenied.
absl::Status WriteTextFile(const std::string& path, absl::string_view text);

// Whether WriteTextFile can begin to replace the file. Changes nothing.
absl::Status CheckReplaceable(const std::string& path);

// Removes the file, or the one that the link leads to, if it is a regular one.
void RemoveTextFile(const std::string& path);

// Where `path` leads, which need not exist.
absl::StatusOr<std::string> FollowLinks(const std::string& path);

// Waits until the folder that holds `path` is on the disk: the name of a file
// just made there, which syncing the file alone does not save.
absl::Status SyncFolderOf(const std::string& path);

// Makes the directory and its parents if needed. Messages begin with the path.
absl::Status MakeDirectory(const std::string& path);

}  // namespace emmy

#endif  // EMMY_IO_TEXT_FILE_H_
