// Energy and angular momentum of rigid bodies from what any engine can say:
// places, attitudes and velocities. The same for all engines, which do not get
// to measure themselves.
//
//   E = Σ ½ m v·v + ½ Ω·J Ω + Σ ½ k (l − l₀)²,  Ω = Rᵀω
//   L = Σ m x × v + R J Ω, about the origin of the inertial axes

#ifndef EMMY_VERIFICATION_BENCHMARKS_PEERS_RIGID_LAWS_H_
#define EMMY_VERIFICATION_BENCHMARKS_PEERS_RIGID_LAWS_H_

#include <vector>

#include "emmy/base/types.h"
#include "verification/benchmarks/peers/peer_case.h"

namespace emmy::verification {

struct RigidLaws {
  double energy = 0.0;                           // [J]
  Vector3d angular_momentum = Vector3d::Zero();  // [kg m²/s]
};

// Sums in long double: the figures of a thousand bodies are good to a few u.
RigidLaws MeasureLaws(const std::vector<RigidMotion>& bodies,
                      const std::vector<PairSpring>& springs);

// Largest differences from the start over the largest values, as in
// emmy/diagnostics/invariant_monitor.h.
struct LawErrors {
  double energy = 0.0;
  double angular_momentum = 0.0;
};

class LawMonitor {
 public:
  explicit LawMonitor(const RigidLaws& start);

  void Observe(const RigidLaws& laws);

  // NaN once an observed value was.
  LawErrors Errors() const;

 private:
  RigidLaws start_;
  LawErrors largest_;  // Absolute differences.
  LawErrors scale_;
};

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_BENCHMARKS_PEERS_RIGID_LAWS_H_
