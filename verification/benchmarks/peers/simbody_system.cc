// Simbody: joints as coordinates of a tree, explicit Runge-Kutta-Merson steps.

#include <Simbody.h>

#include <cstdint>
#include <exception>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "verification/benchmarks/peers/peer_system.h"

namespace emmy::verification {
namespace {

SimTK::Vec3 Theirs(const Vector3d& v) { return {v(0), v(1), v(2)}; }
Vector3d Ours(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

class SimbodySystem : public RigidSystem {
 public:
  SimbodySystem(const PeerCase& value, int substeps)
      : RigidSystem(value),
        substeps_(substeps),
        matter_(system_),
        forces_(system_) {
    for (size_t i = 0; i < value.bodies.size(); ++i) AddBody(value, i);
    for (const PairSpring& spring : value.springs) {
      const PointPair& ends = spring.ends;
      SimTK::Force::TwoPointLinearSpring(
          forces_, matter_.getMobilizedBody(bodies_[ends.bodies[0]]),
          Theirs(ends.points[0]),
          matter_.getMobilizedBody(bodies_[ends.bodies[1]]),
          Theirs(ends.points[1]), spring.stiffness, spring.length);
    }
    SimTK::State state = system_.realizeTopology();
    SetMotion(value, &state);
    integrator_ = std::make_unique<SimTK::RungeKuttaMersonIntegrator>(system_);
    integrator_->setFixedStepSize(kPeerTimeStep / substeps);
    // No step is refused for its error, and none is shortened.
    integrator_->setAccuracy(0.1);
    integrator_->initialize(state);
  }

  std::string Step() override {
    ++steps_;
    try {
      integrator_->stepTo(kPeerTimeStep * static_cast<double>(steps_));
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }

  std::string Settings() const override {
    return absl::StrCat(
        "double; tree of mobilizers with quaternions; RungeKuttaMerson, fixed "
        "steps of ",
        1e3 * kPeerTimeStep / substeps_, " ms, no error control");
  }

 protected:
  std::vector<RigidMotion> Bodies() const override {
    std::vector<RigidMotion> result = start();
    const SimTK::State& state = integrator_->getState();
    system_.realize(state, SimTK::Stage::Velocity);
    for (size_t i = 0; i < result.size(); ++i) {
      const SimTK::MobilizedBody& body = matter_.getMobilizedBody(bodies_[i]);
      const SimTK::Transform& place = body.getBodyTransform(state);
      const SimTK::SpatialVec& velocity = body.getBodyVelocity(state);
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
          result[i].attitude(row, column) = place.R()[row][column];
        }
      }
      result[i].position = Ours(place.p());
      result[i].angular_velocity = Ours(velocity[0]);
      result[i].velocity = Ours(velocity[1]);
    }
    return result;
  }

 private:
  void AddBody(const PeerCase& value, size_t i) {
    const RigidMotion& motion = value.bodies[i];
    const SimTK::Body::Rigid body(SimTK::MassProperties(
        motion.mass, SimTK::Vec3(0),
        SimTK::Inertia(motion.inertia(0), motion.inertia(1),
                       motion.inertia(2))));
    if (i == 0 || value.joints.empty()) {
      bodies_.push_back(SimTK::MobilizedBody::Free(matter_.Ground(), body)
                            .getMobilizedBodyIndex());
      return;
    }
    const PointPair& joint = value.joints[i - 1];
    SimTK::MobilizedBody& parent =
        matter_.updMobilizedBody(bodies_[joint.bodies[0]]);
    bodies_.push_back(SimTK::MobilizedBody::Ball(
                          parent, SimTK::Transform(Theirs(joint.points[0])),
                          body, SimTK::Transform(Theirs(joint.points[1])))
                          .getMobilizedBodyIndex());
  }

  // Attitudes are the identity, so all axes are the inertial ones, and the
  // velocity of a joint's child is what the joint makes of it.
  void SetMotion(const PeerCase& value, SimTK::State* state) const {
    for (size_t i = 0; i < value.bodies.size(); ++i) {
      const RigidMotion& motion = value.bodies[i];
      const SimTK::MobilizedBody& body = matter_.getMobilizedBody(bodies_[i]);
      if (i == 0 || value.joints.empty()) {
        body.setQToFitTransform(*state,
                                SimTK::Transform(Theirs(motion.position)));
        body.setUToFitVelocity(
            *state, SimTK::SpatialVec(Theirs(motion.angular_velocity),
                                      Theirs(motion.velocity)));
        continue;
      }
      const RigidMotion& parent = value.bodies[value.joints[i - 1].bodies[0]];
      body.setUToFitAngularVelocity(
          *state, Theirs(motion.angular_velocity - parent.angular_velocity));
    }
  }

  int substeps_;
  int64_t steps_ = 0;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::vector<SimTK::MobilizedBodyIndex> bodies_;
  std::unique_ptr<SimTK::RungeKuttaMersonIntegrator> integrator_;
};

}  // namespace

std::unique_ptr<PeerSystem> MakeSimbody(const PeerCase& value, int substeps) {
  return std::make_unique<SimbodySystem>(value, substeps);
}

}  // namespace emmy::verification
