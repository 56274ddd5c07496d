// Why an iteration failed, in words.

#ifndef EMMY_INTEGRATE_FAILURE_TEXT_H_
#define EMMY_INTEGRATE_FAILURE_TEXT_H_

#include "emmy/numerics/newton.h"

namespace emmy {

inline const char* FailureText(Termination termination) {
  switch (termination) {
    case Termination::kSingularTangent:
      return "the tangent is singular";
    case Termination::kNonFinite:
      return "a value is not finite";
    case Termination::kConverged:
    case Termination::kMaxIterations:
    case Termination::kUnsound:  // Not of an iteration.
      break;
  }
  return "the iteration does not converge";
}

}  // namespace emmy

#endif  // EMMY_INTEGRATE_FAILURE_TEXT_H_
