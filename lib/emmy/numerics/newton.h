// How an iteration is controlled and what it reports.

#ifndef EMMY_NUMERICS_NEWTON_H_
#define EMMY_NUMERICS_NEWTON_H_

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace emmy {

// When an iteration ends.
struct NewtonOptions {
  // Empty: iterate until corrections stop shrinking at the round-off floor, or
  // the next would be lost in it (EM-5). Else: converged when the largest
  // velocity correction is at most tolerance · max|w|, which leaves a residual
  // whose work is the energy error.
  std::optional<double> tolerance;
  int max_iterations = 60;  // Of one attempt.
};

// Why an iteration ended.
enum class Termination {
  kConverged,        // The state is the accepted step.
  kMaxIterations,    // The state is unchanged.
  kSingularTangent,  // The state is unchanged; `message` names the element.
  kNonFinite,        // The state is unchanged; a NaN or infinity appeared.
  kUnsound,          // Of a WatchedRun: CheckState says why.
};

// How the iteration of a step ended.
struct [[nodiscard]] StepReport {
  Termination termination = Termination::kMaxIterations;  // Why it ended.
  // The most any part of the model needed; for orders 4 and 6 summed over the
  // parts of the step.
  int iterations = 0;
  // Largest velocity correction of the last iteration [m/s, rad/s].
  double correction = 0.0;
  std::string message;  // Non-empty unless kConverged.
  // Whether the step was accepted.
  bool ok() const { return termination == Termination::kConverged; }
};

// Iterations after corrections have reached round-off in which the finer
// measures (net moment, work) may still settle. With the exact Jacobian, what
// has not shrunk by then is their rounding, whatever its estimate says; with
// any other it may be slow: an ANCF structure goes on with the exact one, a
// conventional structure, which has none, accepts what is left.
inline constexpr int kStagnationPatience = 20;

// Within how many floors a sequence may be judged to have stopped shrinking.
// The floor of a correction does not see how ill a system is conditioned; that
// of a net force, a moment or work is a sum of known terms, which rounding
// exceeds a few times at most.
inline constexpr double kNearFloor = 1e3;
// The same of what a law forbids to remain.
inline constexpr double kNearLawFloor = 64.0;

// How much of a floor may be left with the same sign in every step: that adds
// up like the number of steps, rounding like its root, so that it stays below
// for a million.
inline constexpr double kNegligibleRest = 0x1p-10;

// The largest share of a motion, or of its energy, that an accepted step may
// owe to rounding or to what its iteration left.
inline constexpr double kLargestShare = 1e-8;

// Judges when one sequence of corrections has reached round-off.     (EM-5)
//
// `floor` is the size that rounding alone can give a correction, from the
// operation count and the scale of the problem. A correction far above it
// never counts as stagnation, however it compares with the one before: the
// first corrections of a stiff, large step may grow.
//
// Nor is an iteration done that could only confirm it: if the sequence shrinks
// so fast that its next member would be `negligible` against the floor, that
// member is lost in rounding. How fast it shrinks is the slower of the last two
// ratios: one alone may be that of a part which the first correction removes,
// with a slower part hidden below it.
//
// A member at the floor is rounding for the most part, and neither its size nor
// its ratio says what is left. Where asked, the members before it do: it should
// have been their last times their rate, and the next that times the rate
// again. A part that was hidden below them all the time and shrinks slowly is
// missed, so that what a law forbids to remain is not judged like this, but
// seen, or bounded by the correction itself (LANE-6).
class StagnationMonitor {
 public:
  // `explains_rounding`: the members before one at the floor are asked.
  explicit StagnationMonitor(double negligible = kNegligibleRest,
                             bool explains_rounding = false,
                             double near_floor = kNearFloor)
      : negligible_(negligible),
        explains_rounding_(explains_rounding),
        near_floor_(near_floor) {}

  // Of what a law forbids to remain.
  static StagnationMonitor OfLaw() {
    return StagnationMonitor(kNegligibleRest, /*explains_rounding=*/false,
                             kNearLawFloor);
  }

  // True once the sequence has stopped shrinking near `floor`, and from then
  // on, so that several sequences may stagnate at different iterations.
  bool Update(double correction, double floor) {
    constexpr double kRounding = 4.0;  // Where a member is rounding.
    constexpr double kRatio = 0.5;     // Less than one bit gained.
    const double ratio = correction / previous_;
    const double rate = std::max(ratio, previous_ratio_);
    // Above rounding it has to grow: where a sequence shrinks slowly, far more
    // is left than its last member.
    const double shrinks = correction <= kRounding * floor ? kRatio : 1.0;
    const bool stopped =
        correction <= near_floor_ * floor && !(ratio < shrinks);
    const bool vanishes =
        rate < kRatio && correction * rate <= negligible_ * floor;
    const bool vanished = explains_rounding_ &&
                          correction <= kRounding * floor && rate_ < kRatio &&
                          previous_ * rate_ * rate_ <= negligible_ * floor;
    expected_ = previous_ * rate_;
    // The first member has no ratio, and nothing vanishes by it.
    previous_ratio_ = std::isinf(previous_) ? previous_ : ratio;
    previous_ = correction;
    rate_ = rate;
    stagnant_ =
        stagnant_ || correction == 0.0 || stopped || vanishes || vanished;
    return stagnant_;
  }

  // What the last member should have been by the members before it: the rest of
  // it is rounding. Infinite before the fourth member.
  double expected() const { return expected_; }

 private:
  double negligible_;
  bool explains_rounding_;
  double near_floor_;
  bool stagnant_ = false;
  double previous_ = std::numeric_limits<double>::infinity();
  double previous_ratio_ = std::numeric_limits<double>::infinity();
  double rate_ = std::numeric_limits<double>::infinity();  // The slower of two.
  double expected_ = std::numeric_limits<double>::infinity();
};

}  // namespace emmy

#endif  // EMMY_NUMERICS_NEWTON_H_
