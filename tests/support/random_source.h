// Random numbers with a fixed seed: every failure can be replayed.
//
// std::mt19937_64 gives the same bits everywhere; the standard distributions
// do not, so the few that tests need are written here.

#ifndef EMMY_TESTS_SUPPORT_RANDOM_SOURCE_H_
#define EMMY_TESTS_SUPPORT_RANDOM_SOURCE_H_

#include <cmath>
#include <cstdint>
#include <random>

#include "emmy/base/types.h"

namespace emmy {

class RandomSource {
 public:
  explicit RandomSource(uint64_t seed) : engine_(seed) {}

  // In [low, high), with 53 random bits.
  double Uniform(double low, double high) {
    const double unit = static_cast<double>(engine_() >> 11U) * 0x1p-53;
    return low + (high - low) * unit;
  }

  // In [low, high), evenly by order of magnitude, with a random sign.
  double Magnitude(double low, double high) {
    const double size = std::exp(Uniform(std::log(low), std::log(high)));
    return Uniform(-1.0, 1.0) < 0.0 ? -size : size;
  }

  // Entries in [−size, size).
  template <typename Matrix>
  Matrix Entries(double size) {
    Matrix m;
    for (Eigen::Index i = 0; i < m.size(); ++i) m(i) = Uniform(-size, size);
    return m;
  }
  Vector3d Vector(double size) { return Entries<Vector3d>(size); }

  // Evenly on the unit sphere of any dimension, by rejection.
  template <typename Vector>
  Vector Direction() {
    for (;;) {
      const auto v = Entries<Vector>(1.0);
      const double norm = v.norm();
      if (norm > 0.1 && norm <= 1.0) return v / norm;
    }
  }
  Vector4d UnitQuaternion() { return Direction<Vector4d>(); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace emmy

#endif  // EMMY_TESTS_SUPPORT_RANDOM_SOURCE_H_
