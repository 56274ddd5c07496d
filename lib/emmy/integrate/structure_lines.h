// The trusses, cables and springs of a structure during one step.
//
// Kept as arrays, apart from the model: every iteration passes over all lines,
// and what it reads has to lie together.

#ifndef EMMY_INTEGRATE_STRUCTURE_LINES_H_
#define EMMY_INTEGRATE_STRUCTURE_LINES_H_

#include <vector>

#include "emmy/base/types.h"
#include "emmy/element/line_element.h"
#include "emmy/integrate/structure.h"

namespace emmy {

class StructureLines {
 public:
  explicit StructureLines(const Structure& structure);

  // d₀ of the step, from q₀ and its compensation.
  void Load(const Matrix3Xd& q0, const Matrix3Xd& q0_compensation);

  // The response to Δq: adds Δt t φ d̄ (LINE-2) to `residual` and the size of
  // each such term to `magnitude`, and writes Δy. Strains by local number.
  void Evaluate(double time_step, const Matrix3Xd& dq, const VectorXd& strain0,
                const VectorXd& strain0_compensation,
                VectorXd* strain_increment, Matrix3Xd* residual,
                VectorXd* magnitude);

  // Of the last Evaluate, one column or entry a line.
  const Matrix3Xd& mean() const { return mean_; }             // d̄ [m]
  const VectorXd& tension() const { return tension_; }        // t [N/m]
  const VectorXd& derivative() const { return derivative_; }  // t' [N/m³]
  Matrix3Xd End(const Matrix3Xd& dq) const;                   // d₁ [m]

 private:
  std::vector<LineElement> elements_;
  std::vector<WeightedVector> terms_;  // Of all lines, one after the other.
  std::vector<int> term_end_;          // One past the last of each line.
  Matrix3Xd ground_;                   // Constant part of d.
  Eigen::Index first_strain_ = 0;      // Lines' strains follow the bodies'.
  Matrix3Xd start_;                    // d₀ from the values alone, [m].
  Matrix3Xd rest_;                     // What the compensations add.
  Matrix3Xd mean_;
  VectorXd tension_, derivative_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_STRUCTURE_LINES_H_
