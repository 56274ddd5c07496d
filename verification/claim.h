// A claim about the library: a sentence that a computation can refute.
//
// A claim states what is measured (metric, unit), against what (reference),
// which values are acceptable (bound) and where the bound comes from. Its
// verdict follows from the measured values alone: `Judge` is the only place
// that decides.

#ifndef EMMY_VERIFICATION_CLAIM_H_
#define EMMY_VERIFICATION_CLAIM_H_

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "verification/baselines/baseline_scheme.h"
#include "verification/figures/figure.h"
#include "verification/runs/scheme.h"

namespace emmy::verification {

// What the measured value is compared with, best evidence first.
enum class Reference {
  kExact,             // A closed form, or a law that holds exactly.
  kPublished,         // Numbers or figures others have published.
  kCrossFormulation,  // The same motion by another formulation here.
  kRegression,        // An earlier result of this code: no evidence by itself.
};

// How much is computed: the whole suite within a minute, or to the lengths
// the claims are stated for.
enum class Level { kQuick, kFull };

// Acceptable values: lower ≤ value ≤ upper; NaN never is.
struct Bound {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  std::string derivation;  // Where the numbers come from.
};

// One measured value; `label` says which of the claim's, e.g. its penalty.
struct MetricValue {
  std::string label;
  double value = std::numeric_limits<double>::quiet_NaN();
};

struct ClaimResult {
  std::vector<MetricValue> values;  // Each has to keep the bound.
  std::vector<Figure> figures;
  std::vector<std::string> notes;  // For the reader; never judged.
};

struct ClaimSetting {
  Level level = Level::kQuick;
  // How runs are advanced; tests put wrong variants here.
  Scheme scheme = EnergyMomentumScheme;
  // The integrators to compare with, likewise.
  BaselineSource baseline = BaselineScheme;
  // Relative error put into what the library computes, where a claim takes no
  // steps; tests set it.
  double fault = 0.0;
};

inline bool IsFull(const ClaimSetting& setting) {
  return setting.level == Level::kFull;
}

struct Claim {
  std::string id;         // "<group>/<name>", never used for another claim.
  std::string sentence;   // What is claimed, in words.
  std::string equations;  // Tags of docs/theory.md, or a figure of the paper.
  Reference reference = Reference::kExact;
  std::string metric;
  std::string unit;  // Of the metric; "-" if it has none.
  Bound bound;
  // Measures. A status says why that was not possible; the claim then fails.
  std::function<absl::StatusOr<ClaimResult>(const ClaimSetting&)> measure;

  std::string group() const { return id.substr(0, id.find('/')); }
  // What a person types to see this claim alone.
  std::string command() const { return "emmy verify --only " + id; }
};

// A claim after it was measured.
struct Outcome {
  const Claim* claim = nullptr;
  Level level = Level::kQuick;
  bool pass = false;
  ClaimResult result;
  std::string failure;        // Why not, with label, value and bound; else "".
  MetricValue worst;          // The value with the least margin.
  double margin = 0.0;        // Of `worst`, see Margin.
  double wall_seconds = 0.0;  // What measuring took; set by RunClaim.
};

// How far inside the bound a value lies: 1 at the middle of two limits or at
// zero under one, 0 on a limit, negative outside. NaN if the value is NaN.
double Margin(const Bound& bound, double value);

Outcome Judge(const Claim& claim, Level level,
              const absl::StatusOr<ClaimResult>& measured);

// Measures and judges.
Outcome RunClaim(const Claim& claim, const ClaimSetting& setting);

// "exact", "published", "cross-formulation", "regression".
std::string ReferenceName(Reference reference);
std::string LevelName(Level level);  // "quick", "full".
// "<= 1e-15", "0.35 ... 0.65".
std::string BoundText(const Bound& bound);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_CLAIM_H_
