// Kinematics, inertia and attitude, by what they mean: sums over the material
// of the body, and derivatives, in long double.

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "emmy/base/larger.h"
#include "emmy/diagnostics/angular_velocity.h"
#include "emmy/diagnostics/invariants.h"
#include "emmy/diagnostics/structure_motion.h"
#include "emmy/model/model_builder.h"
#include "emmy/numerics/polar.h"
#include "emmy/numerics/rotation.h"
#include "emmy/numerics/unit_roundoff.h"
#include "verification/claims/groups.h"
#include "verification/claims/long_double.h"
#include "verification/runs/paper_box.h"

namespace emmy::verification {
namespace {

constexpr int kTrials = 200;
constexpr uint64_t kSeed = 20261121;

Matrix3d AnyRotation(SampleSource* random) {
  return QuaternionToMatrix(random->Entries<Vector4d>(1.0).normalized().eval());
}

// The paper's box anywhere, deformed, in any motion.
struct Sample {
  Vector3d position, velocity;
  Matrix3d gradients, rates;
};

Sample AnySample(SampleSource* random) {
  Sample sample;
  sample.position = random->Entries<Vector3d>(5.0);
  sample.velocity = random->Entries<Vector3d>(2.0);
  const Matrix3d stretch =
      Matrix3d::Identity() + random->Entries<Matrix3d>(0.1);
  sample.gradients = AnyRotation(random) * stretch;
  sample.rates = random->Entries<Matrix3d>(1.0);
  return sample;
}

void Put(const Sample& sample, State* state) {
  state->position.SetZero(12);
  state->velocity.SetZero(12);
  state->position.value << sample.position, sample.gradients.reshaped();
  state->velocity.value << sample.velocity, sample.rates.reshaped();
}

// A sum, and the sum of the sizes of its terms, which rounding goes by.
struct Sum {
  RealVector value = RealVector::Zero();
  Real size = 0.0L;
  void Add(const RealVector& term) {
    value += term;
    size += term.norm();
  }
  double Error(const Vector3d& computed) const {
    return static_cast<double>((computed.cast<Real>() - value).norm() /
                               (size * Wide(kUnitRoundoff)));
  }
};

absl::StatusOr<BuiltModel> Box() { return BuildModel(PaperBoxAncf(1e10)); }

absl::StatusOr<ClaimResult> Points(const ClaimSetting& setting) {
  absl::StatusOr<BuiltModel> built = Box();
  if (!built.ok()) return built.status();
  SampleSource random(kSeed);
  double position = 0.0;
  double velocity = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Sample sample = AnySample(&random);
    Put(sample, &built->state);
    const auto xi = random.Entries<Vector3d>(2.0);
    const Point point{.terms = {{0, 1.0}, {1, xi(0)}, {2, xi(1)}, {3, xi(2)}},
                      .ground = Vector3d::Zero(),
                      .conventional_body = std::nullopt,
                      .xi = Vector3d::Zero()};
    const PointMotion motion = ObservePoint(built->model, built->state, point);
    Sum x;
    Sum v;
    x.Add(sample.position.cast<Real>());
    v.Add(sample.velocity.cast<Real>());
    for (int i = 0; i < 3; ++i) {
      x.Add(Wide(xi(i)) * sample.gradients.col(i).cast<Real>());
      v.Add(Wide(xi(i)) * sample.rates.col(i).cast<Real>());
    }
    position =
        Larger(position, x.Error((1.0 + setting.fault) * motion.position));
    velocity =
        Larger(velocity, v.Error((1.0 + setting.fault) * motion.velocity));
  }
  return ClaimResult{.values = {{"position", position}, {"velocity", velocity}},
                     .figures = {},
                     .notes = {}};
}

// Entries of M that differ in any bit from those of the box as it stands.
absl::StatusOr<ClaimResult> ConstantMass(const ClaimSetting& setting) {
  const absl::StatusOr<BuiltModel> still = Box();
  if (!still.ok()) return still.status();
  SampleSource random(kSeed);
  double different = 0.0;
  double entries = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    ModelDescription description = PaperBoxAncf(1e10);
    RigidBodyDescription& body = description.rigid_bodies[0];
    body.orientation = RotationVector{random.Entries<Vector3d>(3.0)};
    body.position = random.Entries<Vector3d>(10.0);
    body.angular_velocity = random.Entries<Vector3d>(1.0);
    const absl::StatusOr<BuiltModel> turned = BuildModel(description);
    if (!turned.ok()) return turned.status();
    for (size_t row = 0; row < still->model.mass().size(); ++row) {
      const std::vector<MassEntry>& expected = still->model.mass()[row];
      const std::vector<MassEntry>& actual = turned->model.mass()[row];
      for (size_t i = 0; i < expected.size(); ++i) {
        ++entries;
        const bool same =
            actual.size() == expected.size() &&
            actual[i].column == expected[i].column &&
            (1.0 + setting.fault) * actual[i].mass == expected[i].mass;
        if (!same) ++different;
      }
    }
  }
  if (entries == 0.0) different = std::nan("");
  return ClaimResult{
      .values = {{"entries", different}}, .figures = {}, .notes = {}};
}

