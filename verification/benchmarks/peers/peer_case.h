// What is stepped by several engines: rigid bodies, ball joints and a spring,
// in plain numbers that every engine can be given.

#ifndef EMMY_VERIFICATION_BENCHMARKS_PEERS_PEER_CASE_H_
#define EMMY_VERIFICATION_BENCHMARKS_PEERS_PEER_CASE_H_

#include <array>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/model/model_description.h"

namespace emmy::verification {

// A rigid body whose body axes are its principal axes.
struct RigidMotion {
  double mass = 0.0;                             // [kg]
  Vector3d inertia = Vector3d::Zero();           // Principal [kg m^2].
  Vector3d position = Vector3d::Zero();          // Centre of mass [m].
  Matrix3d attitude = Matrix3d::Identity();      // Body to inertial axes.
  Vector3d velocity = Vector3d::Zero();          // [m/s]
  Vector3d angular_velocity = Vector3d::Zero();  // Inertial [rad/s].
};

// Points of two bodies, in the axes of each.
struct PointPair {
  std::array<size_t, 2> bodies = {};
  std::array<Vector3d, 2> points = {Vector3d::Zero(), Vector3d::Zero()};
};

struct PairSpring {
  PointPair ends;
  double stiffness = 0.0;  // [N/m]
  double length = 0.0;     // Natural length [m].
};

// Attitudes are the identity at the start. Body i > 0 of a case with joints is
// the second body of joint i - 1, so that the joints make a tree.
struct PeerCase {
  std::vector<RigidMotion> bodies;
  std::vector<PointPair> joints;
  std::vector<PairSpring> springs;
};

constexpr double kPeerTimeStep = 1e-3;  // [s]

// The paper's box (verification/runs/paper_box.h).
PeerCase PeerBox();

// The same and the paper's truss in the two ways in which engines have it: a
// rigid bar of its mass on a ball joint, or a spring of its stiffness EA / L
// to a mass point with half of its mass. (The other half, 1e-5 of the box's
// mass, would be at the box's corner and is left out.)
PeerCase PeerBoxWithRigidBar();
PeerCase PeerBoxWithSpring();

// n of the paper's boxes at rest but turning, each with another angular
// velocity; the same for Emmy's own formulations.
ModelDescription FreeBoxes(int n, Formulation formulation);
PeerCase PeerFreeBoxes(int n);

// The chain of verification/models/large_models.h.
PeerCase PeerChain(int n);

// Bodies that are boxes without rotation at the start, and shared points of
// two bodies; nothing else may be in the description.
PeerCase PeerCaseOf(const ModelDescription& description);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_BENCHMARKS_PEERS_PEER_CASE_H_
