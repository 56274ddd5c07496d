#include "emmy/diagnostics/invariants.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <variant>

#include "emmy/model/model_builder.h"
#include "emmy/numerics/unit_roundoff.h"
#include "tests/support/paper_box.h"
#include "tests/support/random_source.h"
#include "tests/support/roundoff_bound.h"
#include "tests/support/wide.h"

namespace emmy {
namespace {

constexpr double kSquare = kUnitRoundoff * kUnitRoundoff;

RigidBodyDescription TiltedBody(Formulation formulation) {
  RigidBodyDescription body = PaperBox(formulation);
  Matrix3d tensor;
  tensor << 3.0, 0.2, -0.1,  //
      0.2, 4.0, 0.3,         //
      -0.1, 0.3, 5.0;
  body.inertia = TensorInertia{.mass = 10.0, .tensor = tensor, .volume = 0.5};
  body.name = "tilted";
  return body;
}

// An ANCF box, a conventional box and one of each with a full tensor, with
// gravity; the state filled with random numbers, compensations included.
class InvariantsTest : public ::testing::Test {
 protected:
  InvariantsTest() : built_(*BuildModel(Description())) {
    State& state = built_.state;
    for (CompensatedVector* v :
         {&state.position, &state.velocity, &state.strain}) {
      for (Eigen::Index i = 0; i < v->value.size(); ++i) {
        v->value(i) += random_.Uniform(-0.5, 0.5);
        v->compensation(i) =
            v->value(i) * kUnitRoundoff * random_.Uniform(-0.9, 0.9);
      }
    }
  }

  static ModelDescription Description() {
    ModelDescription description = ModelOf(PaperBox());
    description.gravity = {0.1, 0.2, -9.81};
    RigidBodyDescription conventional = PaperBox(Formulation::kConventional);
    conventional.name = "conventional";
    conventional.position = {1.0, 2.0, 3.0};
    description.rigid_bodies.push_back(conventional);
    description.rigid_bodies.push_back(TiltedBody(Formulation::kAncf));
    description.rigid_bodies.push_back(TiltedBody(Formulation::kConventional));
    description.rigid_bodies.back().name = "last";
    description.rigid_bodies.back().penalty = std::monostate();
    return description;
  }

  // The formulas of invariants.h in 100 digits.
  struct Exact {
    Wide kinetic = 0;
    Wide penalty = 0;
    Wide gravity = 0;
    WideVector3 momentum = WideVector3::Zero();
    WideVector3 angular_momentum = WideVector3::Zero();
  };
  Exact Measure() const {
    Exact exact;
    const State& state = built_.state;
    for (const ModelBody& body : built_.model.bodies()) {
      const Eigen::Index q = body.position_offset;
      const Eigen::Index w = body.velocity_offset;
      const Wide mass = body.inertia().mass;
      const WideVector3 x = ToWide<3>(state.position, q);
      const WideVector3 v = ToWide<3>(state.velocity, w);
      exact.kinetic += mass * v.dot(v) / 2;
      exact.gravity -= mass * x.dot(built_.model.gravity().cast<Wide>());
      exact.momentum += mass * v;
      exact.angular_momentum += mass * x.cross(v);
      if (const AncfRigidBody* ancf = body.ancf()) {
        const WideMatrix3 e = ToWideColumns(state.position, q + 3);
        const WideMatrix3 rates = ToWideColumns(state.velocity, w + 3);
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) {
            const Wide moment = ancf->second_moment()(i, j);
            const WideVector3 rate_j = rates.col(j);
            exact.kinetic += moment * rates.col(i).dot(rate_j) / 2;
            exact.angular_momentum +=
                moment * WideVector3(e.col(i)).cross(rate_j);
          }
        }
        const auto strain = ToWide<6>(state.strain, body.strain_offset);
        for (int k = 0; k < 6; ++k) {
          exact.penalty +=
              Wide(ancf->penalty_stiffness()(k)) * strain(k) * strain(k) / 2;
        }
      } else {
        const WideVector3 omega = ToWide<3>(state.velocity, w + 3);
        const WideVector3 momentum =
            body.conventional()->tensor().cast<Wide>() * omega;
        exact.kinetic += omega.dot(momentum) / 2;
        const auto quaternion = ToWide<4>(state.position, q + 3);
        Eigen::Quaternion<Wide> unit(quaternion(0), quaternion(1),
                                     quaternion(2), quaternion(3));
        unit.coeffs() /= sqrt(Wide(unit.coeffs().dot(unit.coeffs())));
        exact.angular_momentum += unit.toRotationMatrix() * momentum;
      }
    }
    return exact;
  }

  RandomSource random_{20250511};
  BuiltModel built_;
};

