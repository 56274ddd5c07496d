#include "emmy/integrate/joint_chain.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "emmy/integrate/joint_compliance.h"

namespace emmy {
namespace {

// Longer pieces leave fewer joints between them, shorter ones stay in the
// cache from one sweep to the next.
constexpr size_t kLongestPiece = 64;
constexpr size_t kPerGroup = kLanes * kLongestPiece;

}  // namespace

JointChain::JointChain(const Structure& structure,
                       const std::vector<BodyJoint>& joints, const BodyRow& row,
                       double time_step, int num_threads)
    : structure_(&structure),
      time_step_(time_step),
      shift_(JointShift(structure)),
      groups_((row.bodies.size() + kPerGroup - 1) / kPerGroup),
      length_((row.bodies.size() + groups_ * kLanes - 1) / (groups_ * kLanes)),
      multipliers_(groups_ * length_ * kLanes, -1),
      factor_(AllocatePacks<float>(groups_ * length_, JointFactorBlock::kSize)),
      pieces_(AllocatePacks(groups_, PieceBlock::kSize)),
      separators_(groups_ * kLanes),
      team_(std::min(static_cast<size_t>(num_threads), groups_)),
      errors_(team_.size()) {
  std::vector<size_t> slots(structure.bodies.size());
  for (size_t i = 0; i < row.bodies.size(); ++i) {
    if (row.bodies[i] != BodyJoint::kNone) {
      slots[static_cast<size_t>(row.bodies[i])] = Slot(i);
    }
    if (row.joints[i] != BodyJoint::kNone) {
      multipliers_[Slot(i)] = MultiplierOffset(structure, row.joints[i]);
    }
  }
  packs_ = std::make_unique<BodyPacks>(structure, time_step, groups_ * length_,
                                       std::move(slots));
  MakeConstants(joints, row);
}

// Of place i of the row.
size_t JointChain::Slot(size_t i) const {
  const size_t piece = i / length_;
  return (piece / kLanes * length_ + i % length_) * kLanes + piece % kLanes;
}

void JointChain::MakeConstants(const std::vector<BodyJoint>& joints,
                               const BodyRow& row) {
  using C = BodyConstants;
  constexpr int kNone = BodyJoint::kNone;
  constexpr size_t kBlock = C::kSize * kLanes;
  // Equal packs share their constants.
  std::map<std::vector<double>, size_t> known;
  std::vector<size_t> index;
  std::vector<double> block(kBlock);
  for (size_t pack = 0; pack < groups_ * length_; ++pack) {
    std::fill(block.begin(), block.end(), 0.0);
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const size_t i =
          (pack / length_ * kLanes + lane) * length_ + pack % length_;
      const bool inside = i < row.bodies.size();
      const int body = inside ? row.bodies[i] : kNone;
      const int right = inside ? row.joints[i] : kNone;
      const int left = inside && i > 0 ? row.joints[i - 1] : kNone;
      SetBodyConstants(*structure_, body, time_step_, block.data(), lane);
      SetJointConstants(*structure_, body, time_step_,
                        JointWeights(joints, right, body),
                        JointWeights(joints, left, body), block.data(), lane);
      if (right == kNone) {
        // Any matrix will do, the right side is zero.
        SetPackSymmetric(shift_ / kJointShift * Matrix3d::Identity(),
                         block.data(), C::kRightCompliance, lane);
      }
    }
    index.push_back(known.try_emplace(block, known.size()).first->second);
  }
  constants_ = AllocatePacks(known.size(), C::kSize);
  for (const auto& [values, number] : known) {
    std::copy(values.begin(), values.end(), constants_.get() + number * kBlock);
  }
  for (const size_t number : index) {
    constants_of_pack_.push_back(constants_.get() + number * kBlock);
  }
}

ChainGroup JointChain::Group(size_t group) {
  const size_t first = group * length_;
  ChainGroup g;
  g.length = static_cast<int>(length_);
  g.time_step = time_step_;
  g.shift = shift_;
  std::copy_n(structure_->gravity.data(), 3, g.gravity);
  g.constants = constants_of_pack_.data() + first;
  g.start = packs_->start(first);
  g.loads = packs_->loads(first);
  g.iterate = packs_->iterate(first);
  g.scratch = packs_->scratch(first);
  g.frames = packs_->frames(first);
  g.factor = factor_.get() + first * JointFactorBlock::kSize * kLanes;
  g.piece = pieces_.get() + group * PieceBlock::kSize * kLanes;
  return g;
}

