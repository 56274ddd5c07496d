// One engine with one case: what emmy_peer_benchmark steps and times.

#ifndef EMMY_VERIFICATION_BENCHMARKS_PEERS_PEER_SYSTEM_H_
#define EMMY_VERIFICATION_BENCHMARKS_PEERS_PEER_SYSTEM_H_

#include <memory>
#include <string>
#include <vector>

#include "verification/benchmarks/peers/peer_case.h"
#include "verification/benchmarks/peers/rigid_laws.h"

namespace emmy::verification {

class PeerSystem {
 public:
  PeerSystem() = default;
  PeerSystem(const PeerSystem&) = delete;
  PeerSystem& operator=(const PeerSystem&) = delete;
  virtual ~PeerSystem() = default;

  // By kPeerTimeStep. Empty, or why the step failed.
  virtual std::string Step() = 0;

  // Looks at the laws; Errors() are the largest of all looks, and NaN counts
  // as an error.
  virtual void Observe() = 0;
  virtual LawErrors Errors() const = 0;

  // How the engine was set, for the reader of the table.
  virtual std::string Settings() const = 0;
};

// Observes rigid bodies by MeasureLaws.
class RigidSystem : public PeerSystem {
 public:
  void Observe() override {
    const RigidLaws laws = MeasureLaws(Bodies(), springs_);
    if (monitor_ == nullptr) {
      monitor_ = std::make_unique<LawMonitor>(laws);
    } else {
      monitor_->Observe(laws);
    }
  }
  LawErrors Errors() const override {
    return monitor_ == nullptr ? LawErrors() : monitor_->Errors();
  }

 protected:
  explicit RigidSystem(const PeerCase& value)
      : start_(value.bodies), springs_(value.springs) {}

  // Where the bodies are now, in the order of the case.
  virtual std::vector<RigidMotion> Bodies() const = 0;

  const std::vector<RigidMotion>& start() const { return start_; }

 private:
  std::vector<RigidMotion> start_;
  std::vector<PairSpring> springs_;
  std::unique_ptr<LawMonitor> monitor_;
};

// Sequential impulses with `iterations`; no springs.
std::unique_ptr<PeerSystem> MakeBullet(const PeerCase& value, int iterations);

// Which of ODE's two ways to solve for the forces of joints.
enum class OdeStepper {
  kDirect,     // dWorldStep
  kIterative,  // dWorldQuickStep with 20 iterations
};
std::unique_ptr<PeerSystem> MakeOde(const PeerCase& value, OdeStepper stepper);

// Fixed steps of kPeerTimeStep / substeps by Runge-Kutta-Merson.
std::unique_ptr<PeerSystem> MakeSimbody(const PeerCase& value, int substeps);

// Emmy's energy-momentum step, observed with the model's own invariants: they
// hold the energy of penalties, too, in extended precision.
std::unique_ptr<PeerSystem> MakeEmmy(const ModelDescription& description);
std::unique_ptr<PeerSystem> MakeEmmyBatch(const ModelDescription& description);

// The classical Runge-Kutta method on the paper's box.
std::unique_ptr<PeerSystem> MakeRungeKutta();

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_BENCHMARKS_PEERS_PEER_SYSTEM_H_
