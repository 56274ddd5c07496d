// Jacobi elliptic functions and one integral of the third kind, accurate for
// every parameter 0 ≤ m ≤ 1, also where m or 1 − m is tiny.
//
//   u = ∫₀^φ dθ / √(1 − m sin²θ),   sn u = sin φ,  cn u = cos φ,
//   dn u = √(1 − m sn²u),           K = u(φ = π/2)                  (ELL-1)
//   P(u; ν, m) = ∫₀^u sn²v / (1 + ν sn²v) dv
//              = ⅓ sn³u R_J(cn²u, dn²u, 1, 1 + ν sn²u), |u| ≤ K     (ELL-2)
//   P(u + 2K) = P(u) + 2 P(K)                                       (ELL-3)
//   F = s R_F(c², d², 1),  u with sn u = s, cn u = c ≥ 0, dn u = d  (ELL-4)
//
// R_F, R_J are Carlson's symmetric integrals. P is Legendre's integral of the
// third kind without its part of the first, P = (F − Π) / ν at n = −ν, written
// so that nothing cancels, also not for ν → 0.
//
// The argument is reduced to |v| ≤ ½ K about the nearest multiple of K, where
// sn, cn, dn come from Landen's transformation down to circular functions
// (m ≤ ½) or up to hyperbolic ones (m > ½). About odd multiples cn and dn
// keep their relative accuracy; that is what makes P accurate there.
//
// Error: a few ε relative, plus the change of the value for a change ε |u| of
// the argument (u is reduced by a rounded K).
//
// Derivation: docs/theory.md (ELL-1..4), after Abramowitz & Stegun 16.4-16.14
// and DLMF 19.25, 22.7.

#ifndef EMMY_VERIFICATION_EXACT_JACOBI_ELLIPTIC_H_
#define EMMY_VERIFICATION_EXACT_JACOBI_ELLIPTIC_H_

#include "verification/exact/real.h"

namespace emmy::exact {

// The parameter m = k² and its complement, both given, because neither can
// be had from the other without cancellation. m, m1 ≥ 0, m + m1 = 1.
template <typename T>
struct EllipticParameter {
  T m = T{0};
  T m1 = T{1};
};

template <typename T>
struct JacobiValues {
  T sn = T{0};
  T cn = T{1};
  T dn = T{1};
};

// K(m); infinite for m1 = 0.
template <typename T>
T QuarterPeriod(const EllipticParameter<T>& parameter);

// sn, cn, dn for one parameter and any real argument.
template <typename T>
class JacobiFunctions {
 public:
  explicit JacobiFunctions(const EllipticParameter<T>& parameter);

  const EllipticParameter<T>& parameter() const { return parameter_; }
  const T& quarter_period() const { return quarter_period_; }  // K

  JacobiValues<T> At(const T& u) const;

 private:
  EllipticParameter<T> parameter_;
  T quarter_period_;
};

// P(u; ν, m) of (ELL-2, 3) for ν ≥ 0 and any real u.
template <typename T>
class ThirdKindIntegral {
 public:
  ThirdKindIntegral(const EllipticParameter<T>& parameter, const T& nu);

  // `values` are those of JacobiFunctions::At(u) for the same parameter.
  T At(const T& u, const JacobiValues<T>& values) const;

  // P(K); infinite for m1 = 0.
  const T& complete() const { return complete_; }

 private:
  T nu_;
  T quarter_period_;
  T complete_;
};

// (ELL-4): u from its three functions; s may have either sign.
template <typename T>
T InverseJacobi(const JacobiValues<T>& values);

}  // namespace emmy::exact

#endif  // EMMY_VERIFICATION_EXACT_JACOBI_ELLIPTIC_H_
