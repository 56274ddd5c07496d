#include "emmy/diagnostics/check_state.h"

#include <Eigen/LU>

#include "absl/strings/str_format.h"
#include "emmy/base/types.h"

namespace emmy {

absl::Status CheckState(const Model& model, const State& state,
                        const Invariants& invariants) {
  if (!IsFinite(invariants)) {
    return absl::OutOfRangeError("energy or momentum is not finite");
  }
  for (const ModelBody& body : model.bodies()) {
    if (body.ancf() == nullptr) continue;
    const Matrix3d gradients = Eigen::Map<const Matrix3d>(
        state.position.value.data() + body.position_offset + 3);
    const double determinant = gradients.determinant();
    if (determinant > 0.0) continue;
    return absl::OutOfRangeError(absl::StrFormat(
        "body \"%s\" has turned inside out: the determinant of its gradient "
        "vectors must be > 0, got %.3g; a larger penalty or a smaller time "
        "step may help",
        body.name, determinant));
  }
  return absl::OkStatus();
}

}  // namespace emmy
