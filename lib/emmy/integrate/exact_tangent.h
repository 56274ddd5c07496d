// The exact Jacobian of a structure's step, for steps that (EM-10) cannot do.
//
//   M + ¼ Δt² [Σ sₖ Aₖ + bₖ (Aₖ q̄)(Aₖ q₁)ᵀ]   (ANCF bodies, all stresses)
//     + ¼ Δt² φφᵀ ⊗ [t 1 + 2 t' d̄ d₁ᵀ]          (lines, compression too)
// bordered by the constraints. Not symmetric; factorised by LU with pivoting
// in every iteration. Slow, for large steps of stiff and light parts, where
// quadratic convergence is worth it. The change of a torque's force with the
// attitude is left out.                                            (EM-13)

#ifndef EMMY_INTEGRATE_EXACT_TANGENT_H_
#define EMMY_INTEGRATE_EXACT_TANGENT_H_

#include "emmy/base/types.h"
#include "emmy/integrate/structure.h"

namespace emmy {

// Where the Jacobian is taken.
struct ExactTangentPoint {
  const Matrix3Xd& mean;        // q̄
  const Matrix3Xd& end;         // q₁
  const VectorXd& mean_strain;  // ε̄ of the bodies, by local number.
  const Matrix3Xd& line_mean;   // d̄
  const Matrix3Xd& line_end;    // d₁
  const VectorXd& line_tension;
  const VectorXd& line_derivative;
};

// Solves [J, Gᵀ; G, 0] [δw; δ(Δt λ)] = [r; 2 G w̄]. False if J is singular.
bool SolveExactTangent(const Structure& structure, double time_step,
                       const ExactTangentPoint& point,
                       const Matrix3Xd& residual,
                       const Matrix3Xd& constraint_residual,
                       Matrix3Xd* correction, Matrix3Xd* multiplier_correction);

}  // namespace emmy

#endif  // EMMY_INTEGRATE_EXACT_TANGENT_H_