// Block of the group a piece belongs to; its lane is piece % kLanes.
double* JointChain::Piece(size_t piece) {
  return pieces_.get() + piece / kLanes * PieceBlock::kSize * kLanes;
}

void JointChain::Load(const State& state) {
  state_ = &state;
  is_evaluated_ = false;
}

void JointChain::LoadGroup(const State& state, size_t group) {
  const size_t first = group * length_;
  packs_->Load(state, first, first + length_);
  const auto impulse = [this, &state](size_t slot) -> Vector3d {
    const Eigen::Index multiplier = multipliers_[slot];
    if (multiplier < 0) return Vector3d::Zero();
    return time_step_ * state.multiplier.next.segment<3>(multiplier);
  };
  for (size_t slot = first * kLanes; slot < (first + length_) * kLanes;
       ++slot) {
    SetPackVector(impulse(slot), packs_->iterate(slot / kLanes),
                  BodyIterateBlock::kImpulse, slot % kLanes);
  }
  for (size_t piece = group * kLanes; piece < (group + 1) * kLanes; ++piece) {
    if (piece == 0) continue;
    SetPackVector(impulse(Slot(piece * length_ - 1)), Piece(piece),
                  PieceBlock::kLeftImpulse, piece % kLanes);
  }
}

const JointSums& JointChain::Evaluate(ForwardWork work) {
  const State* const state = std::exchange(state_, nullptr);
  const bool has_loads = packs_->loads(0) != nullptr;
  if (has_loads) {
    for (size_t group = 0; group < groups_ && state != nullptr; ++group) {
      LoadGroup(*state, group);
    }
    static_cast<void>(packs_->SetLoads());
  }
  if (!std::exchange(is_evaluated_, false)) {
    team_.Run(groups_, [&](size_t, size_t first, size_t last) {
      for (size_t group = first; group < last; ++group) {
        if (state != nullptr && !has_loads) LoadGroup(*state, group);
        ChainForward(Group(group), work);
      }
    });
  }
  AddPieceSums(work, pieces_.get(), groups_, &sums_);
  if (work == ForwardWork::kFactorize) FactorizeSeparators();
  return sums_;
}

void JointChain::FactorizeSeparators() {
  using P = PieceBlock;
  ++num_factorizations_;
  Matrix3d taken = Matrix3d::Zero();
  for (size_t i = 0; i < separators_.size(); ++i) {
    Separator& separator = separators_[i];
    const size_t lane = i % kLanes;
    Matrix3d diagonal = PackMatrix(Piece(i), P::kRightMatrix, lane) +
                        shift_ * Matrix3d::Identity() - taken;
    if (i + 1 == separators_.size()) {
      separator.inverse = diagonal.inverse();
      break;
    }
    const double* const next = Piece(i + 1);
    const size_t next_lane = (i + 1) % kLanes;
    diagonal += PackMatrix(next, P::kLeftMatrix, next_lane);
    separator.inverse = diagonal.inverse();
    separators_[i + 1].below.noalias() =
        PackMatrix(next, P::kBelow, next_lane) * separator.inverse;
    separators_[i + 1].above = PackMatrix(next, P::kAbove, next_lane);
    taken.noalias() = separators_[i + 1].below * separators_[i + 1].above;
  }
}

