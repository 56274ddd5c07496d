// How a batch keeps its bodies: sixteen to a block, one array for each number.
//
// A lane is a body. Eight doubles are 64 bytes, the widest vector there is: a
// block is two of them, or more narrower ones. All arrays are indexed
// [entry][lane]; gradient vectors and rates have the entries of e₁, then e₂,
// then e₃.

#ifndef EMMY_INTEGRATE_BATCH_BLOCKS_H_
#define EMMY_INTEGRATE_BATCH_BLOCKS_H_

#include <cstddef>

namespace emmy {

inline constexpr int kBatchLanes = 16;

using Lanes = double[kBatchLanes];

// What all bodies of a batch have in common.
struct BatchStep {
  double time_step = 0.0;                          // Δt
  double inverse_time_step = 0.0;                  // 1/Δt
  double velocity_increment[3] = {0.0, 0.0, 0.0};  // Δt g
  bool has_gravity = false;
};

// A compensated vector: (SUM-2).
template <size_t kEntries>
struct CompensatedLanes {
  alignas(64) Lanes value[kEntries];
  Lanes compensation[kEntries];
};

// Accelerations of the last steps: (EXTRA-1), with ∇⁰ up to the highest order
// that is used; the difference after it only ranks orders.
template <size_t kEntries, size_t kDifferences>
struct ExtrapolationLanes {
  alignas(64) Lanes next[kEntries];
  Lanes difference[kDifferences][kEntries];
};

// What both kinds of body have.
struct CentreLanes {
  CompensatedLanes<3> position;
  CompensatedLanes<3> velocity;
  // 1 for a body that is stepped, 0 for one that has failed and for padding.
  alignas(64) Lanes alive;
  Lanes iterations;  // Done before this call.
  Lanes motion[3];   // Without gravity: Δt v̄ and its rounding error.
  Lanes motion_error[3];
  // Whether the first round of corrections ended the last step in all lanes
  // that are stepped together, by the first of these lanes.
  bool one_round[kBatchLanes];
};

// ANCF bodies in principal axes.
struct AncfBlock {
  CentreLanes centre;
  CompensatedLanes<9> gradients;
  CompensatedLanes<9> rates;
  CompensatedLanes<6> strain;
  // What higher orders predict better is lost in the first correction.
  ExtrapolationLanes<9, 2> acceleration;

  // Constants of bodies and time step, c as in (EM-6).
  alignas(64) Lanes moment[3];  // Mⁱⁱ
  Lanes impulse[6];             // Δt bₖ
  Lanes normal_inverse[3];      // 1/(Mⁱⁱ + cᵢ)
  Lanes shear_first[3];         // Mⁿ/determinant
  Lanes shear_second[3];        // Mᵐ/determinant
  Lanes shear_coupling[3];      // c/determinant
  // The same for a residual c ∘ q.
  Lanes normal_share[3];  // cᵢ/(Mⁱⁱ + cᵢ)
  Lanes first_share[3];   // c Mⁿ/determinant
  Lanes second_share[3];  // c Mᵐ/determinant
  // And for an antisymmetric one.
  Lanes first_moment[3];   // (½ Mⁿ + c)/determinant
  Lanes second_moment[3];  // (½ Mᵐ + c)/determinant
  // For bounds of what is left of a correction.
  Lanes share_square;         // Square of the norm of q ↦ the shares.
  Lanes stiffening_square;    // Of ¼ Δt² max b/min M.
  Lanes second_order_square;  // Of Δt (1 + max c/min M).
};

// Conventional bodies in principal axes.
struct ConventionalBlock {
  CentreLanes centre;
  CompensatedLanes<4> quaternion;
  CompensatedLanes<3> angular_velocity;
  ExtrapolationLanes<3, 4> acceleration;

  // aᵢ of (BATCH-4) as a pair; 2 max aᵢ².
  alignas(64) Lanes coupling[3];
  Lanes coupling_low[3];
  Lanes coupling_square;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_BATCH_BLOCKS_H_
