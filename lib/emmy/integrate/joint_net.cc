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
      num_joints_(static_cast<int>(joints.size())),
      matrix_(MakeMatrix(joints)),
      factor_(matrix_, /*positive_definite=*/true),
      pieces_(AllocatePacks((packs_.packs() + kGroupLength - 1) / kGroupLength,
                            PieceBlock::kSize)) {
  packs_.NeedLoads();
  for (int j = 0; j < num_joints_; ++j) {
    multipliers_.push_back(MultiplierOffset(structure, j));
  }
  MakePlaces(joints);
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
  right_side_.setZero(3 * Eigen::Index{num_joints_});
  solution_ = right_side_;
  impulses_.setZero(right_side_.size() + 3);
  steps_ = impulses_;
}

void JointNet::MakePlaces(const std::vector<BodyJoint>& joints) {
  std::vector<std::vector<int>> of_body = JointsOfBodies(joints);
  of_body.resize(packs_.packs() * kLanes);
  first_place_.push_back(0);
  for (size_t pack = 0; pack < packs_.packs(); ++pack) {
    size_t places = 0;
    for (size_t lane = 0; lane < kLanes; ++lane) {
      places = std::max(places, of_body[pack * kLanes + lane].size());
    }
    first_place_.push_back(first_place_.back() + places);
  }
  const size_t num_places = first_place_.back();
  const size_t joint_packs = NumPacks(joints.size());
  weights_ = AllocatePacks(num_places, PlaceBlock::kSize);
  // The last is zero: of the side of a joint that has no body.
  points_ = AllocatePacks(num_places + 1, PointBlock::kSize);
  constexpr auto kPoint = static_cast<int64_t>(PointBlock::kSize * kLanes);
  const int64_t no_point = static_cast<int64_t>(num_places) * kPoint;
  joint_of_place_ = AllocatePacks<int64_t>(num_places, 1);
  std::fill_n(joint_of_place_.get(), num_places * kLanes,
              int64_t{3} * num_joints_);
  for (auto& points : point_of_joint_) {
    points = AllocatePacks<int64_t>(joint_packs, 1);
    std::fill_n(points.get(), joint_packs * kLanes, no_point);
  }
  rates_ = AllocatePacks(joint_packs, JointRateBlock::kSize);
  frames_ = AllocatePacks(joint_packs, kJointFrameSize);
  for (size_t slot = 0; slot < of_body.size(); ++slot) {
    const auto body = static_cast<int>(slot);
    size_t place = first_place_[slot / kLanes];
    for (const int joint : of_body[slot]) {
      const auto j = static_cast<size_t>(joint);
      const size_t side = joints[j].bodies[0] == body ? 0 : 1;
      double* const weights =
          weights_.get() + place * PlaceBlock::kSize * kLanes;
      for (int a = 0; a < 4; ++a) {
        PackEntry(weights, PlaceBlock::kWeight + a, slot % kLanes) =
            joints[j].weights[side](a);
      }
      joint_of_place_[place * kLanes + slot % kLanes] = int64_t{3} * joint;
      point_of_joint_[side][j] = static_cast<int64_t>(place) * kPoint +
                                 static_cast<int64_t>(slot % kLanes);
      ++place;
    }
  }
  for (const BodyJoint& joint : joints) {
    first_bodies_.push_back(static_cast<size_t>(joint.bodies[0]));
  }
}

int JointNet::NumPlaces(size_t pack) const {
  return static_cast<int>(first_place_[pack + 1] - first_place_[pack]);
}

JointPacks JointNet::Joints() const {
  return {.count = num_joints_,
          .point = {point_of_joint_[0].get(), point_of_joint_[1].get()},
          .points = points_.get()};
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
  g.frames = packs_.frames(first);
  g.piece = pieces_.get() + group * PieceBlock::kSize * kLanes;
  return g;
}

void JointNet::Load(const State& state) {
  using B = BodyStartBlock;
  is_fresh_ = false;
  frames_are_old_ = true;
  packs_.Load(state, 0, packs_.packs());
  SumPoints([this](size_t pack) {
    const double* const start = packs_.start(pack);
    return std::pair(start + B::kVelocity * kLanes,
                     start + B::kVelocityCompensation * kLanes);
  });
  SetJointRates(Joints(), rates_.get());
  for (int j = 0; j < num_joints_; ++j) {
    impulses_.segment<3>(3 * Eigen::Index{j}) =
        time_step_ *
        state.multiplier.next.segment<3>(multipliers_[static_cast<size_t>(j)]);
  }
}

