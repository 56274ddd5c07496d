#include "emmy/integrate/joint_net.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "emmy/integrate/joint_compliance.h"

namespace emmy {
namespace {

constexpr size_t kGroupLength = 64;  // Packs.

size_t NumPacks(size_t bodies) { return (bodies + kLanes - 1) / kLanes; }

std::vector<size_t> InOrder(size_t bodies) {
  std::vector<size_t> slots(bodies);
  std::iota(slots.begin(), slots.end(), size_t{0});
  return slots;
}

// The joints of each body.
std::vector<std::vector<int>> JointsOfBodies(
    const std::vector<BodyJoint>& joints) {
  std::vector<std::vector<int>> of_body;
  for (size_t j = 0; j < joints.size(); ++j) {
    for (const int body : joints[j].bodies) {
      if (body == BodyJoint::kNone) continue;
      const auto b = static_cast<size_t>(body);
      if (b >= of_body.size()) of_body.resize(b + 1);
      of_body[b].push_back(static_cast<int>(j));
    }
  }
  return of_body;
}

}  // namespace

SymmetricBlockMatrix JointNet::MakeMatrix(
    const std::vector<BodyJoint>& joints) {
  std::vector<std::pair<int, int>> pairs;
  for (const std::vector<int>& mine : JointsOfBodies(joints)) {
    for (const int row : mine) {
      for (const int column : mine) {
        if (row >= column) pairs.emplace_back(row, column);
      }
    }
  }
  return SymmetricBlockMatrix(static_cast<int>(joints.size()), pairs);
}

JointNet::JointNet(const Structure& structure,
                   const std::vector<BodyJoint>& joints, double time_step)
    : structure_(&structure),
      time_step_(time_step),
      shift_(JointShift(structure)),
      packs_(structure, time_step, NumPacks(structure.bodies.size()),
             InOrder(structure.bodies.size())),
      joints_(joints.size()),
      matrix_(MakeMatrix(joints)),
      factor_(matrix_, /*positive_definite=*/true),
      pieces_(AllocatePacks((packs_.packs() + kGroupLength - 1) / kGroupLength,
                            PieceBlock::kSize)) {
  packs_.NeedLoads();
  for (size_t j = 0; j < joints.size(); ++j) {
    Joint& joint = joints_[j];
    joint.weights = joints[j].weights;
    joint.multiplier = MultiplierOffset(structure, static_cast<int>(j));
    for (size_t side = 0; side < 2; ++side) {
      if (joints[j].bodies[side] == BodyJoint::kNone) continue;
      joint.slots[side] = static_cast<size_t>(joints[j].bodies[side]);
      ++joint.num_bodies;
    }
  }
  MakeCouplings(structure, joints);
  constexpr int kSize = BodyConstants::kBodySize;
  constants_ = AllocatePacks(packs_.packs(), kSize);
  for (size_t pack = 0; pack < packs_.packs(); ++pack) {
    constants_of_pack_.push_back(constants_.get() + pack * kSize * kLanes);
  }
  for (size_t b = 0; b < structure.bodies.size(); ++b) {
    SetBodyConstants(structure, static_cast<int>(b), time_step,
                     constants_.get() + b / kLanes * kSize * kLanes,
                     b % kLanes);
  }
  right_side_.setZero(3 * static_cast<Eigen::Index>(joints.size()));
  solution_ = right_side_;
}

void JointNet::MakeCouplings(const Structure& structure,
                             const std::vector<BodyJoint>& joints) {
  const std::vector<std::vector<int>> of_body = JointsOfBodies(joints);
  for (size_t b = 0; b < of_body.size(); ++b) {
    const JointCompliance compliance(*structure.bodies[b].body->ancf(),
                                     time_step_);
    const int body = static_cast<int>(b);
    for (const int row : of_body[b]) {
      for (const int column : of_body[b]) {
        if (row < column) continue;
        couplings_.push_back({.row = row,
                              .column = column,
                              .slot = b,
                              .compliance = compliance.Between(
                                  JointWeights(joints, row, body),
                                  JointWeights(joints, column, body)),
                              .place = matrix_.Find(row, column)});
      }
    }
  }
}

ChainGroup JointNet::Group(size_t group) {
  const size_t first = group * kGroupLength;
  ChainGroup g;
  g.length = static_cast<int>(std::min(kGroupLength, packs_.packs() - first));
  g.time_step = time_step_;
  std::copy_n(structure_->gravity.data(), 3, g.gravity);
  g.constants = constants_of_pack_.data() + first;
  g.start = packs_.start(first);
  g.loads = packs_.loads(first);
  g.iterate = packs_.iterate(first);
  g.scratch = packs_.scratch(first);
  g.piece = pieces_.get() + group * PieceBlock::kSize * kLanes;
  return g;
}

void JointNet::Load(const State& state) {
  using B = BodyStartBlock;
  is_fresh_ = false;
  packs_.Load(state, 0, packs_.packs());
  for (Joint& joint : joints_) {
    joint.impulse =
        time_step_ * state.multiplier.next.segment<3>(joint.multiplier);
    joint.rate.setZero();
    joint.rest.setZero();
    for (int side = 0; side < joint.num_bodies; ++side) {
      const size_t slot = joint.slots[static_cast<size_t>(side)];
      const Vector4d& weight = joint.weights[static_cast<size_t>(side)];
      const double* const start = packs_.start(slot / kLanes);
      for (int a = 0; a < 4; ++a) {
        joint.rate +=
            weight(a) * PackVector(start, B::kVelocity + 3 * a, slot % kLanes);
        joint.rest +=
            weight(a) *
            PackVector(start, B::kVelocityCompensation + 3 * a, slot % kLanes);
      }
    }
  }
}

// Adds `factor` times Gᵀ of the impulses, or of their corrections.
void JointNet::AddToLoads(double factor, bool steps) {
  for (const Joint& joint : joints_) {
    const Vector3d impulse = factor * (steps ? joint.step : joint.impulse);
    for (int side = 0; side < joint.num_bodies; ++side) {
      const size_t slot = joint.slots[static_cast<size_t>(side)];
      const Vector4d& weight = joint.weights[static_cast<size_t>(side)];
      double* const loads = packs_.loads(slot / kLanes);
      for (int a = 0; a < 4; ++a) {
        for (int i = 0; i < 3; ++i) {
          PackEntry(loads, 3 * a + i, slot % kLanes) += weight(a) * impulse(i);
        }
      }
    }
  }
}

const JointSums& JointNet::Evaluate(ForwardWork work) {
  packs_.ClearLoads();
  packs_.SetLoads();
  AddToLoads(-1.0, /*steps=*/false);
  const size_t groups = (packs_.packs() + kGroupLength - 1) / kGroupLength;
  for (size_t group = 0; group < groups; ++group) {
    ChainForward(Group(group), work);
  }
  AddPieceSums(work, pieces_.get(), groups, &sums_);
  if (renew_) is_singular_ = !Factorize();
  return sums_;
}

// Of the first body of a joint.
Matrix3d JointNet::Frame(const Joint& joint) {
  return PackMatrix(packs_.scratch(joint.slots[0] / kLanes),
                    BodyScratchBlock::kFrame, joint.slots[0] % kLanes);
}

bool JointNet::Factorize() {
  renew_ = false;
  is_fresh_ = true;
  ++num_factorizations_;
  matrix_.SetZero();
  for (const Coupling& coupling : couplings_) {
    const Matrix3d body =
        PackMatrix(packs_.scratch(coupling.slot / kLanes),
                   BodyScratchBlock::kFrame, coupling.slot % kLanes);
    const Matrix3d left =
        Frame(joints_[static_cast<size_t>(coupling.row)]).transpose() * body;
    const Matrix3d right =
        Frame(joints_[static_cast<size_t>(coupling.column)]).transpose() * body;
    Matrix3d block = left * coupling.compliance * right.transpose();
    if (coupling.row == coupling.column) {
      // Half of it for each of two bodies would do as well.
      block.diagonal().array() += shift_;
    }
    matrix_.Add(coupling.place, block);
  }
  return factor_.Factorize(matrix_);
}

JointCorrection JointNet::Correct(std::optional<ForwardWork> /*next*/) {
  using S = BodyScratchBlock;
  for (size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = joints_[j];
    Vector3d side = Vector3d::Zero();
    Vector3d rest = joint.rest;
    for (int k = 0; k < joint.num_bodies; ++k) {
      const size_t slot = joint.slots[static_cast<size_t>(k)];
      const Vector4d& weight = joint.weights[static_cast<size_t>(k)];
      const double* const scratch = packs_.scratch(slot / kLanes);
      const double* const iterate = packs_.iterate(slot / kLanes);
      for (int a = 0; a < 4; ++a) {
        side += weight(a) *
                PackVector(scratch, S::kCorrection + 3 * a, slot % kLanes);
        rest += (0.5 * weight(a)) *
                PackVector(iterate, BodyIterateBlock::kRateIncrement + 3 * a,
                           slot % kLanes);
      }
    }
    right_side_.segment<3>(3 * static_cast<Eigen::Index>(j)) =
        Frame(joint).transpose() * (side - 2.0 * (joint.rate + rest));
  }
  if (is_singular_) {
    solution_.setConstant(std::numeric_limits<double>::quiet_NaN());
  } else {
    factor_.Solve(right_side_, &solution_);
  }
  for (size_t j = 0; j < joints_.size(); ++j) {
    Joint& joint = joints_[j];
    joint.step =
        Frame(joint) * solution_.segment<3>(3 * static_cast<Eigen::Index>(j));
    joint.impulse -= joint.step;
  }
  packs_.ClearLoads();
  AddToLoads(1.0, /*steps=*/true);
  const size_t groups = (packs_.packs() + kGroupLength - 1) / kGroupLength;
  for (size_t group = 0; group < groups; ++group) ChainBackward(Group(group));
  return PieceCorrection(pieces_.get(), groups);
}

void JointNet::Commit(State& state) {
  const size_t groups = (packs_.packs() + kGroupLength - 1) / kGroupLength;
  for (size_t group = 0; group < groups; ++group) ChainFinish(Group(group));
  packs_.AddLoadWork(state);
  Extrapolation::Errors errors{};
  packs_.Commit(0, packs_.packs(), rate_order_, state, &errors);
  const int rate_order = Extrapolation::BestOrder(errors);
  if (rate_order != rate_order_) {
    packs_.Predict(0, packs_.packs(), rate_order, state);
  }
  rate_order_ = rate_order;
  Extrapolation::Errors multiplier_errors{};
  for (const Joint& joint : joints_) {
    state.multiplier.Add(joint.multiplier, joint.impulse / time_step_,
                         &multiplier_errors);
  }
  const int order = Extrapolation::BestOrder(multiplier_errors);
  for (const Joint& joint : joints_) {
    state.multiplier.Predict(joint.multiplier, 3, order);
  }
}

bool JointNet::Renew() {
  if (is_fresh_) return false;
  renew_ = true;
  return true;
}

KeptTangent JointNet::Keep() const {
  KeptTangent kept;
  if (!renew_) kept.matrix = matrix_.values();
  return kept;
}

bool JointNet::Restore(const KeptTangent& kept) {
  renew_ = true;
  if (kept.matrix.size() == 0) return true;
  if (kept.matrix.size() != matrix_.values().size()) return false;
  matrix_.SetValues(kept.matrix);
  is_singular_ = !factor_.Factorize(matrix_);
  renew_ = is_singular_;
  return !is_singular_;
}

}  // namespace emmy
