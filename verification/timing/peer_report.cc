#include "verification/timing/peer_report.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/strip.h"

namespace emmy::verification {
namespace {

constexpr char kPrefix[] = "peers/";

// Of the cases in the order in which they are measured.
const std::vector<std::pair<std::string, std::string>>& Cases() {
  static const auto* const cases =
      new std::vector<std::pair<std::string, std::string>>{
          {"box", "The paper's box"},
          {"bar", "The paper's box with a stiff bar"},
          {"free_boxes:1000", "1000 free boxes, all of a step"},
          {"chain:100", "Chain of 100 boxes on ball joints, all of a step"},
          {"chain:1000", "Chain of 1000 boxes on ball joints, all of a step"}};
  return *cases;
}

std::string Row(const Timing& timing, const std::string& who,
                const Timing* own) {
  if (!timing.error.empty()) {
    return absl::StrFormat("| `%s` | failed: %s | | | | | %s |\n", who,
                           timing.error, timing.label);
  }
  const std::string ratio =
      own == nullptr ? "–"
                     : absl::StrFormat("%.3g", timing.median / own->median);
  return absl::StrFormat("| `%s` | %s | %.0f %% | %s | %s | %s | %s |\n", who,
                         TimeText(timing.median), 100.0 * timing.spread, ratio,
                         CounterText(timing, "energy_error", true),
                         CounterText(timing, "angular_momentum_error", true),
                         timing.label);
}

std::string CaseTable(const TimingRun& run, const std::string& name,
                      const std::string& title) {
  const std::string prefix = absl::StrCat(kPrefix, name, "/");
  const Timing* own = run.Find(absl::StrCat(prefix, "emmy_ancf"));
  std::string rows;
  for (const Timing& timing : run.timings) {
    absl::string_view who = timing.name;
    if (!absl::ConsumePrefix(&who, prefix)) continue;
    rows += Row(timing, std::string(who), own);
  }
  if (rows.empty()) return "";
  return absl::StrCat(
      "\n#### ", title,
      "\n\n| by | time of a step | spread | over ANCF | energy error | angular "
      "momentum error | settings |\n| --- | --- | --- | --- | --- | --- | --- "
      "|\n",
      rows);
}

}  // namespace

const std::vector<Ratio>& PeerRatios() {
  static const std::vector<Ratio>* const ratios = new std::vector<Ratio>{
      {"box with a bar: ANCF over ODE's double-ball spring",
       "peers/bar/emmy_ancf", "peers/bar/spring/ode", 2.0, false,
       "set: exact laws for the price of two steps without"},
      {"chain of 1000 boxes: ANCF over Bullet's 10 iterations",
       "peers/chain:1000/emmy_ancf", "peers/chain:1000/bullet", 0.6, false,
       "set: a solution in one sweep should be faster than ten sweeps"},
      {"chain of 1000 boxes: Simbody's Runge-Kutta-Merson over ANCF",
       "peers/chain:1000/simbody", "peers/chain:1000/emmy_ancf", 12.0, true,
       "set"},
  };
  return *ratios;
}

std::string PeerReport(const TimingRun& run) {
  std::string text = absl::StrCat(
      "### Other engines\n\nThe same cases, steps of 1 ms, measured ", run.date,
      ". Energy and angular momentum are computed from every engine's places "
      "and velocities by the same formulas; errors are the largest over 10 s "
      "(one body) or 1 s (many), relative to the largest value. An engine is "
      "set for this job, not as it comes: the last column says how. A bar is a "
      "spring of its stiffness to a mass point, or a rigid body on a ball "
      "joint.\n\n",
      RatioTable(run, PeerRatios()));
  for (const auto& [name, title] : Cases()) {
    text += CaseTable(run, name, title);
  }
  return text;
}

}  // namespace emmy::verification
