#include "emmy/integrate/structure_lines.h"

#include <cmath>

#include "emmy/base/check.h"

namespace emmy {

bool StructureLines::IsStrut(const Structure::Line& line) {
  return line.line->element.kind() == LineElement::Kind::kTruss &&
         line.line->difference.ground.isZero(0.0) && line.terms.size() == 2 &&
         std::abs(line.terms[0].weight) == 1.0 &&
         line.terms[1].weight == -line.terms[0].weight;
}

StructureLines::Strut StructureLines::MakeStrut(const Structure::Line& line,
                                                int index) {
  const bool forward = line.terms[1].weight > 0.0;
  return {line.terms[forward ? 0 : 1].vector,
          line.terms[forward ? 1 : 0].vector, index,
          line.line->element.truss_law()};
}

void StructureLines::AddToSections(bool is_strut, size_t place) {
  if (sections_.empty() || sections_.back().of_struts != is_strut) {
    sections_.push_back({.of_struts = is_strut, .first = place});
  }
  sections_.back().end = place + 1;
}

StructureLines::StructureLines(const Structure& structure)
    : struts_(structure.num_vectors()) {
  const auto lines = static_cast<Eigen::Index>(structure.lines.size());
  ground_.resize(3, lines);
  if (lines > 0) first_strain_ = structure.lines.front().strain;
  term_begin_.push_back(0);
  for (Eigen::Index i = 0; i < lines; ++i) {
    const auto index = static_cast<size_t>(i);
    const Structure::Line& line = structure.lines[index];
    EMMY_CHECK(line.strain == first_strain_ + i, line.strain);
    elements_.push_back(line.line->element);
    ground_.col(i) = line.line->difference.ground;
    terms_.insert(terms_.end(), line.terms.begin(), line.terms.end());
    term_begin_.push_back(terms_.size());
    if (!IsStrut(line)) {
      AddToSections(false, others_.size());
      others_.push_back(index);
      continue;
    }
    const Strut strut = MakeStrut(line, static_cast<int>(i));
    const size_t place = struts_.rest().size();
    if (!struts_.Add(strut, strut.from, strut.to)) AddToSections(true, place);
  }
  mean_.setZero(3, lines);
  tension_.setZero(lines);
  derivative_.setZero(lines);
}

void StructureLines::Load(const Matrix3Xd& q0,
                          const Matrix3Xd& q0_compensation) {
  q0_ = &q0;
  q0_compensation_ = &q0_compensation;
}

// From the values alone, then the rest: neighbours' difference is exact or
// nearly so, while a difference of means would carry the rounding of large
// positions.
StructureLines::Difference StructureLines::At(size_t line,
                                              const Matrix3Xd& dq) const {
  Vector3d start = ground_.col(static_cast<Eigen::Index>(line));
  Vector3d rest = Vector3d::Zero();
  Vector3d change = Vector3d::Zero();
  for (size_t i = term_begin_[line]; i < term_begin_[line + 1]; ++i) {
    const auto [vector, weight] = terms_[i];
    start += weight * q0_->col(vector);
    rest += weight * q0_compensation_->col(vector);
    change += weight * dq.col(vector);
  }
  return {start + (rest + 0.5 * change), change};
}

inline StructureLines::Difference StructureLines::AcrossStrut(
    const Strut& strut, const Matrix3Xd& dq) const {
  const auto across = [&strut](const Matrix3Xd& q) -> Vector3d {
    return q.col(strut.to) - q.col(strut.from);
  };
  const Vector3d change = across(dq);
  return {across(*q0_) + (across(*q0_compensation_) + 0.5 * change), change};
}

// Calls of_strut(strut) or of_line(line) for each: the struts of a block one
// after the other, blocks at the same time, then the rest in order.
template <typename OfStrut, typename OfLine>
void StructureLines::ForEach(WorkTeam* team, const OfStrut& of_strut,
                             const OfLine& of_line) const {
  struts_.ForBlocks(team, of_strut);
  for (const Section& section : sections_) {
    for (size_t i = section.first; i < section.end; ++i) {
      if (section.of_struts) {
        of_strut(struts_.rest()[i]);
      } else {
        of_line(others_[i]);
      }
    }
  }
}

void StructureLines::AddImpulses(double time_step, const Matrix3Xd& dq,
                                 const VectorXd& strain0,
                                 const VectorXd& strain0_compensation,
                                 WorkTeam* team, Matrix3Xd* residual,
                                 VectorXd* magnitude) const {
  ForEach(
      team,
      [&](const Strut& strut) {
        const auto [d, change] = AcrossStrut(strut, dq);
        const Eigen::Index strain = first_strain_ + strut.line;
        const double tension_factor = strut.law.TensionFactor(
            strain0(strain), strain0_compensation(strain),
            strut.law.Increment(d.dot(change)));
        const Vector3d impulse = (time_step * tension_factor) * d;
        const double size = impulse.cwiseAbs().maxCoeff();
        residual->col(strut.from) -= impulse;
        residual->col(strut.to) += impulse;
        (*magnitude)(strut.from) += size;
        (*magnitude)(strut.to) += size;
      },
      [&](size_t line) {
        const auto [d, change] = At(line, dq);
        const Eigen::Index strain = Strain(line);
        const LineElement::Response response = elements_[line].Respond(
            strain0(strain), strain0_compensation(strain), d.dot(change));
        const Vector3d impulse = (time_step * response.tension_factor) * d;
        const double size = impulse.cwiseAbs().maxCoeff();
        for (size_t i = term_begin_[line]; i < term_begin_[line + 1]; ++i) {
          const auto [vector, weight] = terms_[i];
          residual->col(vector) += weight * impulse;
          (*magnitude)(vector) += std::abs(weight) * size;
        }
      });
}

void StructureLines::AdvanceStrains(const Matrix3Xd& dq,
                                    const VectorXd& strain0,
                                    const VectorXd& strain0_compensation,
                                    WorkTeam* team,
                                    VectorXd* strain_increment) const {
  ForEach(
      team,
      [&](const Strut& strut) {
        const auto [d, change] = AcrossStrut(strut, dq);
        (*strain_increment)(first_strain_ + strut.line) =
            strut.law.Increment(d.dot(change));
      },
      [&](size_t line) {
        const auto [d, change] = At(line, dq);
        const Eigen::Index strain = Strain(line);
        (*strain_increment)(strain) =
            elements_[line]
                .Respond(strain0(strain), strain0_compensation(strain),
                         d.dot(change))
                .increment;
      });
}

void StructureLines::Respond(const Matrix3Xd& dq, const VectorXd& strain0,
                             const VectorXd& strain0_compensation) {
  for (size_t i = 0; i < elements_.size(); ++i) {
    const auto [d, change] = At(i, dq);
    const auto column = static_cast<Eigen::Index>(i);
    const Eigen::Index strain = first_strain_ + column;
    const LineElement::Response response = elements_[i].Respond(
        strain0(strain), strain0_compensation(strain), d.dot(change));
    mean_.col(column) = d;
    tension_(column) = response.tension_factor;
    derivative_(column) = response.derivative;
  }
}

Matrix3Xd StructureLines::End(const Matrix3Xd& dq) const {
  Matrix3Xd end = mean_;
  for (size_t line = 0; line < elements_.size(); ++line) {
    for (size_t i = term_begin_[line]; i < term_begin_[line + 1]; ++i) {
      const auto [vector, weight] = terms_[i];
      end.col(static_cast<Eigen::Index>(line)) +=
          (0.5 * weight) * dq.col(vector);
    }
  }
  return end;
}

}  // namespace emmy
