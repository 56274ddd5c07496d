#include "verification/exact/jacobi_elliptic.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <ostream>

namespace emmy::exact {
namespace {

const Quad kUnit = Epsilon<Quad>() / 2;

Quad Abs(const Quad& x) { return x < 0 ? -x : x; }

struct Parameter {
  const char* name;
  double m;   // One of the two is the small one,
  double m1;  // the other its complement.

  friend void PrintTo(const Parameter& p, std::ostream* os) { *os << p.name; }

  EllipticParameter<Quad> Exact() const {
    if (m <= m1) return {Quad(m), 1 - Quad(m)};
    return {1 - Quad(m1), Quad(m1)};
  }
};

class JacobiFunctionsTest : public ::testing::TestWithParam<Parameter> {
 protected:
  JacobiFunctionsTest() : functions_(GetParam().Exact()) {}

  // Arguments in quarter periods, or plain where K is infinite.
  std::vector<Quad> Arguments() const {
    const bool finite = functions_.parameter().m1 > 0;
    const Quad unit = finite ? functions_.quarter_period() : Quad(10);
    std::vector<Quad> u;
    for (const double f : {0.0, 1e-20, 0.1, 0.4999, 0.5001, 0.999, 1.3, -1.7,
                           2.2, 3.1, -4.6, 1001.25}) {
      u.push_back(f * unit);
    }
    return u;
  }

  JacobiFunctions<Quad> functions_;
};

TEST_P(JacobiFunctionsTest, SquaresAddUp) {
  const EllipticParameter<Quad> p = functions_.parameter();
  for (const Quad& u : Arguments()) {
    const JacobiValues<Quad> v = functions_.At(u);
    EXPECT_LE(Abs(v.sn * v.sn + v.cn * v.cn - 1), 24 * kUnit) << u;
    // dn² = cn² + m1 sn², relative to itself: nothing is lost near K.
    const Quad square = v.cn * v.cn + p.m1 * v.sn * v.sn;
    EXPECT_LE(Abs(v.dn * v.dn - square), 64 * kUnit * square) << u;
  }
}

TEST_P(JacobiFunctionsTest, ArgumentIsRecoveredFromTheFunctions) {
  const bool finite = functions_.parameter().m1 > 0;
  const Quad unit = finite ? functions_.quarter_period() : Quad(10);
  for (const double f : {1e-20, 0.3, 0.6, 0.99, -0.2, -0.9999}) {
    const Quad u = f * unit;
    EXPECT_LE(Abs(InverseJacobi(functions_.At(u)) - u), 32 * kUnit * Abs(u))
        << f;
  }
}

// Central difference of P, order 4, against its integrand.
TEST_P(JacobiFunctionsTest, ThirdKindIntegralHasItsIntegrandAsSlope) {
  for (const double nu : {0.0, 1e-12, 0.7, 50.0}) {
    const ThirdKindIntegral<Quad> integral(functions_.parameter(), Quad(nu));
    const auto value = [&](const Quad& u) {
      return integral.At(u, functions_.At(u));
    };
    const Quad h = 1e-7;
    for (const Quad& u : Arguments()) {
      const Quad slope = (8 * (value(u + h) - value(u - h)) -
                          (value(u + 2 * h) - value(u - 2 * h))) /
                         (12 * h);
      const Quad s = functions_.At(u).sn;
      // h⁴/30 times a fifth derivative of at most some 10³ (1 + ν)², and
      // rounding of u and P over h.
      EXPECT_LE(Abs(slope - s * s / (1 + nu * s * s)),
                1e-26 * (1 + nu) * (1 + nu) + 64 * kUnit * (1 + Abs(u)) / h)
          << "u = " << u << ", nu = " << nu;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Parameters, JacobiFunctionsTest,
    ::testing::Values(Parameter{"Circular", 0, 1},
                      Parameter{"NearlyCircular", 1e-25, 1},
                      Parameter{"Small", 0.01, 1}, Parameter{"Half", 0.5, 0.5},
                      Parameter{"Large", 1, 0.01},
                      Parameter{"NearlyHyperbolic", 1, 1e-25},
                      Parameter{"ComplementBelowRoundoff", 1, 1e-40},
                      Parameter{"ComplementBelowDouble", 1, 1e-300},
                      Parameter{"Hyperbolic", 1, 0}),
    [](const auto& parameter) { return parameter.param.name; });

TEST(JacobiEllipticTest, QuarterPeriodAtOneHalf) {
  // Γ(¼)² / (4 √π), DLMF 23.5.
  const Quad expected("1.85407467730137191843385034719526004622");
  EXPECT_LE(Abs(QuarterPeriod<Quad>({0.5, 0.5}) - expected), 4 * kUnit);
}

TEST(JacobiEllipticTest, AgreesWithBoostWhereBothAreAccurate) {
  for (const double k : {0.1, 0.5, 0.8}) {
    const Quad m = Quad(k) * k;
    const JacobiFunctions<Quad> functions({m, 1 - m});
    const ThirdKindIntegral<Quad> integral({m, 1 - m}, Quad(0.75));
    for (const double u : {0.2, 1.0, 1.5}) {
      Quad cn, dn;
      const Quad sn = boost::math::jacobi_elliptic(Quad(k), Quad(u), &cn, &dn);
      const JacobiValues<Quad> v = functions.At(u);
      EXPECT_LE(Abs(v.sn - sn), 64 * kUnit);
      EXPECT_LE(Abs(v.cn - cn), 64 * kUnit);
      EXPECT_LE(Abs(v.dn - dn), 64 * kUnit);
      using std::atan2;
      const Quad phi = atan2(sn, cn);
      const Quad pi_minus =
          (u - boost::math::ellint_3(Quad(k), Quad(-0.75), phi)) / 0.75;
      EXPECT_LE(Abs(integral.At(u, v) - pi_minus), 64 * kUnit);
    }
  }
}

}  // namespace
}  // namespace emmy::exact
