// Rigid body in absolute nodal coordinates: centre of mass and three gradient
// vectors, held rigid by a strain penalty ("affine body").
//
//   coordinates x̄, e₁, e₂, e₃ ∈ ℝ³, inertial frame; R = [e₁ e₂ e₃]
//   x(ξ) = x̄ + ξⁱ eᵢ,  ẋ(ξ) = x̄̇ + ξⁱ ėᵢ                           (KIN-1)
//   T = ½ M |x̄̇|² + ½ Mⁱʲ ėᵢ·ėⱼ                                    (ANCF-1)
//   εᵢ = ½ (eᵢ·eᵢ − 1), i = 1, 2, 3;
//   ε₄ = e₁·e₂, ε₅ = e₂·e₃, ε₆ = e₃·e₁                            (ANCF-4)
//   U = ½ Σₖ bₖ εₖ²,  bₖ = V αₖ  [J]                               (ANCF-5)
//   fᵢ = ∂U/∂eᵢ = bᵢ εᵢ eᵢ + Σ b_l ε_l (δₙᵢ eₘ + δₘᵢ eₙ),
//   (l, m, n) ∈ {(4, 1, 2), (5, 2, 3), (6, 3, 1)}                  (ANCF-6)
//
// Every point is linear in the coordinates, hence the mass matrix is constant.
// Energy and force have one form for an instant (vectors eᵢ, strain ε) and for
// a step (mean vectors ēᵢ, mean strain ε̄): see quadratic_strain.h.
//
// Not modelled: rigidity itself. A finite penalty leaves strains of the order
// M ω² / b and a vibration of frequency √(b/M).

#ifndef EMMY_ELEMENT_ANCF_RIGID_BODY_H_
#define EMMY_ELEMENT_ANCF_RIGID_BODY_H_

#include <array>

#include "absl/status/statusor.h"
#include "emmy/base/export.h"
#include "emmy/base/types.h"
#include "emmy/element/rigid_body_inertia.h"

namespace emmy {

class EMMY_EXPORT AncfRigidBody {
 public:
  static constexpr int kNumStrains = 6;       // (ANCF-4)
  static constexpr int kNumCoordinates = 12;  // x̄, e₁, e₂, e₃.

  // The vectors whose product is shear strain 3 + k, by index from 0.
  struct VectorPair {
    int m;  // Of the first,
    int n;  // and of the second.
  };
  // Of ε₄, ε₅, ε₆.
  static constexpr std::array<VectorPair, 3> kShearPairs = {
      {{0, 1}, {1, 2}, {2, 0}}};

  // `penalty` holds αₖ [Pa] in the order of (ANCF-4). Fails with
  // kInvalidArgument, naming the entry, if one is not finite and positive.
  static absl::StatusOr<AncfRigidBody> Create(const RigidBodyInertia& inertia,
                                              const Vector6d& penalty);

  // All of mass, volume, second moments and tensor.
  const RigidBodyInertia& inertia() const { return inertia_; }
  double mass() const { return inertia_.mass; }  // M [kg]
  // Mⁱʲ [kg m²], body axes.
  const Matrix3d& second_moment() const { return inertia_.second_moment; }
  // bₖ of (ANCF-5) [J].
  const Vector6d& penalty_stiffness() const { return stiffness_; }

  // (ANCF-4). Cancels near a rotation: absolute error of a few u. A step
  // advances strains by StrainIncrement and never calls this.
  static Vector6d Strain(const Matrix3d& gradients);

  // (QS-1) for the six strains: exact for any increment.
  static Vector6d StrainIncrement(const Matrix3d& mean_gradients,
                                  const Matrix3d& gradient_increment);

  // (ANCF-5) [J]
  double PenaltyEnergy(const Vector6d& strain) const;

  // (ANCF-6) [N m], column i acts on eᵢ. With mean vectors and mean strain it
  // is the work-exact force of a step.
  Matrix3d InternalForce(const Matrix3d& gradients,
                         const Vector6d& strain) const;

 private:
  AncfRigidBody(const RigidBodyInertia& inertia, const Vector6d& stiffness)
      : inertia_(inertia), stiffness_(stiffness) {}

  RigidBodyInertia inertia_;
  Vector6d stiffness_;
};

}  // namespace emmy

#endif  // EMMY_ELEMENT_ANCF_RIGID_BODY_H_
