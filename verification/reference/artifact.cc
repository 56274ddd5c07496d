#include "verification/reference/artifact.h"

#include <filesystem>
#include <utility>

#include "absl/strings/str_cat.h"
#include "emmy/io/text_file.h"
#include "verification/figures/energy_error_figure.h"
#include "verification/figures/figure.h"
#include "verification/reference/manifest.h"
#include "verification/reference/reference_table.h"
#include "verification/reference/regression.h"
#include "verification/registry.h"
#include "verification/report/claim_table.h"

namespace emmy::verification {
namespace {

constexpr size_t kMaxBytes = size_t{16} << 20;

absl::Status WriteBelow(const std::string& root, const std::string& path,
                        const std::string& text) {
  const std::string file = absl::StrCat(root, "/", path);
  const absl::Status status =
      MakeDirectory(std::filesystem::path(file).parent_path().string());
  return status.ok() ? WriteTextFile(file, text) : status;
}

Artifact RegressionArtifact(const RegressionRun& run) {
  const std::string path = RegressionPath("", run.name).substr(1);
  return {
      .name = run.name,
      .path = path,
      .description = "regression data",
      .compare = [run](const std::string& root) -> absl::StatusOr<std::string> {
        absl::StatusOr<ReferenceTable> now = run.compute(EnergyMomentumScheme);
        if (!now.ok()) return now.status();
        const absl::StatusOr<ReferenceTable> stored =
            ReadReference(RegressionPath(root, run.name));
        if (!stored.ok()) {
          return absl::StrCat(stored.status().message(), "\n");
        }
        return DescribeDifference(*stored, *now);
      },
      .write = [run, path](const std::string& root) -> absl::Status {
        const absl::StatusOr<ReferenceTable> now =
            run.compute(EnergyMomentumScheme);
        if (!now.ok()) return now.status();
        return WriteBelow(root, path, FormatReference(*now));
      }};
}

// A text file, or the part of one, that follows from the sources.
Artifact ClaimTableArtifact() {
  const std::string path = "verification/README.md";
  return {.name = "claim_table",
          .path = path,
          .description = "the table of claims, from the registry",
          .compare =
              [path](const std::string& root) -> absl::StatusOr<std::string> {
            const absl::StatusOr<std::string> text =
                ReadTextFile(absl::StrCat(root, "/", path), kMaxBytes);
            if (!text.ok()) return text.status();
            const absl::StatusOr<std::string> now =
                ReplaceClaimTable(*text, AllClaims());
            if (!now.ok()) return now.status();
            return *now == *text ? "" : "the table is not the registry's\n";
          },
          .write = [path](const std::string& root) -> absl::Status {
            const std::string file = absl::StrCat(root, "/", path);
            const absl::StatusOr<std::string> text =
                ReadTextFile(file, kMaxBytes);
            if (!text.ok()) return text.status();
            const absl::StatusOr<std::string> now =
                ReplaceClaimTable(*text, AllClaims());
            return now.ok() ? WriteTextFile(file, *now) : now.status();
          }};
}

absl::StatusOr<Figure> ReadmeFigure() {
  constexpr int64_t kSteps = 1000000;
  const absl::StatusOr<EnergyErrorStudy> study =
      StudyEnergyError(kSteps, EnergyMomentumScheme);
  if (!study.ok()) return study.status();
  return EnergyErrorFigure(*study);
}

// Compared by its numbers: versions of gnuplot draw differently.
Artifact ReadmeFigureArtifact() {
  const std::string folder = "docs/images";
  return {.name = "energy_error_figure",
          .path = folder + "/energy_error.svg",
          .description = "figure of the README, a million steps six times",
          .compare =
              [folder](const std::string& root) -> absl::StatusOr<std::string> {
            const absl::StatusOr<Figure> figure = ReadmeFigure();
            if (!figure.ok()) return figure.status();
            const absl::StatusOr<std::string> stored = ReadTextFile(
                absl::StrCat(root, "/", folder, "/", figure->name, ".csv"),
                kMaxBytes);
            if (!stored.ok()) return std::string("its CSV file is missing\n");
            return *stored == FigureCsv(*figure) ? "" : "its numbers differ\n";
          },
          .write = [folder](const std::string& root) -> absl::Status {
            const absl::StatusOr<Figure> figure = ReadmeFigure();
            if (!figure.ok()) return figure.status();
            const std::string directory = absl::StrCat(root, "/", folder);
            const absl::Status status = MakeDirectory(directory);
            return status.ok() ? WriteFigure(*figure, directory) : status;
          }};
}

// After all data, whose hashes it holds.
Artifact ManifestArtifact() {
  const std::string path = "reference_data/manifest.json";
  return {.name = "manifest",
          .path = path,
          .description = "kind, source and hash of the stored data",
          .compare =
              [path](const std::string& root) -> absl::StatusOr<std::string> {
            const absl::StatusOr<std::string> now = MakeManifest(root);
            if (!now.ok()) return now.status();
            const absl::StatusOr<std::string> stored =
                ReadTextFile(absl::StrCat(root, "/", path), kMaxBytes);
            if (!stored.ok()) return std::string("is missing\n");
            return DescribeManifestDifference(*stored, *now);
          },
          .write = [path](const std::string& root) -> absl::Status {
            const absl::StatusOr<std::string> now = MakeManifest(root);
            return now.ok() ? WriteBelow(root, path, *now) : now.status();
          }};
}

}  // namespace

const std::vector<Artifact>& AllArtifacts() {
  static const std::vector<Artifact>* const artifacts = [] {
    auto* all = new std::vector<Artifact>;
    for (const RegressionRun& run : RegressionRuns()) {
      all->push_back(RegressionArtifact(run));
    }
    all->push_back(ManifestArtifact());
    all->push_back(ClaimTableArtifact());
    all->push_back(ReadmeFigureArtifact());
    return all;
  }();
  return *artifacts;
}

const Artifact* FindArtifact(std::string_view name) {
  for (const Artifact& artifact : AllArtifacts()) {
    if (artifact.name == name) return &artifact;
  }
  return nullptr;
}

}  // namespace emmy::verification
