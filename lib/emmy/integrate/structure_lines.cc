#include "emmy/integrate/structure_lines.h"

#include <algorithm>
#include <cmath>

#include "emmy/base/check.h"

namespace emmy {

StructureLines::StructureLines(const Structure& structure) {
  const auto lines = static_cast<Eigen::Index>(structure.lines.size());
  ground_.resize(3, lines);
  if (lines > 0) first_strain_ = structure.lines.front().strain;
  for (Eigen::Index i = 0; i < lines; ++i) {
    const Structure::Line& line = structure.lines[static_cast<size_t>(i)];
    EMMY_CHECK(line.strain == first_strain_ + i, line.strain);
    elements_.push_back(line.line->element);
    ground_.col(i) = line.line->difference.ground;
    terms_.insert(terms_.end(), line.terms.begin(), line.terms.end());
    term_end_.push_back(static_cast<int>(terms_.size()));
  }
  for (Matrix3Xd* m : {&start_, &rest_, &mean_}) m->setZero(3, lines);
  tension_.setZero(lines);
  derivative_.setZero(lines);
}

void StructureLines::Load(const Matrix3Xd& q0,
                          const Matrix3Xd& q0_compensation) {
  size_t term = 0;
  for (size_t i = 0; i < elements_.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    // From the values alone: neighbours' difference is exact or nearly so,
    // while a difference of means would carry the rounding of large positions.
    Vector3d start = ground_.col(column);
    Vector3d rest = Vector3d::Zero();
    for (; term < static_cast<size_t>(term_end_[i]); ++term) {
      const auto [vector, weight] = terms_[term];
      start += weight * q0.col(vector);
      rest += weight * q0_compensation.col(vector);
    }
    start_.col(column) = start;
    rest_.col(column) = rest;
  }
}

void StructureLines::Evaluate(double time_step, const Matrix3Xd& dq,
                              const VectorXd& strain0,
                              const VectorXd& strain0_compensation,
                              VectorXd* strain_increment, Matrix3Xd* residual,
                              VectorXd* magnitude) {
  const WeightedVector* begin = terms_.data();
  for (size_t i = 0; i < elements_.size(); ++i) {
    const WeightedVector* const end = terms_.data() + term_end_[i];
    const auto column = static_cast<Eigen::Index>(i);
    Vector3d change = Vector3d::Zero();  // Δd
    for (const WeightedVector* term = begin; term != end; ++term) {
      change += term->weight * dq.col(term->vector);
    }
    const Vector3d d = start_.col(column) + (rest_.col(column) + 0.5 * change);
    const Eigen::Index strain = first_strain_ + column;
    const LineElement::Response response = elements_[i].Respond(
        strain0(strain), strain0_compensation(strain), d.dot(change));
    (*strain_increment)(strain) = response.increment;
    mean_.col(column) = d;
    tension_(column) = response.tension_factor;
    derivative_(column) = response.derivative;
    const Vector3d impulse = (time_step * response.tension_factor) * d;
    const double size = impulse.cwiseAbs().maxCoeff();
    for (const WeightedVector* term = begin; term != end; ++term) {
      residual->col(term->vector) += term->weight * impulse;
      (*magnitude)(term->vector) += std::abs(term->weight) * size;
    }
    begin = end;
  }
}

Matrix3Xd StructureLines::End(const Matrix3Xd& dq) const {
  Matrix3Xd end = mean_;
  size_t term = 0;
  for (size_t i = 0; i < elements_.size(); ++i) {
    for (; term < static_cast<size_t>(term_end_[i]); ++term) {
      const auto [vector, weight] = terms_[term];
      end.col(static_cast<Eigen::Index>(i)) += (0.5 * weight) * dq.col(vector);
    }
  }
  return end;
}

}  // namespace emmy
