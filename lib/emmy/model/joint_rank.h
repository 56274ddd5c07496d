// Which directions the joints of conventional bodies hold, once, at build time.

#ifndef EMMY_MODEL_JOINT_RANK_H_
#define EMMY_MODEL_JOINT_RANK_H_

#include <vector>

#include "emmy/model/model.h"

namespace emmy {

// Fills in `held` and `num_held` of each joint, and leaves out joints that hold
// nothing. The velocity of a joint's gap,
//   v₁ + ω₁ × R₁ξ₁ − v₂ − ω₂ × R₂ξ₂                                 (CONJ-2)
// along a direction that is a combination of others before it, to 1e-7 of its
// size, is held by them: the second point of a hinge along its axis, the last
// ones of a linkage of hinges out of its plane. `rotations` are R of the
// bodies at the start; of those without joints they do not matter.
std::vector<ModelJoint> IndependentJoints(
    const std::vector<ModelBody>& bodies,
    const std::vector<Matrix3d>& rotations, std::vector<ModelJoint> joints);

}  // namespace emmy

#endif  // EMMY_MODEL_JOINT_RANK_H_
