#include "verification/reference/manifest.h"

#include <algorithm>
#include <boost/uuid/detail/sha1.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/io/json_text.h"
#include "emmy/io/text_file.h"

namespace emmy::verification {
namespace {

using OrderedJson = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr size_t kMaxBytes = size_t{16} << 20;
constexpr char kFolder[] = "reference_data";
constexpr char kOwnPath[] = "reference_data/manifest.json";

absl::StatusOr<std::vector<std::string>> DataFiles(const std::string& root) {
  std::error_code error;
  std::vector<std::string> paths;
  const fs::path folder = fs::path(root) / kFolder;
  for (fs::recursive_directory_iterator it(folder, error), end;
       !error && it != end; it.increment(error)) {
    if (it->path().extension() != ".json") continue;
    paths.push_back(it->path().lexically_relative(root).generic_string());
  }
  if (error) {
    return absl::NotFoundError(
        absl::StrCat(folder.string(), ": ", error.message()));
  }
  paths.erase(std::remove(paths.begin(), paths.end(), kOwnPath), paths.end());
  std::sort(paths.begin(), paths.end());
  return paths;
}

// A member of the file that says what it is; sources may be an object whose
// member `published` is the sentence.
absl::StatusOr<std::string> Said(const std::string& path,
                                 const OrderedJson& json, const char* key) {
  const auto member = json.find(key);
  if (member != json.end() && member->is_string()) {
    return member->get<std::string>();
  }
  if (member != json.end() && member->is_object() &&
      member->contains("published") && member->at("published").is_string()) {
    return member->at("published").get<std::string>();
  }
  return absl::DataLossError(
      absl::StrCat(path, ": /", key, ": expected a text"));
}

absl::StatusOr<OrderedJson> Entry(const std::string& root,
                                  const std::string& path) {
  const absl::StatusOr<std::string> text =
      ReadTextFile(absl::StrCat(root, "/", path), kMaxBytes);
  if (!text.ok()) {
    return absl::Status(text.status().code(),
                        absl::StrCat(path, ": ", text.status().message()));
  }
  const OrderedJson json =
      OrderedJson::parse(*text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) {
    return absl::DataLossError(absl::StrCat(path, ": not a JSON object"));
  }
  OrderedJson entry;
  entry["file"] = path;
  for (const char* const key : {"kind", "source", "command"}) {
    absl::StatusOr<std::string> value = Said(path, json, key);
    if (!value.ok()) return value.status();
    entry[key] = *std::move(value);
  }
  entry["git_hash"] = GitBlobHash(*text);
  return entry;
}

std::map<std::string, std::string> HashesByFile(const std::string& manifest) {
  std::map<std::string, std::string> hashes;
  const OrderedJson json =
      OrderedJson::parse(manifest, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("files")) return hashes;
  for (const OrderedJson& entry : json["files"]) {
    if (!entry.is_object()) continue;
    hashes[entry.value("file", "")] = entry.value("git_hash", "");
  }
  return hashes;
}

}  // namespace

std::string GitBlobHash(std::string_view bytes) {
  boost::uuids::detail::sha1 sha1;
  const std::string header = absl::StrCat("blob ", bytes.size());
  sha1.process_bytes(header.c_str(), header.size() + 1);
  sha1.process_bytes(bytes.data(), bytes.size());
  boost::uuids::detail::sha1::digest_type digest;
  static_assert(sizeof(digest) / sizeof(digest[0]) == 5, "words expected");
  sha1.get_digest(digest);
  std::string text;
  for (const unsigned word : digest) absl::StrAppendFormat(&text, "%08x", word);
  return text;
}

absl::StatusOr<std::string> MakeManifest(const std::string& root) {
  const absl::StatusOr<std::vector<std::string>> paths = DataFiles(root);
  if (!paths.ok()) return paths.status();
  OrderedJson json;
  json["format"] = "emmy-manifest/1";
  json["command"] = "emmy regenerate --only manifest";
  json["files"] = OrderedJson::array();
  for (const std::string& path : *paths) {
    absl::StatusOr<OrderedJson> entry = Entry(root, path);
    if (!entry.ok()) return entry.status();
    json["files"].push_back(*std::move(entry));
  }
  return FormatJson(json);
}

std::string DescribeManifestDifference(const std::string& stored,
                                       const std::string& now) {
  if (stored == now) return "";
  const std::map<std::string, std::string> before = HashesByFile(stored);
  const std::map<std::string, std::string> after = HashesByFile(now);
  std::string text;
  for (const auto& [file, hash] : after) {
    const auto old = before.find(file);
    if (old == before.end()) {
      absl::StrAppend(&text, file, ": not in the manifest\n");
    } else if (old->second != hash) {
      absl::StrAppend(&text, file,
                      ": changed since the manifest was written\n");
    }
  }
  for (const auto& [file, hash] : before) {
    if (after.count(file) == 0) absl::StrAppend(&text, file, ": is gone\n");
  }
  return text.empty() ? "kinds, sources or commands differ\n" : text;
}

}  // namespace emmy::verification
