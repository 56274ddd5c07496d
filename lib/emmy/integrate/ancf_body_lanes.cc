// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/integrate/ancf_body_lanes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/integrate/ancf_body_lanes.cc"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "emmy/integrate/body_lanes-inl.h"
#include "emmy/numerics/compensated_lanes-inl.h"
#include "emmy/numerics/four_lanes-inl.h"
#include "emmy/numerics/unit_roundoff.h"
#include "emmy/numerics/vector_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

// A step is one long chain of operations that wait for each other. What the
// chain need not wait for is taken out of it: halves are carried instead of
// being formed, which is exact, and nothing is divided. Of a matrix with a row
// for each vector and a column along each, `own` holds the diagonal, `next` the
// entries (i, i + 1) and `previous` the entries (i, i + 2), cyclic.
HWY_INLINE BodyStepResult SolveBody(const AncfBodyLanes& body,
                                    const BodyStartNumbers& start,
                                    AncfLanesIncrement* increment) {
  const double dt = body.time_step;
  const Lanes step = Lanes::Set(dt);
  const Lanes half_step = Lanes::Set(0.5 * dt);
  const Vectors w0 = LoadVectors(start.velocity);
  const Vectors w_low = LoadVectors(start.velocity_low);
  const Vectors e0 = LoadVectors(start.position);
  const Vectors e_low = LoadVectors(start.position_low);
  const Lanes stretch0 = FromLast(Lanes::LoadPairs(start.strain));
  const Lanes stretch_low = FromLast(Lanes::LoadPairs(start.strain_low));
  // The first lane holds ε₃ here and ε₄ above; both are multiplied by zero.
  const Lanes shear0 = Lanes::LoadPairs(start.strain + 2);
  const Lanes shear_low = Lanes::LoadPairs(start.strain_low + 2);

  BodyStepResult result;
  StagnationMonitor strain_monitor(0x1p-6);
  StagnationMonitor rotation_monitor;
  Vectors half_dw = half_step * LoadVectors(start.next);
  for (int i = 1;; ++i) {
    const Vectors mean_w = w0 + (w_low + half_dw);
    const Vectors half_de = half_step * mean_w;
    const Vectors e = e0 + (e_low + half_de);  // ē
    const Vectors e_next = Next(e);
    // Ēᵀ ½Δe, without its diagonal.
    const Lanes forth = Dot(e_next, half_de);    // (i, i + 1)
    const Lanes back = Dot(e, Next(half_de));    // (i + 1, i)
    const Lanes back_previous = Previous(back);  // (i, i + 2)
    const Lanes half_stretch = Dot(e, half_de);
    const Lanes mean_stretch = stretch0 + (stretch_low + half_stretch);
    const Lanes mean_shear = shear0 + (shear_low + (forth + back));
    const Lanes stretch_impulse = Lanes::Load(body.stretch) * mean_stretch;
    const Lanes shear_impulse = Lanes::Load(body.shear) * mean_shear;

    // (LANE-1): det Ē Ē⁻¹ Δw M, then with the stress, and all that times
    // 2 − det Ē, which is 1/det Ē but for the square of its distance to 1.
    const Vectors normal = Cross(e_next, Previous(e));
    const Vectors momentum = Lanes::Load(body.twice_moment) * half_dw;
    const Lanes volume = Dot(e, normal);
    const Lanes scale = Lanes::Set(2.0) - volume;
    const Lanes scaled_volume = volume * scale;
    const Lanes inertia_own = scale * Dot(normal, momentum);
    const Lanes inertia_next = scale * Dot(Next(normal), momentum);
    const Lanes inertia_previous = scale * Dot(Previous(normal), momentum);
    // One product for both entries: the stress is symmetric to the bit, and its
    // rounding turns nothing.
    const Lanes shear_part = scaled_volume * shear_impulse;
    const Lanes turning = inertia_next - Next(inertia_previous);

    // (EM-6).
    const Lanes own0 = Lanes::Load(body.half_inverse) *
                       (inertia_own + scaled_volume * stretch_impulse);
    const Lanes next0 =
        Lanes::Load(body.half_first) * (inertia_next + shear_part) +
        Lanes::Load(body.half_shear) * turning;
    const Lanes previous0 = Lanes::Load(body.half_second) *
                                (inertia_previous + Previous(shear_part)) -
                            Lanes::Load(body.half_shear_previous) *
                                (Previous(inertia_next) - inertia_previous);
    const Lanes own0_next = Next(own0);
    const Lanes next0_next = Next(next0);

    // (LANE-2): the frame turns by half a step, the stress with its vectors.
    const Lanes turned_stretch = forth * next0 + back_previous * previous0;
    const Lanes turned_shear =
        (back * own0 + forth * own0_next) +
        (Next(forth) * previous0 + back_previous * next0_next);
    const Lanes moment =
        Lanes::Set(0.25 * dt) *
        ((stretch_impulse * next0 + shear_impulse * (own0_next - own0) -
          Next(stretch_impulse) * Next(previous0)) +
         (Previous(shear_impulse) * Previous(previous0) -
          Next(shear_impulse) * Previous(next0)));
    const Lanes own = own0 - Lanes::Load(body.stretch_share) * turned_stretch;
    const Lanes next = next0 - (Lanes::Load(body.first_share) * turned_shear +
                                Lanes::Load(body.first_moment) * moment);
    const Lanes previous =
        previous0 - Previous(Lanes::Load(body.second_share) * turned_shear -
                             Lanes::Load(body.second_moment) * moment);
    half_dw = half_dw - ((own * e + next * e_next) + previous * Previous(e));

    result.iterations = i;
    result.correction =
        2.0 * LargestOfBody(MaxAbs(Vectors{own, next, previous}));
    const double rate = LargestOfBody(MaxAbs(mean_w));
    const double impulse =
        LargestOfBody(Max(Abs(stretch_impulse), Abs(shear_impulse)));
    // (LANE-3)
    const double size = result.correction;
    const double turn = LargestOfBody(Max(Abs(forth), Abs(back)));
    const double metric =
        2.0 * (turn * turn +
               LargestOfBody(Max(Max(Abs(mean_stretch), Abs(half_stretch)),
                                 Abs(mean_shear))));
    const double stiffening = body.stiffening * impulse;
    const double quadratic = body.second_order * size;
    const double slowness = 16.0 * turn * turn + 6.0 * metric + stiffening;
    // Only of a sequence that contracts the last member says what follows.
    constexpr double kSlow = 0.5;
    constexpr int kUsual = 2;
    if (i >= kUsual && !(slowness <= kSlow)) return result;
    bool done = false;
    const bool contracts = slowness + quadratic <= kSlow;
    if (contracts && body.options.tolerance.has_value()) {
      // A component of the correction has up to √3 of its largest entry.
      constexpr double kRootOfThree = 1.7320508075688773;
      done = kRootOfThree * size <= *body.options.tolerance * rate;
    } else if (contracts) {
      const double strain_floor =
          4.0 * kUnitRoundoff * rate;  // AncfBodyStep's.
      const double rotation_floor =
          kUnitRoundoff * (2.0 * LargestOfBody(MaxAbs(half_dw)) +
                           impulse / body.smallest_moment_sum);
      const double strain_left = (slowness + quadratic) * size;
      const double rotation_left = (stiffening * (4.0 * turn + stiffening) +
                                    4.0 * metric * metric + quadratic) *
                                   size;
      done = strain_left <= 0x1p-6 * strain_floor &&
             rotation_left <= 0x1p-6 * rotation_floor;
      if (!done && i > kUsual) {
        // Where a step turns the body far, the bounds are too pessimistic.
        const bool strain_done = strain_monitor.Update(size, strain_floor);
        const bool rotation_done = rotation_monitor.Update(
            LargestOfBody(Abs(turning)) / body.smallest_moment_sum,
            rotation_floor);
        done = strain_done && rotation_done;
      }
    }
    if (done) break;
    // A handful of iterations is what this tangent is for.
    constexpr int kEnough = 12;
    if (i >= std::min(kEnough, body.options.max_iterations)) return result;
  }

  // Δe = Δt w̄ as a pair. Rounded, w̄ lies on a lattice of its own, which the
  // iteration has met already: what that drops need not be random.
  const VectorsAndError mean_w = SumExactly(w0, w_low + half_dw);
  VectorsAndError de = ScaledExactly(step, mean_w.value);
  de.error = de.error + step * mean_w.error;
  const Vectors e = e0 + (e_low + Lanes::Set(0.5) * de.value);
  const auto [stretch, shear] = StrainIncrementsOf(e, de);
  const Vectors dw = half_dw + half_dw;
  StoreInterleaved(de.value.x, de.value.y, de.value.z, increment->gradients);
  StoreInterleaved(de.error.x, de.error.y, de.error.z,
                   increment->gradients_low);
  StoreInterleaved(dw.x, dw.y, dw.z, increment->rates);
  stretch.Store(increment->stretch);
  shear.Store(increment->shear);
  // What is not finite in one of them is not in the sum either.
  const Lanes sum = (dw.x + dw.y) + (dw.z + (stretch + shear));
  result.termination =
      IsFiniteOfBody(sum) ? Termination::kConverged : Termination::kNonFinite;
  return result;
}

