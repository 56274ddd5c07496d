#include "emmy/integrate/joint_points.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "emmy/base/types.h"
#include "emmy/integrate/body_packs.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/random_source.h"

namespace emmy {
namespace {

// One pack of bodies with two places and eleven joints, every number random.
class JointPointsTest : public InstructionSetTest {
 protected:
  static constexpr int kPlaces = 2;
  static constexpr int kJoints = 11;  // No multiple of eight.

  JointPointsTest() {
    Fill(weights_.get(), kPlaces * PlaceBlock::kSize * kLanes);
    Fill(first_.get(), 12 * kLanes);
    Fill(second_.get(), 12 * kLanes);
    Fill(rates_.get(), 2 * JointRateBlock::kSize * kLanes);
    Fill(frames_.get(), 2 * kJointFrameSize * kLanes);
    Fill(points_.get(), kPlaces * PointBlock::kSize * kLanes);
    for (size_t k = 0; k < kPlaces * kLanes; ++k) {
      joint_[k] = int64_t{3} * static_cast<int64_t>(k * 5 % (kJoints + 1));
    }
    impulses_ = VectorXd::Zero(3 * (kJoints + 1));
    for (int k = 0; k < 3 * kJoints; ++k) impulses_(k) = Random();
    // Two places for each joint, the last for none.
    for (size_t j = 0; j < kJoints; ++j) {
      point_[0][j] = static_cast<int64_t>(j % kLanes);
      point_[1][j] =
          static_cast<int64_t>(PointBlock::kSize * kLanes + (j * 3) % kLanes);
    }
  }

  double Random() { return random_.Uniform(-1.0, 1.0); }
  void Fill(double* numbers, size_t count) {
    for (size_t k = 0; k < count; ++k) numbers[k] = Random();
  }
  JointPacks Joints() const {
    return {.count = kJoints,
            .point = {point_[0].get(), point_[1].get()},
            .points = points_.get()};
  }
  // The sum of both points of a joint.
  Vector3d AtBoth(size_t joint, int block) const {
    Vector3d sum = Vector3d::Zero();
    for (const auto& point : point_) {
      for (int i = 0; i < 3; ++i) {
        sum(i) += points_[static_cast<size_t>(point[joint]) +
                          static_cast<size_t>(block + i) * kLanes];
      }
    }
    return sum;
  }
  Matrix3d Frame(size_t joint) const {
    return PackMatrix(frames_.get() + joint / kLanes * kJointFrameSize * kLanes,
                      0, joint % kLanes);
  }
  // A few operations on numbers below one.
  static constexpr double kRounding = 1e-14;

