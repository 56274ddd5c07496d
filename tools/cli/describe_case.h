// What a case is, in words and numbers, for people who want to be sure.

#ifndef EMMY_TOOLS_CLI_DESCRIBE_CASE_H_
#define EMMY_TOOLS_CLI_DESCRIBE_CASE_H_

#include <string>

#include "emmy/element/ancf_rigid_body.h"
#include "emmy/io/case_file.h"

namespace emmy {

std::string DescribeCase(const LoadedCase& loaded);

// Highest natural angular frequency of the strains of a free body, linearised
// at zero strain [rad/s]: the square root of the largest eigenvalue of
//   Sₖₗ = √(bₖ bₗ) Σ_c Gₖ M⁻¹ Gₗᵀ,
// with Gₖ the derivative of strain k by the gradient vectors and Mⁱʲ the
// second moments; √(b / M¹¹) for a normal strain alone.
double PenaltyFrequency(const AncfRigidBody& body);

}  // namespace emmy

#endif  // EMMY_TOOLS_CLI_DESCRIBE_CASE_H_
