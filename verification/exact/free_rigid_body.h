// The torque-free rigid body in closed form: angular velocity and attitude at
// any time, from any start.
//
//   l̇ = l × ω,  l = J ω,  Ṙ = R ω̂    (body axes; R: body → inertial) (TOP-3)
//
// Principal moments J₁ ≤ J₂ ≤ J₃, L = |l|, n = l / L. The tip of l circles
//   D = L⁻² Σ lᵢ² (J₂ − Jᵢ) / Jᵢ                                  [-] (TOP-4)
//   axis a = 1, other end c = 3, if D > 0;  a = 3, c = 1, if D < 0;  b = 2.
// In right-handed axes (a, b, c), with every difference of moments taken as
// such and every sum one of terms of equal sign:
//   Δa = n_b² |J_a−J_b|/J_b + n_c² |J_a−J_c|/J_c
//   Δc = n_b² |J_b−J_c|/J_b + n_a² |J_a−J_c|/J_a
//   m : m1 : 1 = |J_b−J_c| Δa : |J_a−J_c| |D| : |J_a−J_b| Δc          (TOP-5)
//   λ² = L² |J_a−J_b| Δc / (J_a J_b J_c)                       [rad²/s²]
//
// Angular momentum, with s, c, d = sn, cn, dn(λ t | m), S = L s / λ and
// k_a = 1/J_c − 1/J_b, k_b = 1/J_a − 1/J_c, k_c = 1/J_b − 1/J_a; n at t = 0
// on the right (k_a k_b ≤ 0, so that N is a sum of squares):
//   N n_a(t) = n_a d + k_a n_b n_c S c
//   N n_b(t) = n_b c d + k_b n_c n_a S                                (TOP-6)
//   N n_c(t) = n_c c + k_c n_a n_b S d,     N = d² − k_a k_b n_c² S²
//
// Attitude: the node x = (axis a) × L / |…| turns about L by ψ,
//   ψ = L t / J_c + (L k_b ν / λ) P(λ t; ν, m) + sign(k_b) χ          (TOP-7)
//   ν = J_a (J_b−J_c) / (J_c (J_a−J_b)) ≥ 0,   P: (ELL-2)
//   χ = atan2(L |k_b| ν/λ · s₀ s s₁, 1 + ν (1 − c₀ c c₁)),  |χ| < ½ π  (TOP-8)
//   s₀, s₁ = n_b √(|J_a−J_b| / (J_b Δa)) at 0 and t;  c₀, c₁ likewise with c
//   R(t) = R(0) F(n(0)) R_z(ψ) F(n(t))ᵀ,  F(n) = [x, n × x, n]        (TOP-9)
//
// The addition theorems leave no initial phase: the solution starts from the
// given state itself, and stays regular where the phase is undefined.
// ω is constant if l × ω = 0 (spin about a principal axis, also the middle
// one; two or three equal moments; rest): R(t) = R(0) exp(ω̂ t)       (TOP-10)
//
//   period of body ω: 4 K(m) / λ; n_b changes sign at (2 i K − u₀) / λ (TOP-11)
//
// Accuracy, with u = ε/2 of T and v = L / J₁ ≥ |ω|: the result is the exact
// motion of a body whose moments, ω(0) and time differ by relative parts of at
// most 8 u (measured 4 u). R and ω/v then err by
//   a few u (1 + v |t|)                     where the motion is stable;
//   up to u / δ,                            for starts at distance δ from the
// middle axis or the separatrix, since the motion itself amplifies a change of
// its start that much. In double, components of n below 4e-139 count as zero.
// R is orthonormal, and |ω|, energy and L are constant, to 24 … 40 u at any
// time. Reference values are computed in Quad from data in double and rounded
// once: correct to the last digit but for δ or 1 / (v |t|) below 1e-16.
//
// Derivation: docs/theory.md (TOP-3..11), after Jacobi (1850); Whittaker,
// Analytical Dynamics, §69; Landau & Lifshitz, Mechanics, §37; DLMF 19.11,
// 22.8. Not modelled: translation, torques.

#ifndef EMMY_VERIFICATION_EXACT_FREE_RIGID_BODY_H_
#define EMMY_VERIFICATION_EXACT_FREE_RIGID_BODY_H_