HWY_INLINE void CommitBody(const AncfLanesIncrement& increment,
                           double time_step,
                           const CentreIncrement& centre_increment,
                           const BodyNumbers& numbers) {
  const Lanes step = Lanes::Set(time_step);
  double* const position = numbers.position;
  double* const position_low = numbers.position_low;
  double* const velocity = numbers.velocity;
  double* const velocity_low = numbers.velocity_low;
  double* const strain = numbers.strain;
  double* const strain_low = numbers.strain_low;
  // The centre's, in the lanes before the first of e₁.
  const Lanes centre = Lanes::Load(centre_increment.value);
  const LanesSum motion = CentreMotion(centre, velocity, velocity_low, step);
  AddPairTo({SelectLast(motion.value, Lanes::Load(increment.gradients)),
             SelectLast(motion.error, Lanes::Load(increment.gradients_low))},
            position, position_low);
  AddTo(SelectLast(centre, Lanes::Load(increment.rates)), velocity,
        velocity_low);
  for (int i = 4; i < 12; i += 4) {
    AddPairTo({Lanes::Load(increment.gradients + i),
               Lanes::Load(increment.gradients_low + i)},
              position + i, position_low + i);
    AddTo(Lanes::Load(increment.rates + i), velocity + i, velocity_low + i);
  }
  // Six numbers, the middle two in both vectors.
  const Lanes stretch = Lanes::Load(increment.stretch);
  const Lanes shear = Lanes::Load(increment.shear);
  const LanesSum low =
      TwoSum(Lanes::LoadPairs(strain),
             SelectLast(FromSecond(stretch), FromSecond(FromSecond(shear))) +
                 Lanes::LoadPairs(strain_low));
  const LanesSum high = TwoSum(Lanes::LoadPairs(strain + 2),
                               shear + Lanes::LoadPairs(strain_low + 2));
  low.value.StorePairs(strain);
  low.error.StorePairs(strain_low);
  high.value.StoreLastPair(strain + 4);
  high.error.StoreLastPair(strain_low + 4);

  Lanes accelerations[3];
  for (size_t i = 0; i < 3; ++i) {
    accelerations[i] =
        Lanes::Set(1.0 / time_step) * Lanes::Load(increment.rates + 4 * i);
  }
  accelerations[0] = SelectLast(Lanes::Set(0.0), accelerations[0]);
  Extrapolate(accelerations, numbers.differences, numbers.next);
}

