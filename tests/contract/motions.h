// The motions that both formulations have to do, with their scales.

#ifndef EMMY_TESTS_CONTRACT_MOTIONS_H_
#define EMMY_TESTS_CONTRACT_MOTIONS_H_

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/paper_box.h"
#include "tests/support/roundoff_bound.h"

namespace emmy {

struct Motion {
  std::string name;
  RigidBodyDescription body;
  double time_step = 1e-3;

  friend void PrintTo(const Motion& m, std::ostream* os) { *os << m.name; }

  // |ω| Δt, the angle of one step.
  double Angle() const { return body.angular_velocity.norm() * time_step; }

  // Rounding of one step relative to energy or angular momentum. Terms of the
  // size of the increment, |ω|Δt times the whole, are multiplied by M or b,
  // by a vector and by Δt and added: 4 u, the roundings inside them averaged.
  double StepError() const { return RoundoffBound(4, Angle()); }
};

inline std::string MotionName(const ::testing::TestParamInfo<Motion>& motion) {
  return motion.param.name;
}

// Small, large and very large steps, general axes and places, a fast spin;
// conservation that is tested with small steps alone proves nothing.
inline std::vector<Motion> Motions() {
  std::vector<Motion> motions;
  for (const Formulation formulation :
       {Formulation::kAncf, Formulation::kConventional}) {
    const RigidBodyDescription box = PaperBox(formulation);
    const auto add = [&](const char* name, const RigidBodyDescription& body,
                         double time_step) {
      const char* prefix =
          formulation == Formulation::kAncf ? "Ancf" : "Conventional";
      motions.push_back({.name = std::string(prefix) + name,
                         .body = body,
                         .time_step = time_step});
    };
    add("PaperBox", box, 1e-3);
    add("LargeStep", box, 0.1);
    add("VeryLargeStep", box, 0.5);

    RigidBodyDescription moving = box;
    moving.position = {10.0, -20.0, 5.0};
    moving.velocity = {1.0, 2.0, -0.5};
    moving.orientation = RotationVector{{0.4, -1.1, 0.7}};
    add("Moving", moving, 0.01);

    RigidBodyDescription tilted = moving;
    Matrix3d tensor;
    tensor << 3000.0, 200.0, -100.0,  //
        200.0, 4000.0, 300.0,         //
        -100.0, 300.0, 5000.0;
    tilted.inertia =
        TensorInertia{.mass = 1000.0, .tensor = tensor, .volume = 0.5};
    add("GeneralAxes", tilted, 0.01);

    RigidBodyDescription fast = box;
    fast.angular_velocity = {100.0, 40.0, -70.0};
    fast.orientation = RotationVector{{0.0, 0.0, 3.0}};
    add("FastSpin", fast, 1e-3);

    if (formulation == Formulation::kAncf) {
      RigidBodyDescription relaxed = moving;
      relaxed.start = Start::kRelaxed;
      relaxed.penalty = 1e6;
      add("Relaxed", relaxed, 0.01);
      RigidBodyDescription stiff = box;
      stiff.penalty = 1e14;
      add("VeryStiff", stiff, 0.01);
      RigidBodyDescription soft = box;
      soft.penalty = 1e4;
      add("VerySoft", soft, 0.01);
    }
  }
  return motions;
}

}  // namespace emmy

#endif  // EMMY_TESTS_CONTRACT_MOTIONS_H_