// Sums over the box: Gauss's two points along each edge are exact for
// quadratic functions.
struct MaterialSums {
  Sum momentum, angular_momentum;
  Real kinetic_energy = 0.0L;
};

MaterialSums SumOverMaterial(const Sample& sample) {
  const RealVector half_size(1.5L, 1.0L, 0.5L);
  const Real mass = 2700.0L * 6.0L / 8.0L;
  MaterialSums sums;
  for (int corner = 0; corner < 8; ++corner) {
    RealVector xi = half_size / std::sqrt(3.0L);
    for (int i = 0; i < 3; ++i) {
      if (((corner >> i) & 1) != 0) xi(i) = -xi(i);
    }
    const RealVector x =
        sample.position.cast<Real>() + sample.gradients.cast<Real>() * xi;
    const RealVector v =
        sample.velocity.cast<Real>() + sample.rates.cast<Real>() * xi;
    sums.momentum.Add(mass * v);
    sums.angular_momentum.Add(mass * x.cross(v));
    sums.angular_momentum.size += mass * x.norm() * v.norm();
    sums.kinetic_energy += 0.5L * mass * v.squaredNorm();
  }
  return sums;
}

absl::StatusOr<ClaimResult> Momenta(const ClaimSetting& setting) {
  absl::StatusOr<BuiltModel> built = Box();
  if (!built.ok()) return built.status();
  const Matrix3d inertia = built->model.bodies()[0].inertia().tensor;
  SampleSource random(kSeed);
  double energy = 0.0;
  double momentum = 0.0;
  double angular = 0.0;
  double rigid = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Sample sample = AnySample(&random);
    Put(sample, &built->state);
    Invariants computed = MeasureInvariants(built->model, built->state);
    const double wrong = 1.0 + setting.fault;
    const MaterialSums sums = SumOverMaterial(sample);
    energy = Larger(
        energy, static_cast<double>(
                    std::abs(Wide(wrong * computed.kinetic_energy.ToDouble()) /
                                 sums.kinetic_energy -
                             1.0L)) /
                    kUnitRoundoff);
    momentum = Larger(
        momentum, sums.momentum.Error(wrong * computed.momentum.ToDouble()));
    angular =
        Larger(angular, sums.angular_momentum.Error(
                            wrong * computed.angular_momentum.ToDouble()));
    // Moving as a rigid body does: the conventional expression.
    const Matrix3d rotation = AnyRotation(&random);
    const auto omega = random.Entries<Vector3d>(1.0);
    sample.gradients = rotation;
    sample.rates = Hat(omega) * rotation;
    Put(sample, &built->state);
    computed = MeasureInvariants(built->model, built->state);
    const RealVector p = 16200.0L * sample.velocity.cast<Real>();
    const RealMatrix r = rotation.cast<Real>();
    Sum expected;
    expected.Add(sample.position.cast<Real>().cross(p));
    expected.Add(r * inertia.cast<Real>() * r.transpose() * omega.cast<Real>());
    expected.size += Wide(sample.position.norm()) * p.norm();
    rigid = Larger(
        rigid, expected.Error(wrong * computed.angular_momentum.ToDouble()));
  }
  return ClaimResult{
      .values = {{"kinetic energy, over the material", energy},
                 {"momentum, over the material", momentum},
                 {"angular momentum, over the material", angular},
                 {"angular momentum, of a rigid body", rigid}},
      .figures = {},
      .notes = {}};
}

