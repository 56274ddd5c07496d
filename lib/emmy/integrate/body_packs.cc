#include "emmy/integrate/body_packs.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <utility>

namespace emmy {

Matrix3d PackMatrix(const double* pack, int block, size_t lane) {
  Matrix3d m;
  for (int c = 0; c < 3; ++c) m.col(c) = PackVector(pack, block + 3 * c, lane);
  return m;
}

Matrix3d PackMatrix(const float* pack, int block, size_t lane) {
  Matrix3d m;
  for (int k = 0; k < 9; ++k) {
    m(k) = static_cast<double>(PackEntry(pack, block + k, lane));
  }
  return m;
}

void SetPackMatrix(const Matrix3d& m, double* pack, int block, size_t lane) {
  for (int c = 0; c < 3; ++c) {
    SetPackVector(m.col(c), pack, block + 3 * c, lane);
  }
}

void SetPackSymmetric(const Matrix3d& m, double* pack, int block, size_t lane) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) PackEntry(pack, block++, lane) = m(i, j);
  }
}

BodyPacks::BodyPacks(const Structure& structure, double time_step, size_t packs,
                     std::vector<size_t> slots)
    : structure_(&structure),
      time_step_(time_step),
      packs_(packs),
      slots_(std::move(slots)),
      places_(packs * kLanes),
      start_(AllocatePacks(packs, BodyStartBlock::kSize)),
      iterate_(AllocatePacks(packs, BodyIterateBlock::kSize)),
      scratch_(AllocatePacks(packs, BodyScratchBlock::kSize)),
      frames_(AllocatePacks<float>(packs, BodyFrameBlock::kSize)) {
  for (size_t b = 0; b < slots_.size(); ++b) {
    const ModelBody& body = *structure.bodies[b].body;
    places_[slots_[b]] = {body.position_offset, body.velocity_offset,
                          body.strain_offset};
  }
  for (size_t slot = 0; slot < places_.size(); ++slot) {
    if (places_[slot].position >= 0) continue;
    for (int i = 0; i < 3; ++i) {
      PackEntry(this->start(slot / kLanes),
                BodyStartBlock::kPosition + 3 + 4 * i, slot % kLanes) = 1.0;
    }
  }
  if (structure.forces.empty() && structure.torques.empty()) return;
  NeedLoads();
  constant_loads_.setZero(3, structure.num_vectors());
  for (const Structure::Force& force : structure.forces) {
    for (const WeightedVector& term : force.terms) {
      constant_loads_.col(term.vector) +=
          (time_step * term.weight) * force.force;
    }
  }
}

void BodyPacks::NeedLoads() {
  if (!loads_) loads_ = AllocatePacks(packs_, kNumLoads);
}

void BodyPacks::Load(const State& state, size_t first, size_t last) {
  using B = BodyStartBlock;
  for (size_t pack = first; pack < last; ++pack) {
    double* const begin = start(pack);
    double* const rates = iterate(pack) + BodyIterateBlock::kRateIncrement;
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const Place& place = places_[pack * kLanes + lane];
      if (place.position < 0) {
        // The last step may have failed with anything in it.
        for (int i = 0; i < 12; ++i) PackEntry(rates, i, lane) = 0.0;
        continue;
      }
      const double* const q = state.position.value.data() + place.position;
      const double* const q_rest =
          state.position.compensation.data() + place.position + 3;
      const double* const w = state.velocity.value.data() + place.velocity;
      const double* const w_rest =
          state.velocity.compensation.data() + place.velocity;
      const double* const strain = state.strain.value.data() + place.strain;
      const double* const strain_rest =
          state.strain.compensation.data() + place.strain;
      const double* const next =
          state.acceleration.next.data() + place.velocity;
      for (int i = 0; i < 12; ++i) {
        PackEntry(begin, B::kPosition + i, lane) = q[i];
        PackEntry(begin, B::kVelocity + i, lane) = w[i];
        PackEntry(begin, B::kVelocityCompensation + i, lane) = w_rest[i];
        PackEntry(rates, i, lane) = time_step_ * next[i];
      }
      for (int i = 0; i < 9; ++i) {
        PackEntry(begin, B::kGradientCompensation + i, lane) = q_rest[i];
      }
      for (int k = 0; k < 6; ++k) {
        PackEntry(begin, B::kStrain + k, lane) = strain[k];
        PackEntry(begin, B::kStrainCompensation + k, lane) = strain_rest[k];
      }
    }
  }
}