// Gᵀ of the impulses, times `factor`, in the loads of a group.
void JointNet::SetImpulses(size_t group, double factor,
                           const VectorXd& impulses, bool is_first) {
  const size_t first = group * kGroupLength;
  const size_t last = std::min(first + kGroupLength, packs_.packs());
  for (size_t pack = first; pack < last; ++pack) {
    const size_t place = first_place_[pack];
    AddImpulses(weights_.get() + place * PlaceBlock::kSize * kLanes,
                joint_of_place_.get() + place * kLanes, NumPlaces(pack), factor,
                impulses.data(), is_first, packs_.loads(pack));
  }
}

const JointSums& JointNet::Evaluate(ForwardWork work) {
  const bool has_loads = packs_.SetLoads();
  const size_t groups = (packs_.packs() + kGroupLength - 1) / kGroupLength;
  for (size_t group = 0; group < groups; ++group) {
    SetImpulses(group, -1.0, impulses_, /*is_first=*/!has_loads);
    ChainForward(Group(group), work);
  }
  AddPieceSums(work, pieces_.get(), groups, &sums_);
  // They turn so little in an iteration that those of its start will do.
  if (std::exchange(frames_are_old_, false) || renew_) SetFrames();
  if (renew_) is_singular_ = !Factorize();
  return sums_;
}

// Of the first body of each joint.
void JointNet::SetFrames() {
  for (int j = 0; j < num_joints_; ++j) {
    const auto joint = static_cast<size_t>(j);
    const size_t slot = first_bodies_[joint];
    SetPackMatrix(PackMatrix(packs_.frames(slot / kLanes),
                             BodyFrameBlock::kFrame, slot % kLanes),
                  frames_.get() + joint / kLanes * kJointFrameSize * kLanes, 0,
                  joint % kLanes);
  }
}

Matrix3d JointNet::Frame(int joint) const {
  const auto j = static_cast<size_t>(joint);
  return PackMatrix(frames_.get() + j / kLanes * kJointFrameSize * kLanes, 0,
                    j % kLanes);
}

bool JointNet::Factorize() {
  renew_ = false;
  is_fresh_ = true;
  ++num_factorizations_;
  matrix_.SetZero();
  for (const Coupling& coupling : couplings_) {
    const Matrix3d body =
        PackMatrix(packs_.frames(coupling.slot / kLanes),
                   BodyFrameBlock::kFrame, coupling.slot % kLanes);
    const Matrix3d left = Frame(coupling.row).transpose() * body;
    const Matrix3d right = Frame(coupling.column).transpose() * body;
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
  SumPoints([this](size_t pack) {
    return std::pair(
        packs_.scratch(pack) + BodyScratchBlock::kCorrection * kLanes,
        packs_.iterate(pack) + BodyIterateBlock::kRateIncrement * kLanes);
  });
  SetRightSide(Joints(), rates_.get(), frames_.get(), right_side_.data());
  if (is_singular_) {
    solution_.setConstant(std::numeric_limits<double>::quiet_NaN());
  } else {
    factor_.Solve(right_side_, &solution_);
  }
  TurnBack(num_joints_, frames_.get(), solution_.data(), steps_.data(),
           impulses_.data());
  const size_t groups = (packs_.packs() + kGroupLength - 1) / kGroupLength;
  for (size_t group = 0; group < groups; ++group) {
    SetImpulses(group, 1.0, steps_, /*is_first=*/true);
    ChainBackward(Group(group));
  }
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
  for (int j = 0; j < num_joints_; ++j) {
    state.multiplier.Add(multipliers_[static_cast<size_t>(j)],
                         impulses_.segment<3>(3 * Eigen::Index{j}) / time_step_,
                         &multiplier_errors);
  }
  const int order = Extrapolation::BestOrder(multiplier_errors);
  for (const Eigen::Index multiplier : multipliers_) {
    state.multiplier.Predict(multiplier, 3, order);
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
