// Compiled once for each instruction set: Highway includes this file again
// from foreach_target.h.

#include "emmy/integrate/lined_body_lanes.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "emmy/integrate/body_numbers.h"

// The part that is read once, before the first instruction set's.
#ifndef EMMY_INTEGRATE_LINED_BODY_LANES_CC_
#define EMMY_INTEGRATE_LINED_BODY_LANES_CC_
namespace emmy {

// Lanes "of the body": centre, e₁, e₂, e₃. Lanes "of the lines": line by line,
// or node by node. What does not exist is zero.
struct LinedBodyLanes::Constants {
  using Four = std::array<double, 4>;

  double time_step = 0.0;
  NewtonOptions options;
  int num_lines = 0;
  std::vector<LineElement> elements;
  alignas(32) Four stretch{};  // b of the stretches [J], of the body.
  alignas(32) Four shear{};    // b of the pairs (e₁, e₂), … [J].
  // 2 M: a column for each vector of the body, that of the nodes alone, a
  // column of the body for each node, and of the nodes for each vector.
  alignas(32) std::array<Four, 4> body_mass{};
  alignas(32) Four node_mass{};
  alignas(32) std::array<Four, 4> node_column{};
  alignas(32) std::array<Four, 4> body_column{};
  // Weights of a line's ends: of its node; of a vector of the body, over the
  // lines; and the same of a line, over the vectors.
  alignas(32) Four node_weight{};
  alignas(32) std::array<Four, 4> vector_weight{};
  alignas(32) std::array<Four, 4> line_weight{};
  // |a| Σ |a| of a line's weights: of its node, over the lines; of the vectors,
  // a column a line.
  alignas(32) Four node_share{};
  alignas(32) std::array<Four, 4> line_share{};
  // Δt times gravity's force, a row a component.
  alignas(32) std::array<Four, 3> body_impulse{};
  alignas(32) std::array<Four, 3> node_impulse{};
  // B of (LANE-4): of each input (component k, vector v) the outputs of three
  // components, on the body's vectors and on the nodes.
  struct Outputs {
    alignas(32) std::array<Four, 3> body{};
    alignas(32) std::array<Four, 3> node{};
  };
  std::array<std::array<Outputs, 8>, 3> inverse{};
  // B a of each line, by the component of ĝ.
  std::array<std::array<Outputs, 3>, 4> line_response{};
};

namespace {

// What is gathered from the state: rows are x, y and z, lanes the nodes.
struct NodeState {
  using Four = std::array<double, 4>;
  alignas(32) std::array<Four, 3> position{};
  alignas(32) std::array<Four, 3> position_low{};
  alignas(32) std::array<Four, 3> rate{};
  alignas(32) std::array<Four, 3> rate_low{};
  alignas(32) std::array<Four, 3> acceleration{};
  alignas(32) Four strain{};
  alignas(32) Four strain_low{};
};

constexpr double kRootThree = 1.7320508075688772;

struct LinedIncrement {
  double body_position[12];
  double body_rate[12];
  double strain[8];  // From the second number on.
  std::array<std::array<double, 4>, 3> node_position;
  std::array<std::array<double, 4>, 3> node_rate;
  std::array<double, 4> line;
};

// Solves (1 + C H) X = 1 for the few lines there are.
void InvertSmall(int n, const double (&matrix)[4][4], double (&inverse)[4][4]) {
  double a[4][4];
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      a[i][j] = matrix[i][j];
      inverse[i][j] = i == j ? 1.0 : 0.0;
    }
  }
  // C H is similar to a positive semidefinite matrix: pivots are at least one.
  for (int k = 0; k < n; ++k) {
    const double pivot = 1.0 / a[k][k];
    for (int j = 0; j < n; ++j) {
      a[k][j] *= pivot;
      inverse[k][j] *= pivot;
    }
    for (int i = 0; i < n; ++i) {
      if (i == k) continue;
      const double factor = a[i][k];
      for (int j = 0; j < n; ++j) {
        a[i][j] -= factor * a[k][j];
        inverse[i][j] -= factor * inverse[k][j];
      }
    }
  }
}

}  // namespace
}  // namespace emmy
#endif  // EMMY_INTEGRATE_LINED_BODY_LANES_CC_

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "emmy/integrate/lined_body_lanes.cc"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
//
#include "emmy/numerics/compensated_lanes-inl.h"
#include "emmy/numerics/four_lanes-inl.h"
#include "emmy/numerics/unit_roundoff.h"
#include "emmy/numerics/vector_lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace emmy {
namespace HWY_NAMESPACE {

using Constants = LinedBodyLanes::Constants;
using Four = Constants::Four;

HWY_INLINE Lanes At(const Four& numbers) { return Lanes::Load(numbers.data()); }
HWY_INLINE Vectors At(const std::array<Four, 3>& rows) {
  return {At(rows[0]), At(rows[1]), At(rows[2])};
}
HWY_INLINE void Put(const Vectors& v, std::array<Four, 3>* rows) {
  v.x.Store((*rows)[0].data());
  v.y.Store((*rows)[1].data());
  v.z.Store((*rows)[2].data());
}

// The four vectors of the body, each in every lane.
struct Spread {
  Vectors v[4];
};
HWY_INLINE Spread SpreadOf(const Vectors& a) {
  return {{Broadcast<0>(a), Broadcast<1>(a), Broadcast<2>(a), Broadcast<3>(a)}};
}

// Σ columns[v] times vector v.
HWY_INLINE Vectors Combine(const std::array<Four, 4>& columns,
                           const Spread& spread) {
  return (At(columns[0]) * spread.v[0] + At(columns[1]) * spread.v[1]) +
         (At(columns[2]) * spread.v[2] + At(columns[3]) * spread.v[3]);
}

// The same for the first `count` lanes of `a`.
HWY_INLINE Vectors CombineLines(const std::array<Four, 4>& columns,
                                const Vectors& a, int count) {
  Vectors sum = At(columns[0]) * Broadcast<0>(a);
  if (count > 1) sum = sum + At(columns[1]) * Broadcast<1>(a);
  if (count > 2) sum = sum + At(columns[2]) * Broadcast<2>(a);
  if (count > 3) sum = sum + At(columns[3]) * Broadcast<3>(a);
  return sum;
}

// Σ columns[l] times number l of the lines; of those that are not there, zero.
HWY_INLINE Lanes CombineShares(const std::array<Four, 4>& columns,
                               const Lanes& numbers) {
  alignas(32) double of[4];
  numbers.Store(of);
  return (At(columns[0]) * Lanes::Set(of[0]) +
          At(columns[1]) * Lanes::Set(of[1])) +
         (At(columns[2]) * Lanes::Set(of[2]) +
          At(columns[3]) * Lanes::Set(of[3]));
}

// Components along three directions: of the body's vectors and of the nodes.
struct Pair {
  Vectors body, node;
};

// B y, (LANE-4).
HWY_INLINE Pair ApplyInverse(const Constants& constants, const Pair& y) {
  alignas(32) double in[3][8];
  y.body.x.Store(in[0]);
  y.node.x.Store(in[0] + 4);
  y.body.y.Store(in[1]);
  y.node.y.Store(in[1] + 4);
  y.body.z.Store(in[2]);
  y.node.z.Store(in[2] + 4);
  const Vectors zero = {Lanes::Set(0.0), Lanes::Set(0.0), Lanes::Set(0.0)};
  // Two sums each: they wait for each other less.
  Pair even = {zero, zero};
  Pair odd = {zero, zero};
  const size_t count = static_cast<size_t>(4 + constants.num_lines);
  for (size_t v = 0; v < count; ++v) {
    for (size_t k = 0; k < 3; ++k) {
      const Constants::Outputs& outputs = constants.inverse[k][v];
      const Lanes value = Lanes::Set(in[k][v]);
      Pair& sum = (k & 1U) != 0 ? odd : even;
      sum.body = sum.body + value * At(outputs.body);
      sum.node = sum.node + value * At(outputs.node);
    }
  }
  return {even.body + odd.body, even.node + odd.node};
}

// What the lines add to the tangent at one point: (LANE-5).
struct LineTangent {
  Vectors along;         // ēᵏ·d̄, over the lines.
  Lanes slope;           // t'
  Lanes c;               // ½ Δt² t'
  Pair response[4];      // h of each line.
  double inverse[4][4];  // (1 + C ĝᵀh)⁻¹
};

// ĝᵀ x of every line.
HWY_INLINE Lanes LineProduct(const Constants& constants, const Vectors& along,
                             const Pair& x) {
  const Vectors ends = At(constants.node_weight) * x.node +
                       Combine(constants.vector_weight, SpreadOf(x.body));
  return Dot(along, ends);
}

HWY_INLINE void MakeTangent(const Constants& constants, const Vectors& along,
                            const Lanes& slope, LineTangent* tangent) {
  const double dt = constants.time_step;
  const Lanes c = Lanes::Set(0.5 * dt * dt) * slope;
  tangent->along = along;
  tangent->slope = slope;
  tangent->c = c;
  alignas(32) double a[3][4];
  along.x.Store(a[0]);
  along.y.Store(a[1]);
  along.z.Store(a[2]);
  double matrix[4][4] = {};
  const auto count = static_cast<size_t>(constants.num_lines);
  for (size_t m = 0; m < count; ++m) {
    const auto& response = constants.line_response[m];
    Pair& h = tangent->response[m];
    h.body = Lanes::Set(a[0][m]) * At(response[0].body) +
             Lanes::Set(a[1][m]) * At(response[1].body) +
             Lanes::Set(a[2][m]) * At(response[2].body);
    h.node = Lanes::Set(a[0][m]) * At(response[0].node) +
             Lanes::Set(a[1][m]) * At(response[1].node) +
             Lanes::Set(a[2][m]) * At(response[2].node);
    alignas(32) double column[4];
    (c * LineProduct(constants, along, h)).Store(column);
    for (size_t l = 0; l < count; ++l) matrix[l][m] = column[l];
    matrix[m][m] += 1.0;
  }
  InvertSmall(constants.num_lines, matrix, tangent->inverse);
}

HWY_INLINE double Sum(const Lanes& a) {
  alignas(32) double lanes[4];
  a.Store(lanes);
  return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
}

// Sizes in the residual, of the body's vectors and of the nodes, and their
// norm with weights: how a law adds them.
struct Sizes {
  Lanes body, node;
};
HWY_INLINE double SquareOf(const Sizes& size, const Sizes& weight) {
  return Sum(size.body * size.body * weight.body +
             size.node * size.node * weight.node);
}

BodyStepResult SolveLined(const Constants& constants,
                          const BodyStartNumbers& body, const NodeState& nodes,
                          LinedIncrement* increment) {
  const double dt = constants.time_step;
  const int count = constants.num_lines;
  const Lanes step = Lanes::Set(dt);
  const Lanes half_step = Lanes::Set(0.5 * dt);
  const Vectors w0 = LoadVectors(body.velocity);
  const Vectors w_low = LoadVectors(body.velocity_low);
  const Vectors e0 = LoadVectors(body.position);
  const Vectors e_low = LoadVectors(body.position_low);
  const Vectors node_w0 = At(nodes.rate);
  const Vectors node_w_low = At(nodes.rate_low);
  const Vectors x0 = At(nodes.position);
  const Vectors x_low = At(nodes.position_low);
  const Lanes stretch0 = FromLast(Lanes::Load(body.strain));
  const Lanes stretch_low = FromLast(Lanes::Load(body.strain_low));
  // The first lane holds what is above and below; both are multiplied by zero.
  const Lanes shear0 = Lanes::Load(body.strain + 2);
  const Lanes shear_low = Lanes::Load(body.strain_low + 2);
  // d₀ from the values alone, since the difference of neighbours is exact.
  const Lanes node_weight = At(constants.node_weight);
  const Vectors start =
      node_weight * x0 + Combine(constants.vector_weight, SpreadOf(e0));
  const Vectors rest =
      node_weight * x_low + Combine(constants.vector_weight, SpreadOf(e_low));

  BodyStepResult result;
  StagnationMonitor rate_monitor(kNegligibleRest, /*explains_rounding=*/true);
  StagnationMonitor force_monitor = StagnationMonitor::OfLaw();
  StagnationMonitor moment_monitor = StagnationMonitor::OfLaw();
  StagnationMonitor work_monitor = StagnationMonitor::OfLaw();
  LineTangent tangent;
  Vectors half_dw = half_step * LoadVectors(body.next);
  Vectors node_half_dw = half_step * At(nodes.acceleration);
  for (int i = 1;; ++i) {
    // (EM-1)
    const Vectors mean_w = w0 + (w_low + half_dw);
    const Vectors node_mean_w = node_w0 + (node_w_low + node_half_dw);
    const Vectors half_de = half_step * mean_w;
    const Vectors half_dx = half_step * node_mean_w;
    const Vectors e = e0 + (e_low + half_de);
    const Vectors x = x0 + (x_low + half_dx);

    // The lines.
    const Vectors half_change =
        node_weight * half_dx +
        Combine(constants.vector_weight, SpreadOf(half_de));
    const Vectors d = start + (rest + half_change);
    const Lanes ds = Lanes::Set(2.0) * Dot(d, half_change);
    alignas(32) double ds_of[4];
    ds.Store(ds_of);
    alignas(32) double tension[4] = {};
    alignas(32) double derivative[4] = {};
    for (int l = 0; l < count; ++l) {
      const auto line = static_cast<size_t>(l);
      const LineElement::Response response = constants.elements[line].Respond(
          nodes.strain[line], nodes.strain_low[line], ds_of[l]);
      tension[l] = response.tension_factor;
      derivative[l] = response.derivative;
      increment->line[line] = response.increment;
    }
    const Vectors pull = (step * Lanes::Load(tension)) * d;

    // The body.
    const Vectors e_next = Next(e);
    const Vectors e_previous = Previous(e);
    const Lanes half_stretch = Dot(e, half_de);
    const Lanes half_shear = Dot(e_next, half_de) + Dot(e, Next(half_de));
    const Lanes stretch_stress =
        At(constants.stretch) * (stretch0 + (stretch_low + half_stretch));
    const Lanes shear_stress =
        At(constants.shear) * (shear0 + (shear_low + half_shear));
    const Vectors force = step * ((stretch_stress * e + shear_stress * e_next) +
                                  Previous(shear_stress) * e_previous);

    // (EM-9)
    const Spread half_dw_spread = SpreadOf(half_dw);
    const Vectors inertia =
        Combine(constants.body_mass, half_dw_spread) +
        CombineLines(constants.node_column, node_half_dw, count);
    const Vectors node_inertia = At(constants.node_mass) * node_half_dw +
                                 Combine(constants.body_column, half_dw_spread);
    const Vectors pull_on_body =
        CombineLines(constants.line_weight, pull, count);
    const Vectors pull_on_node = node_weight * pull;
    const Vectors impulse = inertia - At(constants.body_impulse);
    const Vectors node_impulse = node_inertia - At(constants.node_impulse);
    const Vectors residual = (impulse + pull_on_body) + force;
    const Vectors node_residual = node_impulse + pull_on_node;

    // Along the dual vectors.
    const Vectors normal = Cross(e_next, e_previous);
    const Lanes volume = Dot(e, normal) + Lanes::First(1.0);
    const Vectors dual = (Lanes::Set(1.0) / volume) * normal;
    const Vectors dual1 = Broadcast<1>(dual);
    const Vectors dual2 = Broadcast<2>(dual);
    const Vectors dual3 = Broadcast<3>(dual);
    const Pair y = {
        {Dot(residual, dual1), Dot(residual, dual2), Dot(residual, dual3)},
        {Dot(node_residual, dual1), Dot(node_residual, dual2),
         Dot(node_residual, dual3)}};
    const Lanes slope = Lanes::Load(derivative);
    // Once more where the first start was far off.
    if (i <= 2) {
      MakeTangent(constants, {Dot(d, dual1), Dot(d, dual2), Dot(d, dual3)},
                  slope, &tangent);
    }
    Pair z = ApplyInverse(constants, y);
    alignas(32) double s[4];
    (tangent.c * LineProduct(constants, tangent.along, z)).Store(s);
    for (int l = 0; l < count; ++l) {
      double mu = 0.0;
      for (int m = 0; m < count; ++m) mu += tangent.inverse[l][m] * s[m];
      const Lanes factor = Lanes::Set(mu);
      z.body = z.body - factor * tangent.response[l].body;
      z.node = z.node - factor * tangent.response[l].node;
    }
    const Vectors correction =
        z.body.x * dual1 + z.body.y * dual2 + z.body.z * dual3;
    const Vectors node_correction =
        z.node.x * dual1 + z.node.y * dual2 + z.node.z * dual3;
    const Lanes half = Lanes::Set(0.5);
    half_dw = half_dw - half * correction;
    node_half_dw = node_half_dw - half * node_correction;

    result.iterations = i;
    result.correction =
        Largest(Max(MaxAbs(correction), MaxAbs(node_correction)));
    const Lanes rates = Max(Max(MaxAbs(mean_w), MaxAbs(node_mean_w)),
                            Max(MaxAbs(w0), MaxAbs(node_w0)));
    const double rate = Largest(rates);
    bool done = false;
    if (constants.options.tolerance.has_value()) {
      done = result.correction <= *constants.options.tolerance * rate;
    } else {
      // As in CoupledStep::RoundingFloors; but where lines are as stiff as the
      // tangent says, what the laws would find next is known (LANE-6), and
      // need not be seen: they are looked at late.
      const double rate_floor = 4.0 * kUnitRoundoff * rate;
      const bool rate_done = rate_monitor.Update(result.correction, rate_floor);
      const bool is_tangent = Largest(Abs(slope - tangent.slope)) == 0.0;
      const double near = is_tangent ? 16.0 : 1e5;
      if (rate_done || result.correction <= near * rate_floor) {
        const Lanes one = Lanes::Set(1.0);
        const Sizes ones = {one, one};
        const Sizes arms = {Dot(e, e), Dot(x, x)};
        const Sizes rates_square = {Dot(mean_w, mean_w),
                                    Dot(node_mean_w, node_mean_w)};
        const Sizes size = {
            MaxAbs(inertia) + (MaxAbs(force) + MaxAbs(pull_on_body)),
            MaxAbs(node_inertia) + MaxAbs(pull_on_node)};
        const double force_size = SquareOf(size, ones);
        const double moment_size = SquareOf(size, arms);
        const double work_size = SquareOf(size, rates_square);

        if (rate_done && is_tangent) {
          // What K₀ has not exactly: the metric, and directions of lines.
          const double delta =
              std::sqrt(Largest(Max(Dot(correction, correction),
                                    Dot(node_correction, node_correction))));
          const Lanes shear = Abs(Dot(e, e_next));
          const Lanes metric = Lanes::Set(Largest(
              WithoutFirst(Abs(arms.body - one) + (shear + Previous(shear)))));
          const Vectors along = {Dot(d, dual1), Dot(d, dual2), Dot(d, dual3)};
          const Lanes turned =
              Lanes::Set(3.0 * delta) * tangent.c *
              (MaxAbs(tangent.along) * MaxAbs(along - tangent.along));
          // With twice the mass, for the norm is √3 of the largest component.
          const Spread spread = SpreadOf(correction);
          const Sizes lost = {
              metric * MaxAbs(Combine(constants.body_mass, spread) +
                              CombineLines(constants.node_column,
                                           node_correction, count)) +
                  CombineShares(constants.line_share, turned),
              metric * MaxAbs(At(constants.node_mass) * node_correction +
                              Combine(constants.body_column, spread)) +
                  At(constants.node_share) * turned};
          // What moves with ē.
          const Lanes moved = Lanes::Set(0.25 * std::abs(dt) * delta);
          const Lanes arm = Lanes::Set(kRootThree) * moved;
          const Sizes moment_left = {lost.body + arm * MaxAbs(impulse),
                                     lost.node + arm * MaxAbs(node_impulse)};
          // Stresses and tensions at the end of the step.
          const Lanes step_size = Abs(step);
          const Lanes end_shear =
              Abs(shear_stress) + Abs(At(constants.shear) * half_shear);
          const Lanes end_stress =
              step_size * ((Abs(stretch_stress) +
                            Abs(At(constants.stretch) * half_stretch)) +
                           (end_shear + Previous(end_shear)));
          const Lanes end_tension =
              step_size * (Abs(Lanes::Load(tension)) + Abs(slope * ds));
          const Sizes work_left = {
              lost.body +
                  moved * (end_stress +
                           CombineShares(constants.line_share, end_tension)),
              lost.node + moved * (At(constants.node_share) * end_tension)};
          // All of it has to be below a floor, and what is not rounding, which
          // adds up, far below. A sum of n is at most √n times its norm.
          const double share =
              std::min(1.0, rate_monitor.expected() / result.correction);
          const double scale =
              std::max(1.0, share / kNegligibleRest) / kUnitRoundoff;
          const double limit = (4.0 + count) * scale * scale;
          const Sizes moment_arms = {Max(one, arms.body), Max(one, arms.node)};
          done = limit * SquareOf(lost, ones) <= force_size &&
                 limit * SquareOf(moment_left, moment_arms) <= moment_size &&
                 limit * SquareOf(work_left, rates_square) <= work_size;
        }
        if (!done) {
          const Lanes centre = Lanes::First(1.0);
          const double net =
              std::max({std::abs(Sum(centre * residual.x + node_residual.x)),
                        std::abs(Sum(centre * residual.y + node_residual.y)),
                        std::abs(Sum(centre * residual.z + node_residual.z))});
          const Vectors moments = Cross(e, residual) + Cross(x, node_residual);
          const double moment =
              std::max({std::abs(Sum(moments.x)), std::abs(Sum(moments.y)),
                        std::abs(Sum(moments.z))});
          const double work = std::abs(
              Sum(Dot(mean_w, residual) + Dot(node_mean_w, node_residual)));
          const bool force_done =
              force_monitor.Update(net, kUnitRoundoff * std::sqrt(force_size));
          const bool moment_done = moment_monitor.Update(
              moment, kUnitRoundoff * std::sqrt(moment_size));
          const bool work_done =
              work_monitor.Update(work, kUnitRoundoff * std::sqrt(work_size));
          done = rate_done && force_done && moment_done && work_done;
        }
      }
    }
    if (done) {
      // A step that changes velocities by more than themselves is looked at
      // more closely by CoupledStep: it may have run away.
      const double change = Largest(Max(MaxAbs(half_dw), MaxAbs(node_half_dw)));
      if (!(change <= 0.25 * rate)) return result;
      break;
    }
    constexpr int kEnough = 16;
    if (i >= std::min(kEnough, constants.options.max_iterations)) return result;
  }

  // Δq and Δε of the final Δw.
  const Lanes half = Lanes::Set(0.5);
  const VectorsAndError exact_de = ScaledExactly(step, w0 + (w_low + half_dw));
  const Vectors& de = exact_de.value;
  const Vectors dx = step * (node_w0 + (node_w_low + node_half_dw));
  const Vectors e = e0 + (e_low + half * de);
  const auto [stretch, shear] = StrainIncrementsOf(e, exact_de);
  const Vectors change =
      node_weight * dx + Combine(constants.vector_weight, SpreadOf(de));
  const Vectors d = start + (rest + half * change);
  alignas(32) double ds_of[4];
  Dot(d, change).Store(ds_of);
  double finite = 0.0;
  for (int l = 0; l < count; ++l) {
    const auto line = static_cast<size_t>(l);
    increment->line[line] =
        constants.elements[line]
            .Respond(nodes.strain[line], nodes.strain_low[line], ds_of[l])
            .increment;
    finite += increment->line[line];
  }
  const Vectors dw = half_dw + half_dw;
  StoreInterleaved(de.x, de.y, de.z, increment->body_position);
  StoreInterleaved(dw.x, dw.y, dw.z, increment->body_rate);
  // In this order: the lane that means nothing is overwritten.
  shear.Store(increment->strain + 3);
  stretch.Store(increment->strain);
  Put(dx, &increment->node_position);
  const Vectors node_dw = node_half_dw + node_half_dw;
  Put(node_dw, &increment->node_rate);
  finite += Sum((dw.x + dw.y) + dw.z) +
            Sum((node_dw.x + node_dw.y) + node_dw.z) + Sum(stretch + shear);
  result.termination = finite - finite == 0.0 ? Termination::kConverged
                                              : Termination::kNonFinite;
  return result;
}

}  // namespace HWY_NAMESPACE
}  // namespace emmy
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace emmy {

HWY_EXPORT(SolveLined);

namespace {

// The node of a line, or -1 if it has not exactly one.
int NodeOf(const Structure::Line& line) {
  int node = -1;
  for (const WeightedVector& term : line.terms) {
    if (term.vector < 4) continue;
    if (node >= 0) return -1;
    node = term.vector;
  }
  return node;
}

}  // namespace

bool LinedBodyLanes::Fits(const Structure& structure) {
  const size_t lines = structure.lines.size();
  if (structure.bodies.size() != 1 || structure.is_grounded || lines == 0 ||
      lines > kMaxLines || structure.vectors.size() != 4 + lines ||
      !structure.constraints.empty() || !structure.forces.empty() ||
      !structure.torques.empty()) {
    return false;
  }
  const Structure::Body& body = structure.bodies[0];
  if (body.first != 0 || body.first_strain != 0) return false;
  for (size_t v = 1; v < 4; ++v) {
    const VectorCoordinate& here = structure.vectors[v];
    const VectorCoordinate& first = structure.vectors[0];
    const auto distance = static_cast<Eigen::Index>(3 * v);
    if (here.position_offset != first.position_offset + distance ||
        here.velocity_offset != first.velocity_offset + distance) {
      return false;
    }
  }
  std::vector<int> line_of(structure.vectors.size(), -1);
  for (size_t l = 0; l < lines; ++l) {
    const int node = NodeOf(structure.lines[l]);
    if (node < 0 || line_of[static_cast<size_t>(node)] >= 0) return false;
    if (structure.lines[l].strain != 6 + static_cast<int>(l)) return false;
    line_of[static_cast<size_t>(node)] = static_cast<int>(l);
  }
  for (const Structure::Mass& mass : structure.masses) {
    if (mass.row >= 4 && mass.column >= 4 && mass.row != mass.column) {
      return false;
    }
  }
  // Consecutive strains of the body.
  for (size_t s = 1; s < 6; ++s) {
    if (structure.strain_offsets[s] !=
        structure.strain_offsets[0] + static_cast<Eigen::Index>(s)) {
      return false;
    }
  }
  return true;
}

LinedBodyLanes::LinedBodyLanes(const Structure& structure, double time_step,
                               const NewtonOptions& options)
    : structure_(&structure) {
  auto c = std::make_shared<Constants>();
  c->time_step = time_step;
  c->options = options;
  c->num_lines = static_cast<int>(structure.lines.size());
  const AncfRigidBody& body = *structure.bodies[0].body->ancf();
  const auto lines = static_cast<size_t>(c->num_lines);
  // Lane of a node: that of its line.
  std::array<size_t, 8> lane{};
  for (size_t l = 0; l < lines; ++l) {
    const Structure::Line& line = structure.lines[l];
    c->elements.push_back(line.line->element);
    lane[static_cast<size_t>(NodeOf(line))] = l;
    for (const WeightedVector& term : line.terms) {
      const auto v = static_cast<size_t>(term.vector);
      if (v >= 4) {
        c->node_weight[l] = term.weight;
      } else {
        c->vector_weight[v][l] = term.weight;
        c->line_weight[l][v] = term.weight;
      }
    }
  }
  for (size_t l = 0; l < lines; ++l) {
    double sum = std::abs(c->node_weight[l]);
    for (const double weight : c->line_weight[l]) sum += std::abs(weight);
    c->node_share[l] = std::abs(c->node_weight[l]) * sum;
    for (size_t v = 0; v < 4; ++v) {
      c->line_share[l][v] = std::abs(c->line_weight[l][v]) * sum;
    }
  }
  // Of the body's vectors, then of the nodes by lane.
  const auto place = [&lane](int vector) {
    const auto v = static_cast<size_t>(vector);
    return v < 4 ? v : 4 + lane[v];
  };
  const Eigen::Index n = 4 + c->num_lines;
  MatrixXd mass = MatrixXd::Zero(n, n);
  for (const Structure::Mass& entry : structure.masses) {
    const auto row = static_cast<Eigen::Index>(place(entry.row));
    const auto column = static_cast<Eigen::Index>(place(entry.column));
    mass(row, column) += entry.mass;
    if (row != column) mass(column, row) += entry.mass;
  }
  const auto twice = [&mass](size_t i, size_t j) {
    return 2.0 *
           mass(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  };
  for (size_t v = 0; v < 4; ++v) {
    for (size_t u = 0; u < 4; ++u) c->body_mass[v][u] = twice(u, v);
    for (size_t l = 0; l < lines; ++l) {
      c->body_column[v][l] = twice(4 + l, v);
      c->node_column[l][v] = twice(v, 4 + l);
    }
  }
  for (size_t l = 0; l < lines; ++l) c->node_mass[l] = twice(4 + l, 4 + l);
  for (int v = 0; v < structure.num_vectors(); ++v) {
    for (size_t k = 0; k < 3; ++k) {
      const double impulse =
          time_step * structure.gravity_force(static_cast<Eigen::Index>(k), v);
      const size_t p = place(v);
      if (p < 4) {
        c->body_impulse[k][p] = impulse;
      } else {
        c->node_impulse[k][p - 4] = impulse;
      }
    }
  }
  // (LANE-4), unknown (k, v) at k n + v.
  MatrixXd tangent = MatrixXd::Zero(3 * n, 3 * n);
  for (Eigen::Index k = 0; k < 3; ++k) {
    tangent.block(k * n, k * n, n, n) = mass;
  }
  const double quarter = 0.25 * time_step * time_step;
  for (int i = 0; i < 3; ++i) {
    const double b = body.penalty_stiffness()(i);
    c->stretch[static_cast<size_t>(1 + i)] = b;
    tangent(i * n + 1 + i, i * n + 1 + i) += quarter * b;
    const auto [m1, m2] = AncfRigidBody::kShearPairs[static_cast<size_t>(i)];
    const double shear = body.penalty_stiffness()(3 + i);
    c->shear[static_cast<size_t>(1 + i)] = shear;
    for (const Eigen::Index row : {m2 * n + 1 + m1, m1 * n + 1 + m2}) {
      for (const Eigen::Index column : {m2 * n + 1 + m1, m1 * n + 1 + m2}) {
        tangent(row, column) += quarter * shear;
      }
    }
  }
  const MatrixXd inverse =
      tangent.ldlt().solve(MatrixXd::Identity(3 * n, 3 * n));
  const auto outputs_of = [n](const VectorXd& column) {
    Constants::Outputs outputs;
    for (Eigen::Index k = 0; k < 3; ++k) {
      for (Eigen::Index v = 0; v < n; ++v) {
        const auto row = static_cast<size_t>(k);
        const auto u = static_cast<size_t>(v);
        (u < 4 ? outputs.body[row][u] : outputs.node[row][u - 4]) =
            column(k * n + v);
      }
    }
    return outputs;
  };
  for (size_t k = 0; k < 3; ++k) {
    for (size_t v = 0; v < static_cast<size_t>(n); ++v) {
      c->inverse[k][v] = outputs_of(inverse.col(
          static_cast<Eigen::Index>(k * static_cast<size_t>(n) + v)));
    }
    for (size_t l = 0; l < lines; ++l) {
      VectorXd weights = VectorXd::Zero(3 * n);
      for (size_t v = 0; v < 4; ++v) {
        weights(static_cast<Eigen::Index>(k * static_cast<size_t>(n) + v)) =
            c->line_weight[l][v];
      }
      weights(static_cast<Eigen::Index>(k * static_cast<size_t>(n) + 4 + l)) =
          c->node_weight[l];
      c->line_response[l][k] = outputs_of(inverse * weights);
    }
  }
  constants_ = std::move(c);
}

BodyStepResult LinedBodyLanes::Solve(const State& state, Matrix3Xd* dw,
                                     Matrix3Xd* dq,
                                     VectorXd* strain_increment) const {
  const BodyStartNumbers body(*structure_->bodies.front().body, state);
  NodeState nodes;
  const auto lines = static_cast<size_t>(constants_->num_lines);
  std::array<Eigen::Index, kMaxLines> vector_of{};
  for (size_t l = 0; l < lines; ++l) {
    const int node = NodeOf(structure_->lines[l]);
    vector_of[l] = node;
    const VectorCoordinate& vector =
        structure_->vectors[static_cast<size_t>(node)];
    for (size_t k = 0; k < 3; ++k) {
      const Eigen::Index p =
          vector.position_offset + static_cast<Eigen::Index>(k);
      const Eigen::Index v =
          vector.velocity_offset + static_cast<Eigen::Index>(k);
      nodes.position[k][l] = state.position.value(p);
      nodes.position_low[k][l] = state.position.compensation(p);
      nodes.rate[k][l] = state.velocity.value(v);
      nodes.rate_low[k][l] = state.velocity.compensation(v);
      nodes.acceleration[k][l] = state.acceleration.next(v);
    }
    const Eigen::Index strain = structure_->strain_offsets[6 + l];
    nodes.strain[l] = state.strain.value(strain);
    nodes.strain_low[l] = state.strain.compensation(strain);
  }
  LinedIncrement increment;
  const BodyStepResult result =
      HWY_DYNAMIC_DISPATCH(SolveLined)(*constants_, body, nodes, &increment);
  if (result.termination != Termination::kConverged) return result;
  dw->leftCols<4>() =
      Eigen::Map<const Eigen::Matrix<double, 3, 4>>(increment.body_rate);
  dq->leftCols<4>() =
      Eigen::Map<const Eigen::Matrix<double, 3, 4>>(increment.body_position);
  strain_increment->head<6>() =
      Eigen::Map<const Vector6d>(increment.strain + 1);
  for (size_t l = 0; l < lines; ++l) {
    for (size_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      (*dw)(row, vector_of[l]) = increment.node_rate[k][l];
      (*dq)(row, vector_of[l]) = increment.node_position[k][l];
    }
    (*strain_increment)(static_cast<Eigen::Index>(6 + l)) = increment.line[l];
  }
  return result;
}

}  // namespace emmy
#endif  // HWY_ONCE
