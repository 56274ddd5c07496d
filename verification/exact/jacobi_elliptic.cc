#include "verification/exact/jacobi_elliptic.h"

#include <boost/math/constants/constants.hpp>
#include <boost/math/special_functions/ellint_rf.hpp>
#include <boost/math/special_functions/ellint_rj.hpp>
#include <boost/math/special_functions/expm1.hpp>
#include <cmath>

namespace emmy::exact {
namespace {

using std::abs;
using std::atan;
using std::cos;
using std::exp;
using std::floor;
using std::sin;
using std::sqrt;

// m1 = 0: sn = tanh, cn = dn = sech, without overflow for large |u|.
template <typename T>
JacobiValues<T> Hyperbolic(const T& u) {
  const T decay = exp(-abs(u));
  const T square = decay * decay;
  const T loss = -boost::math::expm1(-2 * abs(u));  // 1 − e^(−2|u|)
  const T tanh = loss / (1 + square);
  const T sech = 2 * decay / (1 + square);
  return {u < 0 ? -tanh : tanh, sech, sech};
}

// Descending Landen transformation: m → μ = r², r = (1 − √m1) / (1 + √m1).
// Converges quadratically to circular functions.
template <typename T>
JacobiValues<T> Descend(const T& u, const EllipticParameter<T>& p) {
  if (p.m < Epsilon<T>() / 8) {
    const T sn = sin(u);
    return {sn, cos(u), sqrt(1 - p.m * sn * sn)};
  }
  const T root = sqrt(p.m1);
  const T r = p.m / ((1 + root) * (1 + root));
  const JacobiValues<T> v = Descend<T>(u / (1 + r), {r * r, 1 - r * r});
  const T rs = r * v.sn * v.sn;
  return {(1 + r) * v.sn / (1 + rs), v.cn * v.dn / (1 + rs),
          (1 - rs) / (1 + rs)};
}

// Ascending Landen transformation: m1 → μ1 = r², r = (1 − √m) / (1 + √m).
// Converges quadratically to hyperbolic functions. The difference in cn is
// harmless for |u| ≤ ½ K, where r is less than a third of dn².
template <typename T>
JacobiValues<T> Ascend(const T& u, const EllipticParameter<T>& p) {
  if (64 * p.m1 < Epsilon<T>() * Epsilon<T>()) return Hyperbolic(u);
  const T root = sqrt(p.m);
  const T r = p.m1 / ((1 + root) * (1 + root));
  const JacobiValues<T> v = Ascend<T>(u / (1 + r), {1 - r * r, r * r});
  const T square = v.dn * v.dn;
  return {(1 + r) * v.sn * v.cn / v.dn, (square - r) / ((1 - r) * v.dn),
          (square + r) / ((1 + r) * v.dn)};
}

// For |u| ≤ ½ K, or any u if m1 = 0.
template <typename T>
JacobiValues<T> NearZero(const T& u, const EllipticParameter<T>& p) {
  return p.m <= p.m1 ? Descend(u, p) : Ascend(u, p);
}

template <typename T>
T Round(const T& x) {
  return floor(x + T{0.5});
}

// x − 4 floor(x / 4) for an integer x: 0, 1, 2 or 3.
template <typename T>
int Quadrant(const T& x) {
  return static_cast<int>(x - 4 * floor(x / 4));
}

}  // namespace

template <typename T>
T QuarterPeriod(const EllipticParameter<T>& parameter) {
  if (parameter.m1 == 0) return std::numeric_limits<T>::infinity();
  // Arithmetic-geometric mean. |a − b| is squared by each step, so that one
  // step after |a − b| < √ε a the two agree.
  T a = T{1};
  T b = sqrt(parameter.m1);
  const T stop = sqrt(Epsilon<T>());
  while (abs(a - b) > stop * a) {
    const T mean = (a + b) / 2;
    b = sqrt(a * b);
    a = mean;
  }
  return boost::math::constants::pi<T>() / (a + b);
}

template <typename T>
JacobiFunctions<T>::JacobiFunctions(const EllipticParameter<T>& parameter)
    : parameter_(parameter), quarter_period_(QuarterPeriod(parameter)) {}

template <typename T>
JacobiValues<T> JacobiFunctions<T>::At(const T& u) const {
  if (parameter_.m1 == 0) return Hyperbolic(u);
  const T turns = Round(u / quarter_period_);
  JacobiValues<T> v = NearZero<T>(u - turns * quarter_period_, parameter_);
  const int quadrant = Quadrant(turns);
  if (quadrant % 2 == 1) {
    const T root = sqrt(parameter_.m1);
    v = {v.cn / v.dn, -root * v.sn / v.dn, root / v.dn};
  }
  if (quadrant >= 2) {
    v.sn = -v.sn;
    v.cn = -v.cn;
  }
  return v;
}

template <typename T>
ThirdKindIntegral<T>::ThirdKindIntegral(const EllipticParameter<T>& parameter,
                                        const T& nu)
    : nu_(nu),
      quarter_period_(QuarterPeriod(parameter)),
      complete_(parameter.m1 == 0
                    ? std::numeric_limits<T>::infinity()
                    : boost::math::ellint_rj(T{0}, parameter.m1, T{1}, 1 + nu) /
                          3) {}

template <typename T>
T ThirdKindIntegral<T>::At(const T& u, const JacobiValues<T>& values) const {
  const bool periodic = quarter_period_ < std::numeric_limits<T>::infinity();
  if (!periodic && abs(u) > 1) {
    // m1 = 0 in elementary functions; no cancellation for |u| > 1.
    const T root = sqrt(nu_);
    const T angle = nu_ == 0 ? values.sn : atan(root * values.sn) / root;
    return (u - angle) / (1 + nu_);
  }
  const T half_turns = periodic ? Round(u / (2 * quarter_period_)) : T{0};
  // sn at u − 2K half_turns; its sign is lost in the squares of the others.
  const T s = Quadrant(half_turns) % 2 == 1 ? -values.sn : values.sn;
  const T rest =
      s * s * s *
      boost::math::ellint_rj(values.cn * values.cn, values.dn * values.dn, T{1},
                             1 + nu_ * s * s) /
      3;
  return half_turns == 0 ? rest : 2 * half_turns * complete_ + rest;
}

template <typename T>
T InverseJacobi(const JacobiValues<T>& values) {
  return values.sn * boost::math::ellint_rf(values.cn * values.cn,
                                            values.dn * values.dn, T{1});
}

#define EMMY_INSTANTIATE(T)                              \
  template T QuarterPeriod(const EllipticParameter<T>&); \
  template class JacobiFunctions<T>;                     \
  template class ThirdKindIntegral<T>;                   \
  template T InverseJacobi(const JacobiValues<T>&)

EMMY_INSTANTIATE(double);
EMMY_INSTANTIATE(Quad);
#undef EMMY_INSTANTIATE

}  // namespace emmy::exact