  RandomSource random_{17};
  PackArray weights_ = AllocatePacks(kPlaces, PlaceBlock::kSize);
  PackArray first_ = AllocatePacks(1, 12);
  PackArray second_ = AllocatePacks(1, 12);
  PackArray points_ = AllocatePacks(kPlaces + 1, PointBlock::kSize);
  PackArray rates_ = AllocatePacks(2, JointRateBlock::kSize);
  PackArray frames_ = AllocatePacks(2, kJointFrameSize);
  PackArrayOf<int64_t> joint_ = AllocatePacks<int64_t>(kPlaces, 1);
  std::array<PackArrayOf<int64_t>, 2> point_ = {AllocatePacks<int64_t>(2, 1),
                                                AllocatePacks<int64_t>(2, 1)};
  VectorXd impulses_;
};

TEST_F(JointPointsTest, SumsAtPlacesAreThoseOfTheirWeights) {
  SumAtPlaces(weights_.get(), kPlaces, first_.get(), second_.get(),
              points_.get());
  for (size_t lane = 0; lane < kLanes; ++lane) {
    for (size_t place = 0; place < kPlaces; ++place) {
      Vector3d first = Vector3d::Zero();
      Vector3d second = Vector3d::Zero();
      for (int a = 0; a < 4; ++a) {
        const double weight = PackEntry(
            weights_.get() + place * PlaceBlock::kSize * kLanes, a, lane);
        first += weight * PackVector(first_.get(), 3 * a, lane);
        second += weight * PackVector(second_.get(), 3 * a, lane);
      }
      const double* const point =
          points_.get() + place * PointBlock::kSize * kLanes;
      EXPECT_LE((PackVector(point, PointBlock::kFirst, lane) - first).norm(),
                kRounding);
      EXPECT_LE((PackVector(point, PointBlock::kSecond, lane) - second).norm(),
                kRounding);
    }
  }
}

TEST_F(JointPointsTest, ImpulsesActThroughTheWeightsOfTheirPlaces) {
  for (const bool is_first : {true, false}) {
    PackArray loads = AllocatePacks(1, 12);
    Fill(loads.get(), 12 * kLanes);
    const std::vector<double> before(loads.get(), loads.get() + 12 * kLanes);
    AddImpulses(weights_.get(), joint_.get(), kPlaces, -2.0, impulses_.data(),
                is_first, loads.get());
    for (size_t lane = 0; lane < kLanes; ++lane) {
      for (int a = 0; a < 4; ++a) {
        Vector3d expected = Vector3d::Zero();
        if (!is_first) expected = PackVector(before.data(), 3 * a, lane);
        for (size_t place = 0; place < kPlaces; ++place) {
          const double weight = PackEntry(
              weights_.get() + place * PlaceBlock::kSize * kLanes, a, lane);
          expected -= 2.0 * weight *
                      impulses_.segment<3>(joint_[place * kLanes + lane]);
        }
        EXPECT_LE((PackVector(loads.get(), 3 * a, lane) - expected).norm(),
                  kRounding);
      }
    }
  }
}

TEST_F(JointPointsTest, RatesAreTheSumsOfBothPoints) {
  SetJointRates(Joints(), rates_.get());
  for (size_t j = 0; j < kJoints; ++j) {
    const double* const rate =
        rates_.get() + j / kLanes * JointRateBlock::kSize * kLanes;
    EXPECT_EQ(PackVector(rate, JointRateBlock::kRate, j % kLanes),
              AtBoth(j, PointBlock::kFirst));
    EXPECT_EQ(PackVector(rate, JointRateBlock::kRest, j % kLanes),
              AtBoth(j, PointBlock::kSecond));
  }
}

TEST_F(JointPointsTest, RightSideIsInTheFrameOfTheJoint) {
  VectorXd right_side = VectorXd::Constant(3 * kJoints + 3, 7.0);
  SetRightSide(Joints(), rates_.get(), frames_.get(), right_side.data());
  for (size_t j = 0; j < kJoints; ++j) {
    const double* const rate =
        rates_.get() + j / kLanes * JointRateBlock::kSize * kLanes;
    const Vector3d mean = PackVector(rate, JointRateBlock::kRate, j % kLanes) +
                          PackVector(rate, JointRateBlock::kRest, j % kLanes) +
                          0.5 * AtBoth(j, PointBlock::kSecond);
    const Vector3d expected =
        Frame(j).transpose() * (AtBoth(j, PointBlock::kFirst) - 2.0 * mean);
    const auto row = 3 * static_cast<Eigen::Index>(j);
    EXPECT_LE((right_side.segment<3>(row) - expected).norm(), kRounding) << j;
  }
  // Nothing is written beyond.
  EXPECT_EQ(right_side.tail<3>(), Vector3d::Constant(7.0));
}

TEST_F(JointPointsTest, TurnsCorrectionsBack) {
  VectorXd x(3 * kJoints);
  for (double& number : x) number = Random();
  VectorXd step = VectorXd::Constant(3 * kJoints + 3, 7.0);
  VectorXd impulses = impulses_;
  TurnBack(kJoints, frames_.get(), x.data(), step.data(), impulses.data());
  for (size_t j = 0; j < kJoints; ++j) {
    const auto row = 3 * static_cast<Eigen::Index>(j);
    const Vector3d expected = Frame(j) * x.segment<3>(row);
    EXPECT_LE((step.segment<3>(row) - expected).norm(), kRounding) << j;
    EXPECT_EQ(impulses.segment<3>(row),
              impulses_.segment<3>(row) - step.segment<3>(row));
  }
  EXPECT_EQ(step.tail<3>(), Vector3d::Constant(7.0));
  EXPECT_EQ(impulses.tail<3>(), Vector3d::Zero());
}

TEST_F(JointPointsTest, EveryInstructionSetGivesTheSameBits) {
  std::vector<VectorXd> results;
  for (const int64_t target : InstructionSets()) {
    ChooseInstructionSet(target);
    SumAtPlaces(weights_.get(), kPlaces, first_.get(), second_.get(),
                points_.get());
    PackArray loads = AllocatePacks(1, 12);
    AddImpulses(weights_.get(), joint_.get(), kPlaces, 0.7, impulses_.data(),
                /*is_first=*/true, loads.get());
    SetJointRates(Joints(), rates_.get());
    VectorXd right_side(3 * kJoints);
    SetRightSide(Joints(), rates_.get(), frames_.get(), right_side.data());
    VectorXd step(3 * kJoints);
    VectorXd impulses = impulses_;
    TurnBack(kJoints, frames_.get(), right_side.data(), step.data(),
             impulses.data());
    constexpr Eigen::Index kLoads = 12 * kPackLanes;
    VectorXd all(kLoads + right_side.size() + step.size() + impulses.size());
    all << Eigen::Map<const VectorXd>(loads.get(), kLoads), right_side, step,
        impulses;
    results.push_back(all);
    EXPECT_EQ(results.back(), results.front()) << hwy::TargetName(target);
  }
}

}  // namespace
}  // namespace emmy
