#include "verification/baselines/elastic_system.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "absl/status/status.h"
#include "emmy/base/check.h"

namespace emmy::verification {
namespace {

double StrainOf(const SystemStrain& strain, const VectorXd& q) {
  return 0.5 * q.dot(strain.quadratic * q) + strain.linear.dot(q) +
         strain.constant;
}

VectorXd GradientOf(const SystemStrain& strain, const VectorXd& q) {
  return strain.quadratic * q + strain.linear;
}

// Adds value qₐ·q_b, of two vector coordinates, to ½ qᵀA q.
void AddProduct(int a, int b, double value, MatrixXd* quadratic) {
  for (int k = 0; k < 3; ++k) {
    (*quadratic)(3 * a + k, 3 * b + k) += value;
    (*quadratic)(3 * b + k, 3 * a + k) += value;
  }
}

SystemStrain NoStrain(Eigen::Index size) {
  return {.quadratic = MatrixXd::Zero(size, size),
          .linear = VectorXd::Zero(size)};
}

void AddBody(const ModelBody& body, ElasticSystem* system) {
  const Vector6d& stiffness = body.ancf()->penalty_stiffness();
  const int first = body.first_vector + 1;
  for (int i = 0; i < 3; ++i) {
    SystemStrain normal = NoStrain(system->size());
    AddProduct(first + i, first + i, 0.5, &normal.quadratic);
    normal.constant = -0.5;
    normal.stiffness = stiffness(i);
    system->strains.push_back(normal);
  }
  for (int i = 0; i < 3; ++i) {
    SystemStrain shear = NoStrain(system->size());
    AddProduct(first + i, first + (i + 1) % 3, 1.0, &shear.quadratic);
    shear.stiffness = stiffness(3 + i);
    system->strains.push_back(shear);
  }
}

void AddTruss(const ModelLine& line, ElasticSystem* system) {
  const double length = line.element.natural_length();
  SystemStrain strain = NoStrain(system->size());
  for (const WeightedVector& a : line.difference.terms) {
    for (const WeightedVector& b : line.difference.terms) {
      AddProduct(a.vector, b.vector,
                 0.5 * a.weight * b.weight / (length * length),
                 &strain.quadratic);
    }
  }
  strain.constant = -0.5;
  strain.stiffness = line.element.stiffness() * length;
  system->strains.push_back(strain);
}

bool IsCovered(const Model& model) {
  for (const ModelBody& body : model.bodies()) {
    if (body.ancf() == nullptr) return false;
  }
  for (const ModelLine& line : model.lines()) {
    if (line.element.kind() != LineElement::Kind::kTruss ||
        line.ends[0].is_ground() || line.ends[1].is_ground()) {
      return false;
    }
  }
  return model.constraints().empty() && model.forces().empty() &&
         model.torques().empty() && model.gravity().isZero(0.0) &&
         model.ground_mass().empty();
}

}  // namespace

VectorXd Strains(const ElasticSystem& system, const VectorXd& q) {
  VectorXd values(static_cast<Eigen::Index>(system.strains.size()));
  Eigen::Index k = 0;
  for (const SystemStrain& strain : system.strains) {
    values(k++) = StrainOf(strain, q);
  }
  return values;
}

double PotentialEnergy(const ElasticSystem& system, const VectorXd& q) {
  double energy = 0.0;
  for (const SystemStrain& strain : system.strains) {
    const double value = StrainOf(strain, q);
    energy += 0.5 * strain.stiffness * value * value;
  }
  return energy;
}

VectorXd InternalForce(const ElasticSystem& system, const VectorXd& q) {
  VectorXd force = VectorXd::Zero(system.size());
  for (const SystemStrain& strain : system.strains) {
    force += strain.stiffness * StrainOf(strain, q) * GradientOf(strain, q);
  }
  return force;
}

MatrixXd Stiffness(const ElasticSystem& system, const VectorXd& q) {
  MatrixXd stiffness = MatrixXd::Zero(system.size(), system.size());
  for (const SystemStrain& strain : system.strains) {
    const VectorXd gradient = GradientOf(strain, q);
    stiffness.noalias() += strain.stiffness * gradient * gradient.transpose();
    stiffness += strain.stiffness * StrainOf(strain, q) * strain.quadratic;
  }
  return stiffness;
}

double HighestFrequency(const ElasticSystem& system, const VectorXd& q) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(
      Stiffness(system, q), system.mass, Eigen::EigenvaluesOnly);
  EMMY_CHECK(solver.info() == Eigen::Success, "mass not positive definite?");
  return std::sqrt(solver.eigenvalues().maxCoeff());
}

absl::StatusOr<ElasticSystem> SystemOfModel(const Model& model) {
  if (!IsCovered(model)) {
    return absl::UnimplementedError(
        "the baselines know ANCF bodies, nodes and trusses alone, free");
  }
  ElasticSystem system;
  const auto size = static_cast<Eigen::Index>(3 * model.vectors().size());
  system.mass = MatrixXd::Zero(size, size);
  for (size_t v = 0; v < model.vectors().size(); ++v) {
    for (const MassEntry& entry : model.mass()[v]) {
      for (int k = 0; k < 3; ++k) {
        system.mass(3 * static_cast<Eigen::Index>(v) + k,
                    3 * entry.column + k) += entry.mass;
      }
    }
  }
  for (const ModelBody& body : model.bodies()) AddBody(body, &system);
  for (const ModelLine& line : model.lines()) AddTruss(line, &system);
  return system;
}

}  // namespace emmy::verification