BodyStepResult Solve(const AncfBodyLanes& body, const BodyStartNumbers& start,
                     AncfLanesIncrement* increment) {
  return SolveBody(body, start, increment);
}

void Commit(const AncfLanesIncrement& increment, double time_step,
            const CentreIncrement& centre, const BodyNumbers& numbers) {
  CommitBody(increment, time_step, centre, numbers);
}

BodyStepResult Advance(const AncfBodyLanes& body, const BodyStartNumbers& start,
                       const CentreIncrement& centre,
                       const BodyNumbers& numbers) {
  AncfLanesIncrement increment;
  const BodyStepResult result = SolveBody(body, start, &increment);
  if (result.termination == Termination::kConverged) {
    CommitBody(increment, body.time_step, centre, numbers);
  }
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(Solve);
HWY_EXPORT(Commit);
HWY_EXPORT(Advance);

bool AncfBodyLanes::Fits(const AncfRigidBody& body) {
  const Matrix3d& moment = body.second_moment();
  const Matrix3d diagonal = moment.diagonal().asDiagonal();
  return moment == diagonal;
}

AncfBodyLanes::AncfBodyLanes(const AncfRigidBody& body, double step,
                             const NewtonOptions& newton)
    : time_step(step), options(newton) {
  const Vector3d moments = body.second_moment().diagonal();
  const Vector6d& b = body.penalty_stiffness();
  smallest_moment_sum = moments.sum() - moments.maxCoeff();
  const double quarter = 0.25 * step * step;
  double largest_inverse = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto [m, n] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    const double c = quarter * b(3 + i);
    const int pair = 1 + i;
    const int second = 1 + (i + 1) % 3;
    twice_moment[pair] = 2.0 * moments(i);
    stretch[pair] = step * b(i);
    shear[pair] = step * b(3 + i);
    half_inverse[pair] = 0.5 / (moments(i) + quarter * b(i));
    stretch_share[pair] = quarter * b(i) / (moments(i) + quarter * b(i));
    // The determinant without the cancellation of c² − c².
    const double determinant =
        moments(m) * moments(n) + c * (moments(m) + moments(n));
    half_first[pair] = 0.5 * moments(n) / determinant;
    half_second[second] = 0.5 * moments(m) / determinant;
    half_shear[pair] = 0.5 * c / determinant;
    half_shear_previous[second] = half_shear[pair];
    first_share[pair] = c * moments(n) / determinant;
    second_share[pair] = c * moments(m) / determinant;
    first_moment[pair] = (0.5 * moments(n) + c) / determinant;
    second_moment[pair] = (0.5 * moments(m) + c) / determinant;
    largest_inverse =
        std::max({largest_inverse, 2.0 * half_inverse[pair],
                  (std::max(moments(m), moments(n)) + 2.0 * c) / determinant});
  }
  stiffening = 1.5 * std::abs(step) * largest_inverse;
  second_order =
      std::abs(step) *
      (1.0 + 2.0 * largest_inverse *
                 (moments.maxCoeff() + 3.0 * quarter * b.maxCoeff()));
}

