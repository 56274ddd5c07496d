// Four vectors side by side, by their x, y and z: a product over components is
// one of lanes.

// Not a guard for the whole file: it is read again for each instruction set.
#if defined(EMMY_NUMERICS_VECTOR_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef EMMY_NUMERICS_VECTOR_LANES_INL_H_
#undef EMMY_NUMERICS_VECTOR_LANES_INL_H_
#else
#define EMMY_NUMERICS_VECTOR_LANES_INL_H_
#endif

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

// Vector i in every lane.
template <int i>
HWY_INLINE Vectors Broadcast(const Vectors& a) {
  return {Broadcast<i>(a.x), Broadcast<i>(a.y), Broadcast<i>(a.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#endif  // EMMY_NUMERICS_VECTOR_LANES_INL_H_
