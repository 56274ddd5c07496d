// Extended precision: a number as the unevaluated sum of two doubles.
//
//   x = hi + lo, |lo| ≤ ½ ulp(hi): 106 significant bits, relative error of
//   one operation at most a few 2^(-104)
//   TwoProduct: a b = p + r exactly, p = fl(a b)                  (SUM-3)
//
// Used where the measurement must not hide the result (energies, momenta) and
// where a start must be exact beyond a double (an orthonormal frame). Chosen
// over long double because it gives the same bits on every platform.
//
// Sources: Dekker, Numer. Math. 18 (1971); Joldes, Muller, Popescu, ACM TOMS
// 44 (2017), algorithms 4 to 18.
// Not covered: overflow (|x| below 1e290), underflow of the error terms
// (|x| above 1e-290 or zero). Needs -ffp-contract=off.

#ifndef EMMY_BASE_DOUBLE_DOUBLE_H_
#define EMMY_BASE_DOUBLE_DOUBLE_H_

#include <array>
#include <cmath>

#include "emmy/base/compensated_sum.h"
#include "emmy/base/types.h"

namespace emmy {

// (SUM-3) by Veltkamp's splitting, which needs no fused multiply-add.
inline SumAndError TwoProduct(double a, double b) {
  constexpr double kSplit = 134217729.0;  // 2^27 + 1.
  const double product = a * b;
  const double a_scaled = kSplit * a;
  const double a_high = a_scaled - (a_scaled - a);
  const double a_low = a - a_high;
  const double b_scaled = kSplit * b;
  const double b_high = b_scaled - (b_scaled - b);
  const double b_low = b - b_high;
  const double error =
      ((a_high * b_high - product) + a_high * b_low + a_low * b_high) +
      a_low * b_low;
  return {product, error};
}

// x = hi + lo.
struct DoubleDouble {
  double hi = 0.0;  // The nearest double.
  double lo = 0.0;  // The rest.

  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : hi(value) {}  // NOLINT: a number.
  // A pair that is normalised already.
  constexpr DoubleDouble(double high, double low) : hi(high), lo(low) {}
  // The exact result of TwoSum or TwoProduct.
  explicit DoubleDouble(const SumAndError& s) : hi(s.sum), lo(s.error) {}

  // The nearest double, since |lo| is at most half a unit of hi.
  double ToDouble() const { return hi; }
};

// x + y for |x| ≥ |y| or x = 0, exactly, as a normalised pair.
inline DoubleDouble FastNormalize(double x, double y) {
  const double sum = x + y;
  return {sum, y - (sum - x)};
}

// −x, exactly.
inline DoubleDouble operator-(const DoubleDouble& x) { return {-x.hi, -x.lo}; }

// x + y to 3 u² relative, also where the high parts cancel; u = 2^(-53).
inline DoubleDouble operator+(const DoubleDouble& x, const DoubleDouble& y) {
  const SumAndError high = TwoSum(x.hi, y.hi);
  const SumAndError low = TwoSum(x.lo, y.lo);
  const DoubleDouble first = FastNormalize(high.sum, high.error + low.sum);
  return FastNormalize(first.hi, first.lo + low.error);
}

// x − y, as the sum.
inline DoubleDouble operator-(const DoubleDouble& x, const DoubleDouble& y) {
  return x + (-y);
}

// x y to a few u² relative.
inline DoubleDouble operator*(const DoubleDouble& x, const DoubleDouble& y) {
  const SumAndError product = TwoProduct(x.hi, y.hi);
  return FastNormalize(product.sum,
                       product.error + (x.hi * y.lo + x.lo * y.hi));
}

// x / y to a few u² relative; y ≠ 0.
inline DoubleDouble operator/(const DoubleDouble& x, const DoubleDouble& y) {
  const double first = x.hi / y.hi;
  const DoubleDouble remainder = x - y * DoubleDouble(first);
  const double second = remainder.hi / y.hi;
  const DoubleDouble rest = remainder - y * DoubleDouble(second);
  return FastNormalize(first, second) + DoubleDouble(rest.hi / y.hi);
}

// x = x + y.
inline DoubleDouble& operator+=(DoubleDouble& x, const DoubleDouble& y) {
  return x = x + y;
}

// x = x − y.
inline DoubleDouble& operator-=(DoubleDouble& x, const DoubleDouble& y) {
  return x = x - y;
}

// √x by one Newton correction of the double root; x ≥ 0.
inline DoubleDouble Sqrt(const DoubleDouble& x) {
  if (x.hi <= 0.0) return {};
  const double root = std::sqrt(x.hi);
  const DoubleDouble rest = x - DoubleDouble(TwoProduct(root, root));
  return FastNormalize(root, rest.hi / (2.0 * root));
}

// A vector of three extended numbers.
struct DoubleDouble3 {
  std::array<DoubleDouble, 3> entries;  // x, y, z.

  // Entry i = 0, 1, 2; not checked.
  DoubleDouble& operator[](int i) { return entries[static_cast<size_t>(i)]; }
  // The same of a constant.
  const DoubleDouble& operator[](int i) const {
    return entries[static_cast<size_t>(i)];
  }

  // `v` exactly.
  static DoubleDouble3 FromDouble(const Vector3d& v) {
    return {{DoubleDouble(v(0)), DoubleDouble(v(1)), DoubleDouble(v(2))}};
  }

  // The nearest doubles.
  Vector3d ToDouble() const {
    return {entries[0].hi, entries[1].hi, entries[2].hi};
  }
  // What ToDouble leaves out.
  Vector3d LowPart() const {
    return {entries[0].lo, entries[1].lo, entries[2].lo};
  }
};

// a + b, entry by entry.
inline DoubleDouble3 operator+(const DoubleDouble3& a, const DoubleDouble3& b) {
  return {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}};
}

// a − b, entry by entry.
inline DoubleDouble3 operator-(const DoubleDouble3& a, const DoubleDouble3& b) {
  return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
}

// s a, entry by entry.
inline DoubleDouble3 operator*(const DoubleDouble& s, const DoubleDouble3& a) {
  return {{s * a[0], s * a[1], s * a[2]}};
}

// a = a + b.
inline DoubleDouble3& operator+=(DoubleDouble3& a, const DoubleDouble3& b) {
  return a = a + b;
}

// a · b; its error is relative to |a| |b|.
inline DoubleDouble Dot(const DoubleDouble3& a, const DoubleDouble3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// a × b; its error is relative to |a| |b|.
inline DoubleDouble3 Cross(const DoubleDouble3& a, const DoubleDouble3& b) {
  return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
           a[0] * b[1] - a[1] * b[0]}};
}

// |a| = √(a · a).
inline DoubleDouble Norm(const DoubleDouble3& a) { return Sqrt(Dot(a, a)); }

}  // namespace emmy

#endif  // EMMY_BASE_DOUBLE_DOUBLE_H_
