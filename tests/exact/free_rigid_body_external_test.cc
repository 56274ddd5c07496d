// The closed form against torque-free bodies that others defined, to every
// digit that reference_data/external/free_rigid_bodies.json gives.

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/exact/regimes.h"
#include "verification/exact/symmetric_top.h"

namespace emmy::exact {
namespace {

using Json = nlohmann::json;

Quad Number(const Json& json) { return Quad(json.get<std::string>()); }

Vector3<Quad> Numbers(const Json& json) {
  return {Number(json.at(0)), Number(json.at(1)), Number(json.at(2))};
}

class FreeRigidBodyExternalTest : public ::testing::TestWithParam<int> {
 protected:
  static Json Case(int index) {
    std::ifstream in(EMMY_SOURCE_DIR
                     "/reference_data/external/free_rigid_bodies.json");
    return Json::parse(in).at("cases").at(static_cast<size_t>(index));
  }

  static FreeRigidBodyStart<Quad> Start(const Json& box) {
    FreeRigidBodyStart<Quad> start;
    start.inertia = Numbers(box.at("inertia").at("value")).asDiagonal();
    start.angular_velocity =
        Numbers(box.at("body_angular_velocity").at("value"));
    return start;
  }

  // In the order of the columns after the time.
  static std::vector<Quad> Row(const FreeRigidBodyState<Quad>& state) {
    std::vector<Quad> row;
    row.reserve(16);
    for (int i = 0; i < 9; ++i) row.push_back(state.attitude(i / 3, i % 3));
    for (int i = 0; i < 3; ++i) row.push_back(state.body_angular_velocity(i));
    const Vector4<Quad> q = QuaternionFromRotation(state.attitude);
    for (int i = 0; i < 4; ++i) row.push_back(q(i));
    return row;
  }

  // Rounding here is below the last digit there.
  template <typename Motion>
  static void ExpectRows(const Json& json, const Motion& motion) {
    using std::abs;
    ASSERT_FALSE(json.at("rows").empty());
    for (const Json& expected : json.at("rows")) {
      const std::vector<Quad> row = Row(motion(Number(expected.at(0))));
      ASSERT_EQ(expected.size(), row.size() + 1);
      for (size_t i = 0; i < row.size(); ++i) {
        const Json& column = json.at("columns").at(i + 1);
        EXPECT_LE(abs(Quad(row[i] - Number(expected.at(i + 1)))),
                  column.at("uncertainty").get<double>())
            << column.at("name") << " at t = " << expected.at(0);
      }
    }
  }
};

TEST_P(FreeRigidBodyExternalTest, AgreesWithEveryDigit) {
  const Json json = Case(GetParam());
  const auto body = FreeRigidBody<Quad>::Create(Start(json)).value();
  ExpectRows(json, [&body](const Quad& t) { return body.At(t); });
}

INSTANTIATE_TEST_SUITE_P(Cases, FreeRigidBodyExternalTest,
                         ::testing::Values(0, 1), [](const auto& index) {
                           return index.param == 0 ? "AsymmetricBox"
                                                   : "SymmetricCylinder";
                         });

class AsymmetricBoxTest : public FreeRigidBodyExternalTest {
 protected:
  AsymmetricBoxTest()
      : json_(Case(0)),
        start_(Start(json_)),
        body_(FreeRigidBody<Quad>::Create(start_).value()) {}

  void ExpectNear(const Quad& actual, const char* name, const Json& expected) {
    using std::abs;
    EXPECT_LE(abs(Quad(actual - Number(expected))),
              json_.at(name).at("uncertainty").get<double>() + 1e-32)
        << name << " = " << actual.str(25) << ", expected " << expected;
  }
  const Json& Value(const char* name) const {
    return json_.at(name).at("value");
  }

  Json json_;
  FreeRigidBodyStart<Quad> start_;
  FreeRigidBody<Quad> body_;
};

TEST_F(AsymmetricBoxTest, PeriodAndParameterAgree) {
  ExpectNear(*body_.Period(), "period_of_body_omega",
             Value("period_of_body_omega"));
  ExpectNear(body_.parameter().m, "elliptic_parameter",
             Value("elliptic_parameter"));
}

TEST_F(AsymmetricBoxTest, FlipTimesAgree) {
  const std::vector<Quad> flips = body_.FlipTimes(Quad(0), Quad(12));
  ASSERT_EQ(flips.size(), Value("flip_times").size());
  for (size_t i = 0; i < flips.size(); ++i) {
    ExpectNear(flips[i], "flip_times", Value("flip_times").at(i));
    // That is a zero of the middle component, and it does change sign.
    const Quad at = body_.At(flips[i]).body_angular_velocity(1);
    const Quad before = body_.At(flips[i] - 1).body_angular_velocity(1);
    const Quad after = body_.At(flips[i] + 1).body_angular_velocity(1);
    EXPECT_LE(abs(at), 1e-30);
    EXPECT_LT(before * after, -1);
  }
}

TEST_F(AsymmetricBoxTest, EnergyAndMomentumAgreeAtTenSeconds) {
  const FreeRigidBodyState<Quad> state = body_.At(Quad(10));
  const Vector3<Quad>& omega = state.body_angular_velocity;
  ExpectNear(omega.dot(start_.inertia * omega), "twice_rotational_energy",
             Value("twice_rotational_energy"));
  for (int i = 0; i < 3; ++i) {
    ExpectNear(state.angular_momentum(i), "angular_momentum",
               Value("angular_momentum").at(static_cast<size_t>(i)));
  }
}

TEST(SymmetricCylinderTest, ClosedFormOfTheTopAgreesWithEveryDigit) {
  class Reader : public FreeRigidBodyExternalTest {
   public:
    using FreeRigidBodyExternalTest::Case;
    using FreeRigidBodyExternalTest::ExpectRows;
    using FreeRigidBodyExternalTest::Start;
    void TestBody() override {}
  };
  const Json json = Reader::Case(1);
  const FreeRigidBodyStart<Quad> start = Reader::Start(json);
  const SymmetricTop<Quad> top = {
      .transverse_moment = start.inertia(0, 0),
      .axial_moment = start.inertia(2, 2),
      .body_angular_velocity = start.angular_velocity};
  Reader::ExpectRows(json,
                     [&top](const Quad& t) { return SymmetricTopAt(top, t); });
}

// The box of the paper: 3 × 2 × 1 m of 2700 kg/m³, ω(0) = (0.3, 0.5, 0.8).
TEST(PaperBoxTest, SpatialAngularVelocityAtTenSecondsToTheLastDigit) {
  FreeRigidBodyStart<Quad> start;
  start.inertia = Vector3<Quad>(6750, 13500, 17550).asDiagonal();
  start.angular_velocity = Vector3<Quad>(Quad("0.3"), Quad("0.5"), Quad("0.8"));
  const auto body = FreeRigidBody<Quad>::Create(start).value();
  const Vector3<Quad> expected(Quad("-0.173415903493724"),
                               Quad("0.414122556137724"),
                               Quad("0.909568372553074"));
  const Vector3<Quad> error = body.At(Quad(10)).angular_velocity - expected;
  EXPECT_LE(error.cwiseAbs().maxCoeff(), 5e-16);
}

}  // namespace
}  // namespace emmy::exact