void AncfLanesIncrement::Set(const AncfBodyIncrement& increment) {
  std::copy_n(increment.gradients.data(), 9, gradients + 3);
  std::fill_n(gradients_low, 12, 0.0);
  std::copy_n(increment.rates.data(), 9, rates + 3);
  std::copy_n(increment.strain.data(), 3, stretch + 1);
  std::copy_n(increment.strain.data() + 3, 3, shear + 1);
}

BodyStepResult SolveInLanes(const AncfBodyLanes& lanes, const ModelBody& body,
                            const State& state, AncfLanesIncrement* increment) {
  return HWY_DYNAMIC_DISPATCH(Solve)(lanes, BodyStartNumbers(body, state),
                                     increment);
}

void CommitInLanes(const AncfLanesIncrement& increment, double time_step,
                   const CentreIncrement& centre, const ModelBody& body,
                   State& state) {
  HWY_DYNAMIC_DISPATCH(Commit)
  (increment, time_step, centre, BodyNumbers(body, state));
}

BodyStepResult AdvanceInLanes(const AncfBodyLanes& lanes,
                              const CentreIncrement& centre,
                              const ModelBody& body, State& state) {
  return HWY_DYNAMIC_DISPATCH(Advance)(lanes, BodyStartNumbers(body, state),
                                       centre, BodyNumbers(body, state));
}

}  // namespace emmy
#endif  // HWY_ONCE
