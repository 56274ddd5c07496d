#include "verification/report/environment.h"

#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <string_view>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"

namespace emmy::verification {
namespace {

// What follows `key` and `separator` in the first such line of a file; "" if
// there is none.
std::string ValueInFile(const std::string& path, const std::string& key,
                        char separator) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    const std::string name = line.substr(0, at);
    if (absl::StripAsciiWhitespace(name) != key) continue;
    std::string value = line.substr(at + 1);
    absl::StripAsciiWhitespace(&value);
    value.erase(std::remove(value.begin(), value.end(), '"'), value.end());
    return value;
  }
  return "";
}

std::string Processor() {
  const std::string name = ValueInFile("/proc/cpuinfo", "model name", ':');
  return name.empty() ? "unknown" : name;
}

std::string System() {
  std::string name = ValueInFile("/etc/os-release", "PRETTY_NAME", '=');
  utsname kernel{};
  if (uname(&kernel) == 0) {
    absl::StrAppend(&name, name.empty() ? "" : ", ", &kernel.sysname[0], " ",
                    &kernel.release[0], ", ", &kernel.machine[0]);
  }
  return name.empty() ? "unknown" : name;
}

std::string Date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  const size_t size =
      std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return std::string(text.data(), size);
}

bool IsPlain(char c) {
  return absl::ascii_isalnum(static_cast<unsigned char>(c)) ||
         std::string_view("_-./=:,+@%").find(c) != std::string_view::npos;
}

}  // namespace

std::string ShellCommand(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) {
    if (!command.empty()) command += ' ';
    const bool plain =
        !word.empty() && std::all_of(word.begin(), word.end(), IsPlain);
    absl::StrAppend(
        &command,
        plain ? word
              : absl::StrCat("'", absl::StrReplaceAll(word, {{"'", "'\\''"}}),
                             "'"));
  }
  return command;
}

Environment DescribeEnvironment(const std::vector<std::string>& command_line) {
  Environment environment;
  environment.build = GetBuildInfo();
  environment.processor = Processor();
  environment.system = System();
  environment.date = Date();
  environment.command = ShellCommand(command_line);
  return environment;
}

}  // namespace emmy::verification
