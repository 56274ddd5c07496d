// The box of the paper: 3 × 2 × 1 m, 2700 kg/m³, ω₀ = (0.3, 0.5, 0.8) rad/s;
// M = 16200 kg, Mⁱⁱ = (12150, 5400, 1350), J = (6750, 13500, 17550) kg m².

#ifndef EMMY_TESTS_SUPPORT_PAPER_BOX_H_
#define EMMY_TESTS_SUPPORT_PAPER_BOX_H_

#include "emmy/element/ancf_rigid_body.h"
#include "emmy/element/rigid_body_inertia.h"
#include "emmy/model/model_description.h"

namespace emmy {

inline constexpr double kPaperBoxEnergy = 7607.25;  // ½ ω·Jω [J]
inline constexpr double kPaperBoxVolume = 6.0;      // [m³]
inline constexpr double kPaperBoxMass = 16200.0;    // [kg]

inline Vector3d PaperBoxOmega() { return {0.3, 0.5, 0.8}; }

inline RigidBodyInertia PaperBoxInertia() {
  return RigidBodyInertia::Box({3.0, 2.0, 1.0}, 2700.0);
}

// `penalty` [Pa] only counts for an ANCF body.
inline RigidBodyDescription PaperBox(
    Formulation formulation = Formulation::kAncf, double penalty = 1e10) {
  RigidBodyDescription box;
  box.name = "box";
  box.formulation = formulation;
  box.inertia = BoxInertia{.size = {3.0, 2.0, 1.0}, .density = 2700.0};
  if (formulation == Formulation::kAncf) box.penalty = penalty;
  box.angular_velocity = PaperBoxOmega();
  return box;
}

inline AncfRigidBody PaperBoxElement(double penalty = 1e10) {
  return *AncfRigidBody::Create(PaperBoxInertia(), Vector6d::Constant(penalty));
}

inline ModelDescription ModelOf(const RigidBodyDescription& body) {
  ModelDescription description;
  description.rigid_bodies.push_back(body);
  return description;
}

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_PAPER_BOX_H_