// Δe of the iterate.
Matrix3d BodyPacks::Increment(size_t slot) {
  const size_t pack = slot / kLanes;
  const size_t lane = slot % kLanes;
  const double* const begin = start(pack);
  using B = BodyStartBlock;
  return time_step_ *
         (PackMatrix(begin, B::kVelocity + 3, lane) +
          (PackMatrix(begin, B::kVelocityCompensation + 3, lane) +
           0.5 * PackMatrix(iterate(pack), BodyIterateBlock::kRateIncrement + 3,
                            lane)));
}

// The dual vectors of ē.
Matrix3d BodyPacks::Duals(size_t slot, const Matrix3d& increment) {
  using B = BodyStartBlock;
  const double* const begin = start(slot / kLanes);
  const Matrix3d mean =
      PackMatrix(begin, B::kPosition + 3, slot % kLanes) +
      (PackMatrix(begin, B::kGradientCompensation, slot % kLanes) +
       0.5 * increment);
  return mean.inverse().transpose();
}

bool BodyPacks::SetLoads() {
  if (constant_loads_.cols() == 0) return false;
  for (size_t b = 0; b < slots_.size(); ++b) {
    double* const here = loads(slots_[b] / kLanes);
    for (int a = 0; a < 4; ++a) {
      SetPackVector(constant_loads_.col(structure_->bodies[b].first + a), here,
                    3 * a, slots_[b] % kLanes);
    }
  }
  // (EM-12)
  for (const Structure::Torque& torque : structure_->torques) {
    const size_t slot = slots_[static_cast<size_t>(torque.first) / 4];
    const Matrix3d duals = Duals(slot, Increment(slot));
    double* const here = loads(slot / kLanes);
    for (int i = 0; i < 3; ++i) {
      const Vector3d load = PackVector(here, 3 + 3 * i, slot % kLanes);
      SetPackVector(
          load + (0.5 * time_step_) * torque.torque.cross(duals.col(i)), here,
          3 + 3 * i, slot % kLanes);
    }
  }
  return true;
}

void BodyPacks::AddLoadWork(State& state) {
  double work = 0.0;
  for (const Structure::Force& force : structure_->forces) {
    for (const WeightedVector& term : force.terms) {
      const auto vector = static_cast<size_t>(term.vector);
      const size_t slot = slots_[vector / 4];
      work += term.weight *
              force.force.dot(PackVector(scratch(slot / kLanes),
                                         BodyScratchBlock::kPositionIncrement +
                                             3 * static_cast<int>(vector % 4),
                                         slot % kLanes));
    }
  }
  for (const Structure::Torque& torque : structure_->torques) {
    const size_t slot = slots_[static_cast<size_t>(torque.first) / 4];
    const Matrix3d increment = Increment(slot);
    const Matrix3d duals = Duals(slot, increment);
    for (int i = 0; i < 3; ++i) {
      work += 0.5 * torque.torque.cross(duals.col(i)).dot(increment.col(i));
    }
  }
  state.load_work.Add(work);
}

void BodyPacks::Commit(size_t first, size_t last, int order, State& state,
                       Extrapolation::Errors* errors) {
  constexpr size_t kOrders = Extrapolation::kOrders;
  std::array<double, kOrders * kErrorLanes> lanes{};
  for (size_t slot = first * kLanes; slot < last * kLanes; ++slot) {
    const Place& at = places_[slot];
    if (at.position < 0) continue;
    const BodyPlace place = {
        .value = {state.position.value.data() + at.position,
                  state.velocity.value.data() + at.velocity,
                  state.strain.value.data() + at.strain},
        .compensation = {state.position.compensation.data() + at.position,
                         state.velocity.compensation.data() + at.velocity,
                         state.strain.compensation.data() + at.strain},
        .differences = state.acceleration.differences.data() + at.velocity,
        .order_stride = state.acceleration.differences.rows(),
        .next = state.acceleration.next.data() + at.velocity};
    CommitBody(scratch(slot / kLanes), iterate(slot / kLanes),
               static_cast<int>(slot % kLanes), time_step_, order, place,
               lanes.data());
  }
  for (size_t p = 0; p < kOrders; ++p) {
    for (size_t lane = 0; lane < kErrorLanes; ++lane) {
      (*errors)[p] = std::max((*errors)[p], lanes[p * kErrorLanes + lane]);
    }
  }
}

void BodyPacks::Predict(size_t first, size_t last, int order,
                        State& state) const {
  for (size_t slot = first * kLanes; slot < last * kLanes; ++slot) {
    if (places_[slot].position < 0) continue;
    state.acceleration.Predict(places_[slot].velocity, 12, order);
  }
}

}  // namespace emmy
