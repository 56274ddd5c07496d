#include "verification/report/write_report.h"

#include <utility>

#include "emmy/io/text_file.h"
#include "verification/figures/figure.h"
#include "verification/parallel.h"
#include "verification/report/html_claim.h"
#include "verification/report/html_page.h"
#include "verification/report/json_report.h"
#include "verification/report/junit_report.h"

namespace emmy::verification {
namespace {

// More than gnuplot writes for any figure of a report.
constexpr size_t kMaxImageBytes = size_t{64} << 20;

// gnuplot is a process of its own: threads only wait for it.
std::vector<absl::Status> Draw(const std::vector<const Figure*>& figures,
                               const std::string& directory, int num_threads) {
  std::vector<absl::Status> results(figures.size());
  ForEachInParallel(figures.size(), num_threads, [&](size_t i) {
    results[i] = WriteFigure(*figures[i], directory);
  });
  return results;
}

}  // namespace

absl::StatusOr<std::vector<std::string>> WriteReport(
    const std::vector<Outcome>& outcomes, const Environment& environment,
    const std::string& directory) {
  std::vector<const Figure*> figures;
  for (const Outcome& outcome : outcomes) {
    for (const Figure& figure : outcome.result.figures) {
      figures.push_back(&figure);
    }
  }
  const std::vector<absl::Status> drawn =
      Draw(figures, directory, environment.threads);
  std::vector<std::string> messages;
  FigureImages images;
  for (size_t i = 0; i < figures.size(); ++i) {
    if (absl::IsUnavailable(drawn[i])) {
      messages.emplace_back(drawn[i].message());
      continue;
    }
    if (!drawn[i].ok()) return drawn[i];
    absl::StatusOr<std::string> image = ReadTextFile(
        directory + "/" + figures[i]->name + ".svg", kMaxImageBytes);
    if (!image.ok()) return image.status();
    images[figures[i]->name] = *std::move(image);
  }
  for (const auto& [name, text] :
       {std::pair<const char*, std::string>("/report.json",
                                            JsonReport(outcomes, environment)),
        {"/junit.xml", JunitReport(outcomes, environment)},
        {"/index.html", HtmlPage(outcomes, environment, images)}}) {
    const absl::Status status = WriteTextFile(directory + name, text);
    if (!status.ok()) return status;
  }
  return messages;
}

}  // namespace emmy::verification
