#include "verification/benchmarks/peers/rigid_laws.h"

#include <Eigen/Geometry>
#include <cmath>

namespace emmy::verification {
namespace {

using Real = long double;
using Vector3r = Eigen::Matrix<Real, 3, 1>;
using Matrix3r = Eigen::Matrix<Real, 3, 3>;

Vector3r Place(const RigidMotion& body, const Vector3d& point) {
  return body.position.cast<Real>() +
         body.attitude.cast<Real>() * point.cast<Real>();
}

Real SpringEnergy(const std::vector<RigidMotion>& bodies,
                  const PairSpring& spring) {
  const PointPair& ends = spring.ends;
  const Real length = (Place(bodies[ends.bodies[1]], ends.points[1]) -
                       Place(bodies[ends.bodies[0]], ends.points[0]))
                          .norm();
  const Real extension = length - static_cast<Real>(spring.length);
  return static_cast<Real>(spring.stiffness) * extension * extension / 2;
}

// std::max(largest, NaN) would forget the NaN.
double Larger(double largest, double value) {
  return std::isnan(largest) || value <= largest ? largest : value;
}

}  // namespace

RigidLaws MeasureLaws(const std::vector<RigidMotion>& bodies,
                      const std::vector<PairSpring>& springs) {
  Real energy = 0;
  Vector3r angular_momentum = Vector3r::Zero();
  for (const RigidMotion& body : bodies) {
    const Real mass = static_cast<Real>(body.mass);
    const Matrix3r attitude = body.attitude.cast<Real>();
    const Vector3r velocity = body.velocity.cast<Real>();
    const Vector3r omega =
        attitude.transpose() * body.angular_velocity.cast<Real>();
    const Vector3r spin = body.inertia.cast<Real>().cwiseProduct(omega);
    energy += (mass * velocity.squaredNorm() + omega.dot(spin)) / 2;
    angular_momentum += mass * body.position.cast<Real>().cross(velocity) +
                        Vector3r(attitude * spin);
  }
  for (const PairSpring& spring : springs) {
    energy += SpringEnergy(bodies, spring);
  }
  return {static_cast<double>(energy), angular_momentum.cast<double>()};
}

LawMonitor::LawMonitor(const RigidLaws& start) : start_(start) {
  Observe(start);
}

void LawMonitor::Observe(const RigidLaws& laws) {
  largest_.energy =
      Larger(largest_.energy, std::abs(laws.energy - start_.energy));
  scale_.energy = Larger(scale_.energy, std::abs(laws.energy));
  largest_.angular_momentum =
      Larger(largest_.angular_momentum,
             (laws.angular_momentum - start_.angular_momentum).norm());
  scale_.angular_momentum =
      Larger(scale_.angular_momentum, laws.angular_momentum.norm());
}

LawErrors LawMonitor::Errors() const {
  const auto relative = [](double error, double scale) {
    return error == 0.0 ? 0.0 : error / scale;
  };
  return {relative(largest_.energy, scale_.energy),
          relative(largest_.angular_momentum, scale_.angular_momentum)};
}

}  // namespace emmy::verification