void JointChain::SolveSeparators() {
  using P = PieceBlock;
  Vector3d before = Vector3d::Zero();
  for (size_t i = 0; i < separators_.size(); ++i) {
    const double* const piece = Piece(i);
    const size_t lane = i % kLanes;
    Vector3d side = PackVector(piece, P::kRightSide, lane);
    Vector3d rate = PackVector(piece, P::kRightRate, lane);
    Vector3d rest = PackVector(piece, P::kRightRest, lane);
    if (i + 1 < separators_.size()) {
      const double* const next = Piece(i + 1);
      const size_t next_lane = (i + 1) % kLanes;
      side += PackVector(next, P::kLeftSide, next_lane);
      rate += PackVector(next, P::kLeftRate, next_lane);
      rest += PackVector(next, P::kLeftRest, next_lane);
    }
    before = (side - 2.0 * (rate + rest)) - separators_[i].below * before;
    separators_[i].step = before;
  }
  Vector3d after = Vector3d::Zero();
  for (size_t i = separators_.size(); i-- > 0;) {
    Separator& separator = separators_[i];
    if (i + 1 < separators_.size()) {
      separator.step -= separators_[i + 1].above * after;
    }
    const Vector3d step = separator.inverse * separator.step;
    separator.step = after = step;
    SetPackVector(step, Piece(i), P::kRightStep, i % kLanes);
    if (i + 1 < separators_.size()) {
      double* const next = Piece(i + 1);
      const size_t lane = (i + 1) % kLanes;
      SetPackVector(step, next, P::kLeftStep, lane);
      SetPackVector(PackVector(next, P::kLeftImpulse, lane) - step, next,
                    P::kLeftImpulse, lane);
    }
  }
}

JointCorrection JointChain::Correct(std::optional<ForwardWork> next) {
  SolveSeparators();
  // While a group is in the cache. Torques depend on the iterate.
  is_evaluated_ = next.has_value() && packs_->loads(0) == nullptr;
  team_.Run(groups_, [&](size_t, size_t first, size_t last) {
    for (size_t group = first; group < last; ++group) {
      ChainBackward(Group(group));
      if (is_evaluated_) ChainForward(Group(group), *next);
    }
  });
  return PieceCorrection(pieces_.get(), groups_);
}

void JointChain::CommitGroup(size_t group, State& state, Errors* errors) {
  const size_t first = group * length_;
  ChainFinish(Group(group));
  packs_->Commit(first, first + length_, rate_order_, state, &errors->rate);
  for (size_t slot = first * kLanes; slot < (first + length_) * kLanes;
       ++slot) {
    if (multipliers_[slot] < 0) continue;
    state.multiplier.Add(multipliers_[slot],
                         PackVector(packs_->iterate(slot / kLanes),
                                    BodyIterateBlock::kImpulse, slot % kLanes) /
                             time_step_,
                         &errors->multiplier);
  }
}

void JointChain::PredictJoints(size_t group, State& state) const {
  const size_t first = group * length_;
  for (size_t slot = first * kLanes; slot < (first + length_) * kLanes;
       ++slot) {
    if (multipliers_[slot] < 0) continue;
    state.multiplier.Predict(multipliers_[slot], 3, multiplier_order_);
  }
}

void JointChain::Commit(State& state) {
  std::fill(errors_.begin(), errors_.end(), Errors{});
  team_.Run(groups_, [&](size_t member, size_t first, size_t last) {
    for (size_t group = first; group < last; ++group) {
      // Predicted in the cache, with the order that is most often right.
      CommitGroup(group, state, &errors_[member]);
      PredictJoints(group, state);
    }
  });
  if (packs_->loads(0) != nullptr) packs_->AddLoadWork(state);
  Errors all{};
  for (const Errors& errors : errors_) {
    for (size_t p = 0; p < all.rate.size(); ++p) {
      all.rate[p] = std::max(all.rate[p], errors.rate[p]);
      all.multiplier[p] = std::max(all.multiplier[p], errors.multiplier[p]);
    }
  }
  const int rate_order = Extrapolation::BestOrder(all.rate);
  const int multiplier_order = Extrapolation::BestOrder(all.multiplier);
  if (rate_order == rate_order_ && multiplier_order == multiplier_order_) {
    return;
  }
  rate_order_ = rate_order;
  multiplier_order_ = multiplier_order;
  team_.Run(groups_, [&](size_t, size_t first, size_t last) {
    for (size_t group = first; group < last; ++group) {
      packs_->Predict(group * length_, (group + 1) * length_, rate_order_,
                      state);
      PredictJoints(group, state);
    }
  });
}

}  // namespace emmy