#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "verification/exact/jacobi_elliptic.h"
#include "verification/exact/real.h"

namespace emmy::exact {

enum class Frame { kBody, kInertial };

template <typename T>
struct FreeRigidBodyStart {
  Matrix3<T> inertia = Matrix3<T>::Identity();       // J, body axes [kg m²]
  Matrix3<T> attitude = Matrix3<T>::Identity();      // R(0)
  Vector3<T> angular_velocity = Vector3<T>::Zero();  // ω(0) [rad/s]
  Frame angular_velocity_frame = Frame::kBody;

  template <typename U>
  FreeRigidBodyStart<U> Cast() const {
    return {inertia.template cast<U>(), attitude.template cast<U>(),
            angular_velocity.template cast<U>(), angular_velocity_frame};
  }
};

template <typename T>
struct FreeRigidBodyState {
  Matrix3<T> attitude;               // R, body → inertial
  Vector3<T> body_angular_velocity;  // ω in body axes [rad/s]
  Vector3<T> angular_velocity;       // R ω, inertial [rad/s]
  Vector3<T> angular_momentum;       // R J ω, inertial [kg m²/s]

  template <typename U>
  FreeRigidBodyState<U> Cast() const {
    return {attitude.template cast<U>(),
            body_angular_velocity.template cast<U>(),
            angular_velocity.template cast<U>(),
            angular_momentum.template cast<U>()};
  }
};

// Which curve the tip of l runs on in the body.
enum class Polhode { kPoint, kAroundSmallest, kAroundLargest, kSeparatrix };

template <typename T>
class FreeRigidBody {
 public:
  // Fails with kInvalidArgument, naming the field, if the inertia is not that
  // of a body (see FindPrincipalAxes), the attitude is not a rotation to
  // 1e-6, or the angular velocity is not finite. The nearest rotation is used.
  static absl::StatusOr<FreeRigidBody> Create(
      const FreeRigidBodyStart<T>& start);

  // State at any finite time, also negative [s].
  FreeRigidBodyState<T> At(const T& time) const;

  Polhode polhode() const { return polhode_; }
  const EllipticParameter<T>& parameter() const { return parameter_; }

  // Period of the body angular velocity (TOP-11) [s]; none if that is
  // constant or, on the separatrix, takes forever. The attitude is in general
  // not periodic.
  std::optional<T> Period() const;

  // Times in [from, to] at which the component about the middle axis changes
  // sign, ascending: the flips of a body spun about that axis. If two moments
  // are equal, one of the axes they leave open stands for the middle one.
  std::vector<T> FlipTimes(const T& from, const T& to) const;

 private:
  FreeRigidBody() = default;

  // n(t) of (TOP-6); `values` are those at λ t.
  Vector3<T> Direction(const T& time, const JacobiValues<T>& values) const;
  // F(n(0)) R_z(ψ) F(n(t))ᵀ of (TOP-9); `argument` is λ t, `direction` n(t).
  Matrix3<T> Precession(const T& time, const T& argument,
                        const JacobiValues<T>& values,
                        const Vector3<T>& direction) const;
  // sn, cn, dn of the phase at which n is `direction`, up to their signs.
  JacobiValues<T> PhaseOf(const Vector3<T>& direction) const;

  Polhode polhode_ = Polhode::kPoint;
  Vector3<T> moments_;    // J_a, J_b, J_c
  Matrix3<T> axes_;       // (a, b, c) → body axes
  Matrix3<T> attitude_;   // R(0) · axes_
  Vector3<T> direction_;  // n(0) in (a, b, c)
  T momentum_ = T{0};     // L
  EllipticParameter<T> parameter_;
  T rate_ = T{0};     // λ / L
  T nu_ = T{0};       // ν
  T delta_a_ = T{0};  // Δa
  T delta_c_ = T{0};  // Δc
  Vector3<T> k_;      // k_a, k_b, k_c
  std::optional<JacobiFunctions<T>> functions_;
  std::optional<ThirdKindIntegral<T>> integral_;
};

}  // namespace emmy::exact

#endif  // EMMY_VERIFICATION_EXACT_FREE_RIGID_BODY_H_
