// A file on its way to replace another: beside it, under a name of its own.
//
// The name is that of the file, as far as 200 bytes go, with ".emmy-", sixteen
// random hexadecimal digits and ".tmp". It is made only if there is nothing of
// that name, so that no file of anybody else is touched. The file is locked as
// long as its writer lives: what a killed program left behind is thereby known,
// and removed by the next one that writes to the same place.

#ifndef EMMY_IO_TEMPORARY_FILE_H_
#define EMMY_IO_TEMPORARY_FILE_H_

#include <string>

#include "absl/strings/string_view.h"

namespace emmy {

// Functions that return int return 0 or the errno of what failed.
class TemporaryFile {
 public:
  TemporaryFile() = default;
  // Removes the file unless Replace() has succeeded.
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  // Makes the file in the folder of `target`. To be called once.
  int Create(const std::string& target);
  // Writes `text` and waits until it is on the disk.
  int Write(absl::string_view text);
  // Gives the file the name `target`.
  int Replace();

 private:
  std::string target_;
  std::string name_;     // None: "".
  int descriptor_ = -1;  // -1: not open.
};

// Writes all of `text`, in one call unless the system takes only a part.
int WriteAll(int descriptor, absl::string_view text);

}  // namespace emmy

#endif  // EMMY_IO_TEMPORARY_FILE_H_
