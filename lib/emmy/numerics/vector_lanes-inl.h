// Four vectors side by side, by their x, y and z: a product over components is
// one of lanes.

// Not a guard for the whole file: it is read again for each instruction set.
#if defined(EMMY_NUMERICS_VECTOR_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_NUMERICS_VECTOR_LANES_INL_H_
#undef EMMY_NUMERICS_VECTOR_LANES_INL_H_
#else
#define EMMY_NUMERICS_VECTOR_LANES_INL_H_
#endif

#include "emmy/numerics/compensated_lanes-inl.h"
#include "emmy/numerics/four_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// The x, y and z of four vectors.
struct Vectors {
  Lanes x, y, z;
};

HWY_INLINE Vectors operator+(const Vectors& a, const Vectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Vectors operator*(const Lanes& s, const Vectors& a) {
  return {s * a.x, s * a.y, s * a.z};
}
HWY_INLINE Lanes Dot(const Vectors& a, const Vectors& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
HWY_INLINE Vectors Cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HWY_INLINE Vectors Next(const Vectors& a) {
  return {Next(a.x), Next(a.y), Next(a.z)};
}
HWY_INLINE Vectors Previous(const Vectors& a) {
  return {Previous(a.x), Previous(a.y), Previous(a.z)};
}
HWY_INLINE Lanes MaxAbs(const Vectors& a) {
  return Max(Max(Abs(a.x), Abs(a.y)), Abs(a.z));
}
HWY_INLINE Vectors LoadVectors(const double* p) {
  Vectors v;
  LoadInterleaved(p, &v.x, &v.y, &v.z);
  return v;
}

// A result, and what its rounding drops.
struct VectorsAndError {
  Vectors value, error;
};
HWY_INLINE VectorsAndError SumExactly(const Vectors& a, const Vectors& b) {
  const LanesSum x = TwoSum(a.x, b.x);
  const LanesSum y = TwoSum(a.y, b.y);
  const LanesSum z = TwoSum(a.z, b.z);
  return {{x.value, y.value, z.value}, {x.error, y.error, z.error}};
}
// s a.
HWY_INLINE VectorsAndError ScaledExactly(const Lanes& s, const Vectors& a) {
  const LanesSum x = TwoProduct(s, a.x);
  const LanesSum y = TwoProduct(s, a.y);
  const LanesSum z = TwoProduct(s, a.z);
  return {{x.value, y.value, z.value}, {x.error, y.error, z.error}};
}

// a · (value + error) as a pair. Source: Ogita, Rump and Oishi, SIAM J. Sci.
// Comput. 26 (2005), algorithm 5.3.
HWY_INLINE LanesSum DotExactly(const Vectors& a, const VectorsAndError& b) {
  const LanesSum x = TwoProduct(a.x, b.value.x);
  const LanesSum y = TwoProduct(a.y, b.value.y);
  const LanesSum z = TwoProduct(a.z, b.value.z);
  const LanesSum first = TwoSum(x.value, y.value);
  const LanesSum second = TwoSum(first.value, z.value);
  return {second.value, ((x.error + y.error) + (z.error + first.error)) +
                            (second.error + Dot(a, b.error))};
}

HWY_INLINE VectorsAndError Next(const VectorsAndError& a) {
  return {Next(a.value), Next(a.error)};
}

// The increments of the three stretches and the three shears along `de`, whose
// parts cancel, rounded only once: in a million steps and more, the mean of
// many roundings shows, which the penalty multiplies.
struct StrainIncrements {
  Lanes stretch, shear;
};
HWY_INLINE StrainIncrements StrainIncrementsOf(const Vectors& e,
                                               const VectorsAndError& de) {
  const LanesSum stretch = DotExactly(e, de);
  const LanesSum first = DotExactly(Next(e), de);
  const LanesSum second = DotExactly(e, Next(de));
  const LanesSum shear = TwoSum(first.value, second.value);
  return {stretch.value + stretch.error,
          shear.value + (shear.error + (first.error + second.error))};
}

// Vector i in every lane.
template <int i>
HWY_INLINE Vectors Broadcast(const Vectors& a) {
  return {Broadcast<i>(a.x), Broadcast<i>(a.y), Broadcast<i>(a.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_NUMERICS_VECTOR_LANES_INL_H_