// Some 100 extended operations of up to 15 u² on terms of the size of the
// largest quantity.
constexpr double kBound = 1500.0 * kSquare;

TEST_F(InvariantsTest, AreTheirFormulasToThirtyDigits) {
  const Exact exact = Measure();
  const Invariants measured = MeasureInvariants(built_.model, built_.state);
  const auto error = [](const DoubleDouble& value, const Wide& expected) {
    return std::abs(ToDouble(ToWide(value) - expected));
  };
  const double energy = ToDouble(exact.kinetic + exact.penalty);
  EXPECT_LE(error(measured.kinetic_energy, exact.kinetic), kBound * energy);
  EXPECT_LE(error(measured.penalty_energy, exact.penalty), kBound * energy);
  const double weight = 4.0 * kPaperBoxMass * 10.0 * 4.0;
  EXPECT_LE(error(measured.gravity_energy, exact.gravity), kBound * weight);
  const double momentum = 4.0 * kPaperBoxMass;
  EXPECT_LE(MaxAbs(ToWide(measured.momentum) - exact.momentum),
            kBound * momentum);
  EXPECT_LE(MaxAbs(ToWide(measured.angular_momentum) - exact.angular_momentum),
            kBound * 10.0 * momentum);
}

TEST_F(InvariantsTest, TotalIsInternalPlusGravityEnergy) {
  const Invariants measured = MeasureInvariants(built_.model, built_.state);
  EXPECT_EQ(measured.InternalEnergy().ToDouble(),
            (measured.kinetic_energy + measured.penalty_energy).ToDouble());
  EXPECT_EQ(measured.TotalEnergy().ToDouble(),
            (measured.InternalEnergy() + measured.gravity_energy).ToDouble());
}

// What the compensations hold is seen: 1e-17 of the energy.
TEST_F(InvariantsTest, CompensationsCount) {
  const Invariants with = MeasureInvariants(built_.model, built_.state);
  built_.state.velocity.compensation.setZero();
  const Invariants without = MeasureInvariants(built_.model, built_.state);
  const double difference =
      (with.kinetic_energy - without.kinetic_energy).ToDouble();
  EXPECT_GT(std::abs(difference), 1e-20 * with.kinetic_energy.ToDouble());
  EXPECT_LT(std::abs(difference), 1e-15 * with.kinetic_energy.ToDouble());
}

TEST_F(InvariantsTest, EnergyOfThePaperBoxIsThatOfTheRigidBody) {
  for (const Formulation formulation :
       {Formulation::kAncf, Formulation::kConventional}) {
    const BuiltModel box = *BuildModel(ModelOf(PaperBox(formulation)));
    const Invariants measured = MeasureInvariants(box.model, box.state);
    EXPECT_NEAR(measured.kinetic_energy.ToDouble(), kPaperBoxEnergy,
                RoundoffBound(8, kPaperBoxEnergy));
    EXPECT_EQ(measured.penalty_energy.ToDouble(), 0.0);
    // J ω at the identity.
    const Vector3d expected =
        PaperBoxInertia().tensor.diagonal().cwiseProduct(PaperBoxOmega());
    EXPECT_LE((measured.angular_momentum.ToDouble() - expected).norm(),
              RoundoffBound(8, expected.norm()));
  }
}

TEST(StrainGapTest, IsZeroToThirtyDigitsAtAnyStart) {
  for (const Start start : {Start::kUndeformed, Start::kRelaxed}) {
    RigidBodyDescription body = PaperBox(Formulation::kAncf, 1e6);
    body.orientation = RotationVector{{0.3, -0.2, 0.9}};
    body.start = start;
    const BuiltModel built = *BuildModel(ModelOf(body));
    EXPECT_LE(StrainGap(built.model, built.state), 1e-30);
  }
}

TEST(StrainGapTest, IsTheLargestDifferenceOverStrainsAndBodies) {
  ModelDescription description = ModelOf(PaperBox());
  description.rigid_bodies.push_back(TiltedBody(Formulation::kAncf));
  const BuiltModel built = *BuildModel(description);
  for (Eigen::Index k = 0; k < 12; ++k) {
    State state = built.state;
    state.strain.value(k) = 1e-20;
    state.strain.value((k + 5) % 12) = -3e-20;
    EXPECT_NEAR(StrainGap(built.model, state), 3e-20, 1e-31) << k;
  }
}

TEST(StrainGapTest, IsZeroWithoutAnAncfBody) {
  const BuiltModel built =
      *BuildModel(ModelOf(PaperBox(Formulation::kConventional)));
  EXPECT_EQ(StrainGap(built.model, built.state), 0.0);
}

}  // namespace
}  // namespace emmy
