// The semi-discrete equations that every integrator here solves:
//
//   M q̈ + f(q) = 0,  f = ∂U/∂q,  U = ½ Σ b ε²
//   ε = ½ qᵀA q + g·q + c                                          (BASE-1)
//   f = Σ b ε a,  a = A q + g;  K = ∂f/∂q = Σ b (a aᵀ + ε A)       (BASE-2)
//
// with dense matrices, as one reads it: meant for a dozen coordinates. The
// strains are those of docs/theory.md, section 4, but nothing of the library's
// elements is used, so that this is a second way to the same forces.

#ifndef EMMY_VERIFICATION_BASELINES_ELASTIC_SYSTEM_H_
#define EMMY_VERIFICATION_BASELINES_ELASTIC_SYSTEM_H_

#include <vector>

#include "absl/status/statusor.h"
#include "emmy/base/types.h"
#include "emmy/model/model.h"

namespace emmy::verification {

// One strain of (BASE-1) [-] and its stiffness b [J].
struct SystemStrain {
  MatrixXd quadratic;  // A, symmetric.
  VectorXd linear;     // g
  double constant = 0.0;
  double stiffness = 0.0;
};

struct ElasticSystem {
  MatrixXd mass;  // M, symmetric, positive definite.
  std::vector<SystemStrain> strains;

  Eigen::Index size() const { return mass.rows(); }
};

VectorXd Strains(const ElasticSystem& system, const VectorXd& q);
double PotentialEnergy(const ElasticSystem& system, const VectorXd& q);
VectorXd InternalForce(const ElasticSystem& system, const VectorXd& q);
MatrixXd Stiffness(const ElasticSystem& system, const VectorXd& q);

// The largest Ω of K x = Ω² M x at q [rad/s]: the fastest vibration of linear
// theory.                                                            (BASE-7)
double HighestFrequency(const ElasticSystem& system, const VectorXd& q);

// The equations of a model, q being its vector coordinates one after another.
// Fails with kUnimplemented unless the model consists of ANCF bodies, nodes
// and trusses, without shared points, loads, gravity or ground. The strains
// are in the order of the model's.
absl::StatusOr<ElasticSystem> SystemOfModel(const Model& model);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_BASELINES_ELASTIC_SYSTEM_H_