RealMatrix PolarRotation(const RealMatrix& f) {
  const Eigen::JacobiSVD<RealMatrix> svd(
      f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

RealVector AxialOf(const RealMatrix& x) {
  return 0.5L *
         RealVector(x(2, 1) - x(1, 2), x(0, 2) - x(2, 0), x(1, 0) - x(0, 1));
}

// d/dt of the attitude along e + t ė, by differences of fourth order.
RealVector SpinOfAttitude(const RealMatrix& e, const RealMatrix& rates) {
  constexpr Real kStep = 1e-4L;
  const auto at = [&](int k) -> RealMatrix {
    return PolarRotation(e + (static_cast<Real>(k) * kStep) * rates);
  };
  const RealMatrix derivative =
      (8.0L * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0L * kStep);
  return AxialOf(derivative * at(0).transpose());
}

absl::StatusOr<ClaimResult> Attitude(const ClaimSetting& setting) {
  const absl::StatusOr<BuiltModel> built = Box();
  if (!built.ok()) return built.status();
  const Matrix3d& moment = built->model.bodies()[0].ancf()->second_moment();
  const double wrong = 1.0 + setting.fault;
  SampleSource random(kSeed);
  double attitude = 0.0;
  double polar_error = 0.0;
  double exact_error = 0.0;
  double locked_error = 0.0;
  const auto relative = [&](const Vector3d& computed,
                            const RealVector& expected) {
    return static_cast<double>(
               (Wide(wrong) * computed.cast<Real>() - expected).norm() /
               expected.norm()) /
           kUnitRoundoff;
  };
  for (int trial = 0; trial < kTrials; ++trial) {
    const Sample sample = AnySample(&random);
    const RealMatrix e = sample.gradients.cast<Real>();
    // A spin of one and a deformation of a tenth of it, so that no component
    // that is compared is small by cancellation.
    const Vector3d omega = random.Entries<Vector3d>(1.0).normalized();
    const Matrix3d rates = Hat(omega) * sample.gradients + 0.1 * sample.rates;
    const RealMatrix w = rates.cast<Real>();
    const PolarDecomposition polar = DecomposePolar(sample.gradients);
    const RealMatrix rotation = PolarRotation(e);
    attitude = Larger(
        attitude,
        static_cast<double>(
            (Wide(wrong) * polar.rotation.cast<Real>() - rotation).norm()) /
            kUnitRoundoff);
    const RealMatrix stretch = rotation.transpose() * e;
    polar_error =
        Larger(polar_error,
               relative(PolarAngularVelocity(polar, rates),
                        AxialOf(w * stretch.inverse() * rotation.transpose())));
    exact_error =
        Larger(exact_error, relative(ExactPolarAngularVelocity(polar, rates),
                                     SpinOfAttitude(e, w)));
    RealVector momentum = RealVector::Zero();
    RealMatrix inertia = RealMatrix::Zero();
    for (int i = 0; i < 3; ++i) {
      const Real m = Wide(moment(i, i));
      momentum += m * e.col(i).cross(w.col(i));
      inertia += m * (e.col(i).squaredNorm() * RealMatrix::Identity() -
                      e.col(i) * e.col(i).transpose());
    }
    locked_error =
        Larger(locked_error,
               relative(LockedAngularVelocity(moment, sample.gradients, rates),
                        inertia.inverse() * momentum));
  }
  return ClaimResult{.values = {{"attitude", attitude},
                                {"polar", polar_error},
                                {"polar exact", exact_error},
                                {"locked", locked_error}},
                     .figures = {},
                     .notes = {}};
}

}  // namespace

std::vector<Claim> KinematicsClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      {.id = "kinematics/points",
       .sentence = "Position and velocity of a material point are linear in "
                   "the coordinates and their rates.",
       .equations = "(KIN-1), (PNT-1); paper (1), (2)",
       .reference = Reference::kExact,
       .metric = "error / (u sum of |terms|), deformed boxes in any motion",
       .unit = "u",
       .bound = {.upper = 5.0,
                 .derivation = "one product and at most four sums on the way "
                               "of each term, each rounded by u"},
       .measure = Points});
  claims.push_back(
      {.id = "kinematics/constant_mass",
       .sentence = "The mass matrix does not depend on the attitude.",
       .equations = "(ANCF-1), (ANCF-2); paper (3), (4)",
       .reference = Reference::kExact,
       .metric = "entries that differ in any bit, 200 attitudes",
       .unit = "entries",
       .bound = {.upper = 0.0, .derivation = "none may differ"},
       .measure = ConstantMass});
  claims.push_back(
      {.id = "kinematics/momenta",
       .sentence = "Kinetic energy, momentum and angular momentum are the sums "
                   "over the material, and those of a rigid body where it "
                   "moves as one.",
       .equations = "(ANCF-1..3), (ANCF-7), (CRB-2); paper (3), (7), (8)",
       .reference = Reference::kExact,
       .metric = "error / (u sum of |terms|), deformed boxes in any motion",
       .unit = "u",
       .bound = {.upper = 6.0,
                 .derivation =
                     "the masses carry four roundings (volume, density, two of "
                     "a^2 / 12), the result one; of a rigid body, attitude and "
                     "rates are rounded instead, to 3 u"},
       .measure = Momenta});
  claims.push_back(
      {.id = "kinematics/attitude",
       .sentence = "The attitude is the rotation of the polar decomposition, "
                   "polar_exact its spin, polar and locked their formulas.",
       .equations = "(ATT-1..4); paper (9)-(14)",
       .reference = Reference::kExact,
       .metric = "error / u, against a singular value decomposition and its "
                 "differences in long double",
       .unit = "u",
       .bound = {.upper = 100.0,
                 .derivation =
                     "an inverse of a 3 x 3 matrix of condition k errs by 10 k "
                     "u at most (Higham, 14.1), k = 3 with the inertia of the "
                     "box and 1.5 for stretches; each formula has two and some "
                     "ten further roundings. The differences err by h^4 / 30 = "
                     "3e-18"},
       .measure = Attitude});
  return claims;
}

}  // namespace emmy::verification
