// Open Dynamics Engine: semi-implicit Euler, joints by its direct or its
// iterative solver.

#include <ode/ode.h>

#include <memory>

#include "emmy/base/check.h"
#include "verification/benchmarks/peers/peer_system.h"

namespace emmy::verification {
namespace {

static_assert(sizeof(dReal) == sizeof(double), "ODE in double precision");

// Of the whole program, and never ended: worlds may go in any order.
void InitializeOnce() {
  static const bool done = dInitODE2(0) != 0;
  EMMY_CHECK(done, "dInitODE2");
}

class OdeSystem : public RigidSystem {
 public:
  OdeSystem(const PeerCase& value, OdeStepper stepper)
      : RigidSystem(value),
        stepper_(stepper),
        has_springs_(!value.springs.empty()) {
    InitializeOnce();
    world_ = dWorldCreate();
    dWorldSetGravity(world_, 0.0, 0.0, 0.0);
    dWorldSetAutoDisableFlag(world_, 0);
    dWorldSetDamping(world_, 0.0, 0.0);
    for (const RigidMotion& motion : value.bodies) AddBody(motion);
    for (const PointPair& joint : value.joints) AddJoint(joint);
    for (const PairSpring& spring : value.springs) AddSpring(spring);
  }

  ~OdeSystem() override { dWorldDestroy(world_); }

  std::string Step() override {
    const int ok = stepper_ == OdeStepper::kDirect
                       ? dWorldStep(world_, kPeerTimeStep)
                       : dWorldQuickStep(world_, kPeerTimeStep);
    return ok != 0 ? "" : "ODE cannot step";
  }

  std::string Settings() const override {
    std::string text = stepper_ == OdeStepper::kDirect
                           ? "double; dWorldStep"
                           : "double; dWorldQuickStep, 20 iterations";
    if (has_springs_) {
      text += "; dJointTypeDBall with ERP = 1, CFM = 1 / (h k)";
    }
    return text + "; gyroscopic mode, finite rotation; no damping or disabling";
  }

 protected:
  std::vector<RigidMotion> Bodies() const override {
    std::vector<RigidMotion> result = start();
    for (size_t i = 0; i < result.size(); ++i) {
      const dReal* rotation = dBodyGetRotation(bodies_[i]);  // Rows of four.
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
          result[i].attitude(row, column) = rotation[4 * row + column];
        }
      }
      result[i].position = Ours(dBodyGetPosition(bodies_[i]));
      result[i].velocity = Ours(dBodyGetLinearVel(bodies_[i]));
      result[i].angular_velocity = Ours(dBodyGetAngularVel(bodies_[i]));
    }
    return result;
  }

 private:
  static Vector3d Ours(const dReal* v) { return {v[0], v[1], v[2]}; }

  void AddBody(const RigidMotion& motion) {
    dBodyID body = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, motion.mass, 0.0, 0.0, 0.0, motion.inertia(0),
                       motion.inertia(1), motion.inertia(2), 0.0, 0.0, 0.0);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, motion.position(0), motion.position(1),
                     motion.position(2));
    dBodySetLinearVel(body, motion.velocity(0), motion.velocity(1),
                      motion.velocity(2));
    dBodySetAngularVel(body, motion.angular_velocity(0),
                       motion.angular_velocity(1), motion.angular_velocity(2));
    dBodySetGyroscopicMode(body, 1);
    dBodySetFiniteRotationMode(body, 1);
    bodies_.push_back(body);
  }

  // At the start, where attitudes are the identity.
  Vector3d Place(const PointPair& pair, size_t end) const {
    return start()[pair.bodies[end]].position + pair.points[end];
  }

  void AddJoint(const PointPair& pair) {
    dJointID joint = dJointCreateBall(world_, nullptr);
    dJointAttach(joint, bodies_[pair.bodies[0]], bodies_[pair.bodies[1]]);
    const Vector3d place = Place(pair, 0);
    dJointSetBallAnchor(joint, place(0), place(1), place(2));
  }

  void AddSpring(const PairSpring& spring) {
    dJointID joint = dJointCreateDBall(world_, nullptr);
    dJointAttach(joint, bodies_[spring.ends.bodies[0]],
                 bodies_[spring.ends.bodies[1]]);
    const Vector3d first = Place(spring.ends, 0);
    const Vector3d second = Place(spring.ends, 1);
    dJointSetDBallAnchor1(joint, first(0), first(1), first(2));
    dJointSetDBallAnchor2(joint, second(0), second(1), second(2));
    dJointSetDBallDistance(joint, spring.length);
    dJointSetDBallParam(joint, dParamERP, 1.0);
    dJointSetDBallParam(joint, dParamCFM,
                        1.0 / (kPeerTimeStep * spring.stiffness));
  }

  OdeStepper stepper_;
  bool has_springs_;
  dWorldID world_ = nullptr;
  std::vector<dBodyID> bodies_;
};

}  // namespace

std::unique_ptr<PeerSystem> MakeOde(const PeerCase& value, OdeStepper stepper) {
  return std::make_unique<OdeSystem>(value, stepper);
}

}  // namespace emmy::verification
