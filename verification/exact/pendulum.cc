#include "verification/exact/pendulum.h"

#include <boost/math/constants/constants.hpp>
#include <cmath>

#include "emmy/base/check.h"

namespace emmy::exact {
namespace {

using std::abs;
using std::atan2;
using std::cos;
using std::isfinite;
using std::sin;
using std::sqrt;

}  // namespace

template <typename T>
Pendulum<T>::Pendulum(const T& length, const T& gravity, const T& release_angle)
    : length_(length),
      frequency_(sqrt(gravity / length)),
      half_sine_(sin(release_angle / 2)),
      half_cosine_(cos(release_angle / 2)),
      functions_({half_sine_ * half_sine_, half_cosine_ * half_cosine_}) {
  EMMY_CHECK(length > 0 && gravity > 0,
             "length = " << length << ", gravity = " << gravity);
  EMMY_CHECK(abs(release_angle) < boost::math::constants::pi<T>(),
             "release_angle = " << release_angle);
}

template <typename T>
typename Pendulum<T>::State Pendulum<T>::At(const T& time) const {
  EMMY_CHECK(isfinite(time), "time = " << time);
  const JacobiValues<T> v = functions_.At(frequency_ * time);
  const T sine = half_sine_ * v.cn / v.dn;
  const T cosine = half_cosine_ / v.dn;
  State state;
  state.angle = 2 * atan2(sine, cosine);
  state.angular_velocity =
      -2 * half_sine_ * half_cosine_ * frequency_ * v.sn / v.dn;
  state.x = 2 * length_ * sine * cosine;
  state.y = length_ * (sine - cosine) * (sine + cosine);
  return state;
}

template <typename T>
T Pendulum<T>::Period() const {
  return 4 * functions_.quarter_period() / frequency_;
}

template class Pendulum<double>;
template class Pendulum<Quad>;

}  // namespace emmy::exact
