// The trusses, cables and springs of a structure during one step.
//
// Kept as arrays, apart from the model: every iteration passes over all lines,
// and what it reads has to lie together.

#ifndef EMMY_INTEGRATE_STRUCTURE_LINES_H_
#define EMMY_INTEGRATE_STRUCTURE_LINES_H_

#include <vector>

#include "emmy/base/types.h"
#include "emmy/base/work_team.h"
#include "emmy/element/line_element.h"
#include "emmy/integrate/structure.h"
#include "emmy/integrate/vector_blocks.h"

namespace emmy {

class StructureLines {
 public:
  explicit StructureLines(const Structure& structure);

  // Takes q₀ and its compensation, which must stay where they are until the
  // next Load.
  void Load(const Matrix3Xd& q0, const Matrix3Xd& q0_compensation);

  // Adds Δt t φ d̄ (LINE-2) at Δq to `residual` and the size of each such term
  // to `magnitude`. Strains by local number.
  void AddImpulses(double time_step, const Matrix3Xd& dq,
                   const VectorXd& strain0,
                   const VectorXd& strain0_compensation, WorkTeam* team,
                   Matrix3Xd* residual, VectorXd* magnitude) const;

  // Writes Δy at Δq.
  void AdvanceStrains(const Matrix3Xd& dq, const VectorXd& strain0,
                      const VectorXd& strain0_compensation, WorkTeam* team,
                      VectorXd* strain_increment) const;

  // What a tangent at Δq needs.
  void Respond(const Matrix3Xd& dq, const VectorXd& strain0,
               const VectorXd& strain0_compensation);

  // Of the last Respond, one column or entry a line.
  const Matrix3Xd& mean() const { return mean_; }             // d̄ [m]
  const VectorXd& tension() const { return tension_; }        // t [N/m]
  const VectorXd& derivative() const { return derivative_; }  // t' [N/m³]
  Matrix3Xd End(const Matrix3Xd& dq) const;                   // d₁ [m]

 private:
  // A truss from one vector to another, as most lines of a net are: what every
  // iteration reads of it, and nothing more.
  struct Strut {
    int from = 0;
    int to = 0;
    int line = 0;
    LineElement::TrussLaw law;
  };
  // Lines one after the other: struts, or others.
  struct Section {
    bool of_struts = false;
    size_t first = 0;  // In the rest of struts_, or in others_.
    size_t end = 0;
  };
  struct Difference {
    Vector3d mean;    // d̄ [m]
    Vector3d change;  // Δd [m]
  };

  static bool IsStrut(const Structure::Line& line);
  static Strut MakeStrut(const Structure::Line& line, int index);
  void AddToSections(bool is_strut, size_t place);
  Difference At(size_t line, const Matrix3Xd& dq) const;
  Difference AcrossStrut(const Strut& strut, const Matrix3Xd& dq) const;
  Eigen::Index Strain(size_t line) const {
    return first_strain_ + static_cast<Eigen::Index>(line);
  }
  template <typename OfStrut, typename OfLine>
  void ForEach(WorkTeam* team, const OfStrut& of_strut,
               const OfLine& of_line) const;

  std::vector<LineElement> elements_;
  std::vector<WeightedVector> terms_;  // Of all lines, one after the other.
  std::vector<size_t> term_begin_;     // Of each line, and the end.
  Matrix3Xd ground_;                   // Constant part of d.
  BlockedItems<Strut> struts_;
  std::vector<size_t> others_;     // Lines that are no struts.
  std::vector<Section> sections_;  // What belongs to no block, in order.
  Eigen::Index first_strain_ = 0;  // Lines' strains follow the bodies'.
  const Matrix3Xd* q0_ = nullptr;
  const Matrix3Xd* q0_compensation_ = nullptr;
  Matrix3Xd mean_;
  VectorXd tension_, derivative_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_STRUCTURE_LINES_H_
