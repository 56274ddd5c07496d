#include "verification/exact/free_rigid_body.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "absl/status/status.h"
#include "emmy/base/check.h"
#include "verification/exact/attitude.h"
#include "verification/exact/principal_axes.h"

namespace emmy::exact {
namespace {

using std::abs;
using std::ceil;
using std::cos;
using std::floor;
using std::isfinite;
using std::ldexp;
using std::sin;
using std::sqrt;

// Components of n below this would leave the range of T when squared.
template <typename T>
T Negligible() {
  using Limits = std::numeric_limits<T>;
  return ldexp(T{1}, Limits::min_exponent / 2 + Limits::digits);
}

template <typename T>
T Sign(const T& x) {
  return x < 0 ? T{-1} : T{1};
}

// |v| without overflow or underflow.
template <typename T>
T Norm(const Vector3<T>& v) {
  const T scale = v.cwiseAbs().maxCoeff();
  if (scale == 0) return T{0};
  const Vector3<T> scaled = v / scale;
  return scale * sqrt(scaled.squaredNorm());
}

template <typename T>
bool IsRotation(const Matrix3<T>& r) {
  const Matrix3<T> excess = r.transpose() * r - Matrix3<T>::Identity();
  // Written so that NaN fails.
  return excess.cwiseAbs().maxCoeff() < T{1e-6} &&
         r.col(0).cross(r.col(1)).dot(r.col(2)) > 0;
}

template <typename T>
bool IsFinite(const Vector3<T>& v) {
  return isfinite(v(0)) && isfinite(v(1)) && isfinite(v(2));
}

// D of (TOP-4) as a product, so that its sign and size keep all the digits
// that n and the moments carry.
template <typename T>
T SeparatrixDistance(const Vector3<T>& n, const Vector3<T>& j) {
  const T first = abs(n(0)) * sqrt((j(1) - j(0)) / j(0));
  const T third = abs(n(2)) * sqrt((j(2) - j(1)) / j(2));
  return (first - third) * (first + third);
}

// F(n) of (TOP-9); n must not be the axis a. Components below Negligible()
// are zero, so that the squares are in range.
template <typename T>
Matrix3<T> NodeFrame(const Vector3<T>& n) {
  const T length = sqrt(n(1) * n(1) + n(2) * n(2));
  Matrix3<T> frame;
  frame.col(0) = Vector3<T>(T{0}, -n(2) / length, n(1) / length);
  frame.col(1) = n.cross(Vector3<T>(frame.col(0)));
  frame.col(2) = n;
  return frame;
}

// 1 − c₀ c c₁ without cancellation where the product is positive.
template <typename T>
T OneMinusProduct(const JacobiValues<T>& p, const JacobiValues<T>& q,
                  const JacobiValues<T>& r) {
  const T product = p.cn * q.cn * r.cn;
  if (product < 0) return 1 - product;
  const auto one_minus = [](const JacobiValues<T>& v) {
    return v.sn * v.sn / (1 + abs(v.cn));
  };
  return one_minus(p) + abs(p.cn) * (one_minus(q) + abs(q.cn) * one_minus(r));
}

}  // namespace

template <typename T>
absl::StatusOr<FreeRigidBody<T>> FreeRigidBody<T>::Create(
    const FreeRigidBodyStart<T>& start) {
  if (!IsRotation(start.attitude)) {
    return absl::InvalidArgumentError("attitude must be a rotation matrix");
  }
  if (!IsFinite(start.angular_velocity)) {
    return absl::InvalidArgumentError(
        "angular_velocity must be finite [rad/s]");
  }
  const absl::StatusOr<PrincipalAxes<T>> principal =
      FindPrincipalAxes(start.inertia);
  if (!principal.ok()) return principal.status();

  const Matrix3<T> attitude = NearestRotation(start.attitude);
  const Vector3<T> omega =
      start.angular_velocity_frame == Frame::kBody
          ? start.angular_velocity
          : Vector3<T>(attitude.transpose() * start.angular_velocity);
  FreeRigidBody body;
  body.moments_ = principal->moments;
  body.axes_ = principal->axes;
  Vector3<T> n = body.moments_.cwiseProduct(body.axes_.transpose() * omega);
  body.momentum_ = Norm(n);
  if (body.momentum_ > 0) n /= body.momentum_;
  n = n.unaryExpr(
      [](const T& x) { return abs(x) < Negligible<T>() ? T{0} : x; });
  body.polhode_ = Polhode::kAroundSmallest;
  const T distance = SeparatrixDistance(n, body.moments_);
  if (distance < 0) {
    // a = 3, c = 1: an odd exchange, made right-handed by turning c round.
    body.polhode_ = Polhode::kAroundLargest;
    body.moments_.row(0).swap(body.moments_.row(2));
    body.axes_.col(0).swap(body.axes_.col(2));
    body.axes_.col(2) = -body.axes_.col(2);
    n = Vector3<T>(n(2), n(1), -n(0));
  }
  body.direction_ = n;
  body.attitude_ = attitude * body.axes_;

  const T& ja = body.moments_(0);
  const T& jb = body.moments_(1);
  const T& jc = body.moments_(2);
  const T ab = abs(ja - jb);
  const T bc = abs(jb - jc);
  const T ac = abs(ja - jc);
  if ((bc == 0 || n(1) == 0 || n(2) == 0) &&
      (ac == 0 || n(2) == 0 || n(0) == 0) &&
      (ab == 0 || n(0) == 0 || n(1) == 0)) {
    body.polhode_ = Polhode::kPoint;
    return body;
  }
  const Vector3<T> square = n.cwiseProduct(n);
  body.delta_a_ = square(1) * ab / jb + square(2) * ac / jc;
  body.delta_c_ = square(1) * bc / jb + square(0) * ac / ja;
  const T part = bc * body.delta_a_;
  const T complement = ac * abs(distance);
  body.parameter_ = {part / (part + complement),
                     complement / (part + complement)};
  if (body.parameter_.m1 == 0) body.polhode_ = Polhode::kSeparatrix;
  body.rate_ = sqrt(ab * body.delta_c_ / ja / jb / jc);
  body.nu_ = ja * bc / (jc * ab);
  body.k_ = Vector3<T>((jb - jc) / (jb * jc), (jc - ja) / (jc * ja),
                       (ja - jb) / (ja * jb));
  body.functions_.emplace(body.parameter_);
  body.integral_.emplace(body.parameter_, body.nu_);
  return body;
}

template <typename T>
FreeRigidBodyState<T> FreeRigidBody<T>::At(const T& time) const {
  EMMY_CHECK(isfinite(time), "time = " << time);
  Vector3<T> n = direction_;
  Matrix3<T> turned = attitude_;
  if (polhode_ == Polhode::kPoint) {
    const Vector3<T> angle = (momentum_ * time) * n.cwiseQuotient(moments_);
    turned = (attitude_ * RotationFromVector(angle)).eval();
  } else {
    const T argument = rate_ * (momentum_ * time);
    const JacobiValues<T> values = functions_->At(argument);
    n = Direction(time, values);
    turned = (attitude_ * Precession(time, argument, values, n)).eval();
  }
  FreeRigidBodyState<T> state;
  state.attitude = turned * axes_.transpose();
  const Vector3<T> omega = momentum_ * n.cwiseQuotient(moments_);
  state.body_angular_velocity = axes_ * omega;
  state.angular_velocity = turned * omega;
  state.angular_momentum = turned * (momentum_ * n);
  return state;
}

// (TOP-6), normalised.
template <typename T>
Vector3<T> FreeRigidBody<T>::Direction(const T& time,
                                       const JacobiValues<T>& values) const {
  if (time == 0) return direction_;
  const Vector3<T>& n = direction_;
  const T s = values.sn / rate_;
  Vector3<T> next(n(0) * values.dn + k_(0) * n(1) * n(2) * s * values.cn,
                  n(1) * values.cn * values.dn + k_(1) * n(2) * n(0) * s,
                  n(2) * values.cn + k_(2) * n(0) * n(1) * s * values.dn);
  return next / Norm(next);
}

template <typename T>
JacobiValues<T> FreeRigidBody<T>::PhaseOf(const Vector3<T>& direction) const {
  const T ab = abs(moments_(0) - moments_(1));
  const T ac = abs(moments_(0) - moments_(2));
  const T sn = direction(1) * sqrt(ab / (moments_(1) * delta_a_));
  const T cn = direction(2) * sqrt(ac / (moments_(2) * delta_a_));
  const T dn = direction(0) * sqrt(ac / (moments_(0) * delta_c_));
  return {sn, cn, dn};
}

// F(n(0)) R_z(ψ) F(n(t))ᵀ of (TOP-7..9).
template <typename T>
Matrix3<T> FreeRigidBody<T>::Precession(const T& time, const T& argument,
                                        const JacobiValues<T>& values,
                                        const Vector3<T>& direction) const {
  const T factor = k_(1) * nu_ / rate_;
  const T secular =
      momentum_ * time / moments_(2) + factor * integral_->At(argument, values);
  const JacobiValues<T> start = PhaseOf(direction_);
  const JacobiValues<T> end = PhaseOf(direction);
  // χ as a vector in the plane; k_b in `factor` gives it the right sign.
  const T opposite = factor * start.sn * values.sn * end.sn;
  const T adjacent = 1 + nu_ * OneMinusProduct(start, values, end);
  const T c0 = cos(secular);
  const T s0 = sin(secular);
  const T cosine = c0 * adjacent - s0 * opposite;
  const T sine = s0 * adjacent + c0 * opposite;
  const T length = sqrt(cosine * cosine + sine * sine);
  const T c = cosine / length;
  const T s = sine / length;
  Matrix3<T> turn;
  turn << c, -s, T{0}, s, c, T{0}, T{0}, T{0}, T{1};
  return NodeFrame(direction_) * turn * NodeFrame(direction).transpose();
}

template <typename T>
std::optional<T> FreeRigidBody<T>::Period() const {
  if (polhode_ == Polhode::kPoint || polhode_ == Polhode::kSeparatrix) {
    return std::nullopt;
  }
  return 4 * functions_->quarter_period() / (rate_ * momentum_);
}

template <typename T>
std::vector<T> FreeRigidBody<T>::FlipTimes(const T& from, const T& to) const {
  std::vector<T> times;
  if (polhode_ == Polhode::kPoint) return times;
  // u₀ with the amplitudes of n_a and n_c taken positive at the start; that of
  // n_b then has the sign of k_b times theirs.
  JacobiValues<T> phase = PhaseOf(direction_);
  phase.sn *= Sign(phase.cn) * Sign(phase.dn) * Sign(k_(1));
  const T first = -InverseJacobi(phase) / (rate_ * momentum_);
  if (polhode_ == Polhode::kSeparatrix) {
    if (from <= first && first <= to) times.push_back(first);
    return times;
  }
  const T interval = 2 * functions_->quarter_period() / (rate_ * momentum_);
  const T last = floor((to - first) / interval);
  T index = ceil((from - first) / interval);
  const auto count = static_cast<int64_t>(last - index) + 1;
  for (int64_t i = 0; i < count; ++i) {
    times.push_back(first + index * interval);
    index += 1;
  }
  return times;
}

template class FreeRigidBody<double>;
template class FreeRigidBody<Quad>;

}  // namespace emmy::exact
