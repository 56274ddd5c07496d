#include "emmy/integrate/structure.h"

#include <algorithm>

#include "emmy/base/disjoint_sets.h"

namespace emmy {
namespace {

// Masses of a body by itself: one for x̄ and the second moments.
bool IsBodyMass(const ModelBody& body, int row, const MassEntry& entry) {
  const int a = row - body.first_vector;
  const int b = entry.column - body.first_vector;
  if (a < 0 || a > 3 || b < 0 || b > 3) return false;
  if (a == 0 || b == 0) return a == b && entry.mass == body.ancf()->mass();
  return entry.mass == body.ancf()->second_moment()(a - 1, b - 1);
}

// Vectors of conventional structures are handled elsewhere.
std::vector<bool> TouchesConventional(const Model& model,
                                      const DisjointSets& components) {
  std::vector<bool> touches(model.vectors().size(), false);
  for (const ModelLine& line : model.lines()) {
    if (!line.has_conventional_end()) continue;
    for (const Point& end : line.ends) {
      for (const WeightedVector& term : end.terms) {
        touches[components.Find(static_cast<size_t>(term.vector))] = true;
      }
    }
  }
  return touches;
}

class Splitter {
 public:
  explicit Splitter(const Model& model)
      : model_(model), components_(model.vectors().size()) {}

  std::vector<Structure> Split() {
    Connect();
    Number();
    Fill();
    return std::move(structures_);
  }

 private:
  void Connect() {
    for (const ModelBody& body : model_.bodies()) {
      if (body.ancf() == nullptr) continue;
      for (int a = 1; a < 4; ++a) {
        Join(body.first_vector, body.first_vector + a);
      }
    }
    for (size_t v = 0; v < model_.mass().size(); ++v) {
      for (const MassEntry& entry : model_.mass()[v]) {
        Join(static_cast<int>(v), entry.column);
      }
    }
    for (const ModelLine& line : model_.lines()) {
      std::vector<WeightedVector> both = line.ends[0].terms;
      both.insert(both.end(), line.ends[1].terms.begin(),
                  line.ends[1].terms.end());
      JoinTerms(both);
    }
    for (const ModelConstraint& constraint : model_.constraints()) {
      JoinTerms(constraint.terms);
    }
  }

  // The lower number stands for both, which keeps the model's order.
  void Join(int a, int b) {
    const size_t first = components_.Find(static_cast<size_t>(a));
    const size_t second = components_.Find(static_cast<size_t>(b));
    components_.Join(std::min(first, second), std::max(first, second));
  }
  void JoinTerms(const std::vector<WeightedVector>& terms) {
    for (const WeightedVector& term : terms) {
      Join(terms.front().vector, term.vector);
    }
  }

  void Number() {
    const std::vector<bool> conventional =
        TouchesConventional(model_, components_);
    local_.assign(model_.vectors().size(), -1);
    structure_of_root_.assign(model_.vectors().size(), -1);
    for (size_t v = 0; v < model_.vectors().size(); ++v) {
      const size_t root = components_.Find(v);
      if (conventional[root]) continue;
      if (structure_of_root_[root] < 0) {
        structure_of_root_[root] = static_cast<int>(structures_.size());
        structures_.emplace_back();
      }
      Structure& structure = Of(v);
      local_[v] = structure.num_vectors();
      structure.vectors.push_back(model_.vectors()[v]);
    }
  }

  // The structure of a global vector, which must have one.
  Structure& Of(size_t vector) {
    return structures_[static_cast<size_t>(
        structure_of_root_[components_.Find(vector)])];
  }
  bool IsIncluded(const std::vector<WeightedVector>& terms) const {
    return !terms.empty() &&
           local_[static_cast<size_t>(terms.front().vector)] >= 0;
  }
  Structure& Of(const std::vector<WeightedVector>& terms) {
    return Of(static_cast<size_t>(terms.front().vector));
  }
  std::vector<WeightedVector> Local(
      const std::vector<WeightedVector>& terms) const {
    std::vector<WeightedVector> local = terms;
    for (WeightedVector& term : local) {
      term.vector = local_[static_cast<size_t>(term.vector)];
    }
    return local;
  }

  void Fill() {
    for (const ModelBody& body : model_.bodies()) {
      if (body.ancf() == nullptr) continue;
      const auto first = static_cast<size_t>(body.first_vector);
      if (local_[first] < 0) continue;
      Structure& structure = Of(first);
      structure.bodies.push_back(
          {&body, local_[first],
           static_cast<int>(structure.strain_offsets.size())});
      for (int k = 0; k < AncfRigidBody::kNumStrains; ++k) {
        structure.strain_offsets.push_back(body.strain_offset + k);
      }
      for (int a = 0; a < 4; ++a) {
        const int row = body.first_vector + a;
        for (const MassEntry& entry : model_.mass()[static_cast<size_t>(row)]) {
          if (!IsBodyMass(body, row, entry)) structure.has_added_mass = true;
        }
      }
    }
    for (const ModelLine& line : model_.lines()) {
      if (line.has_conventional_end()) continue;
      if (!IsIncluded(line.difference.terms)) continue;
      Structure& structure = Of(line.difference.terms);
      structure.lines.push_back(
          {&line, Local(line.difference.terms),
           static_cast<int>(structure.strain_offsets.size())});
      structure.strain_offsets.push_back(line.strain_offset);
      if (line.ends[0].is_ground() || line.ends[1].is_ground()) {
        structure.is_grounded = true;
      }
    }
    for (size_t i = 0; i < model_.constraints().size(); ++i) {
      const ModelConstraint& constraint = model_.constraints()[i];
      Structure& structure = Of(constraint.terms);
      structure.constraints.push_back({i, Local(constraint.terms)});
      if (constraint.to_ground) structure.is_grounded = true;
    }
    for (const ModelForce& force : model_.forces()) {
      if (!IsIncluded(force.point.terms)) continue;
      Of(force.point.terms)
          .forces.push_back({Local(force.point.terms), force.force});
    }
    for (const ModelTorque& torque : model_.torques()) {
      const ModelBody& body = model_.bodies()[torque.body];
      if (body.ancf() == nullptr) continue;
      const auto first = static_cast<size_t>(body.first_vector);
      if (local_[first] < 0) continue;
      Of(first).torques.push_back({local_[first], torque.torque});
    }
    for (size_t v = 0; v < model_.mass().size(); ++v) {
      if (local_[v] < 0) continue;
      for (const MassEntry& entry : model_.mass()[v]) {
        const int column = local_[static_cast<size_t>(entry.column)];
        if (column <= local_[v]) {
          Of(v).masses.push_back({local_[v], column, entry.mass});
        }
      }
    }
    for (Structure& structure : structures_) {
      structure.translates.assign(structure.vectors.size(), true);
      for (const Structure::Body& body : structure.bodies) {
        for (int a = 1; a < 4; ++a) {
          structure.translates[static_cast<size_t>(body.first + a)] = false;
        }
      }
      structure.gravity = model_.gravity();
      structure.gravity_force.resize(3, structure.num_vectors());
      for (int v = 0; v < structure.num_vectors(); ++v) {
        structure.gravity_force.col(v) =
            structure.vectors[static_cast<size_t>(v)].first_moment *
            model_.gravity();
      }
    }
  }

  const Model& model_;
  DisjointSets components_;  // Of vector coordinates.
  std::vector<int> local_;
  std::vector<int> structure_of_root_;
  std::vector<Structure> structures_;
};

}  // namespace

std::vector<Structure> SplitIntoStructures(const Model& model) {
  return Splitter(model).Split();
}

}  // namespace emmy
