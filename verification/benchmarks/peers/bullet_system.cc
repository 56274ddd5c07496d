// Bullet: sequential impulses, semi-implicit Euler.

#include <btBulletDynamicsCommon.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "verification/benchmarks/peers/peer_system.h"

namespace emmy::verification {
namespace {

btVector3 Bullet(const Vector3d& v) { return {v(0), v(1), v(2)}; }
Vector3d Ours(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

// Nothing collides here, and nothing should be spent on looking for it.
class FreeWorld : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
  void performDiscreteCollisionDetection() override {}
};

class BulletSystem : public RigidSystem {
 public:
  BulletSystem(const PeerCase& value, int iterations)
      : RigidSystem(value),
        iterations_(iterations),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    world_.setGravity({0.0, 0.0, 0.0});
    world_.getSolverInfo().m_numIterations = iterations;
    // The default of 100 N m clamps the gyroscopic torque.
    world_.getSolverInfo().m_maxGyroscopicForce = 1e30;
    for (const RigidMotion& motion : value.bodies) AddBody(motion);
    for (const PointPair& joint : value.joints) {
      joints_.push_back(std::make_unique<btPoint2PointConstraint>(
          *bodies_[joint.bodies[0]], *bodies_[joint.bodies[1]],
          Bullet(joint.points[0]), Bullet(joint.points[1])));
      world_.addConstraint(joints_.back().get(), true);
    }
  }

  ~BulletSystem() override {
    for (const auto& joint : joints_) world_.removeConstraint(joint.get());
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }

  std::string Step() override {
    world_.stepSimulation(kPeerTimeStep, 0);  // One step as long as asked.
    return "";
  }

  std::string Settings() const override {
    return absl::StrCat(
        "double; btPoint2PointConstraint, ", iterations_,
        " iterations; implicit gyroscopic term in body axes, not clamped; no "
        "damping, sleep or collision detection");
  }

 protected:
  std::vector<RigidMotion> Bodies() const override {
    std::vector<RigidMotion> result = start();
    for (size_t i = 0; i < result.size(); ++i) {
      const btRigidBody& body = *bodies_[i];
      result[i].position = Ours(body.getWorldTransform().getOrigin());
      for (int row = 0; row < 3; ++row) {
        result[i].attitude.row(row) =
            Ours(body.getWorldTransform().getBasis()[row]).transpose();
      }
      result[i].velocity = Ours(body.getLinearVelocity());
      result[i].angular_velocity = Ours(body.getAngularVelocity());
    }
    return result;
  }

 private:
  void AddBody(const RigidMotion& motion) {
    btRigidBody::btRigidBodyConstructionInfo info(motion.mass, nullptr, &shape_,
                                                  Bullet(motion.inertia));
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin(Bullet(motion.position));
    info.m_linearDamping = 0.0;
    info.m_angularDamping = 0.0;
    auto body = std::make_unique<btRigidBody>(info);
    body->setLinearVelocity(Bullet(motion.velocity));
    body->setAngularVelocity(Bullet(motion.angular_velocity));
    body->setFlags(BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
    body->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(body.get(), 0, 0);
    bodies_.push_back(std::move(body));
  }

  int iterations_;
  btEmptyShape shape_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  FreeWorld world_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

}  // namespace

std::unique_ptr<PeerSystem> MakeBullet(const PeerCase& value, int iterations) {
  return std::make_unique<BulletSystem>(value, iterations);
}

}  // namespace emmy::verification
