#include "tools/cli/describe_case.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/diagnostics/body_motion.h"
#include "emmy/diagnostics/invariant_monitor.h"
#include "emmy/model/validation.h"

namespace emmy {
namespace {

constexpr size_t kMaxListed = 20;  // Of each kind.
constexpr double kPi = 3.14159265358979323846;

std::string DescribeVector(const Vector3d& v) {
  return absl::StrFormat("(%.6g, %.6g, %.6g)", v.x(), v.y(), v.z());
}

std::string DescribePoint(const PointDescription& point) {
  if (const auto* body = std::get_if<BodyPoint>(&point)) {
    return absl::StrFormat("%s%s", body->body, DescribeVector(body->point));
  }
  if (const auto* node = std::get_if<NodePoint>(&point)) return node->node;
  return "ground" + DescribeVector(std::get<GroundPoint>(point).position);
}

std::string DescribePenalty(const RigidBodyDescription& body) {
  if (const double* one = std::get_if<double>(&body.penalty)) {
    return absl::StrFormat("%.6g", *one);
  }
  std::string text;
  for (const double value : std::get<std::array<double, 6>>(body.penalty)) {
    text += absl::StrFormat("%s%.6g", text.empty() ? "" : ", ", value);
  }
  return text;
}

std::string DescribeBody(const LoadedCase& loaded, size_t i) {
  const ModelBody& body = loaded.model.bodies()[i];
  const RigidBodyDescription& given = loaded.description.model.rigid_bodies[i];
  const RigidBodyInertia& inertia = body.inertia();
  const double time_step = loaded.description.integrator.time_step;
  const Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia.tensor).eigenvalues();
  std::string text = absl::StrFormat(
      "  %s: %s, mass %.6g kg, principal inertia %s kg m^2\n", body.name,
      body.ancf() != nullptr ? "ancf" : "conventional", inertia.mass,
      DescribeVector(principal));
  const double speed =
      ObserveBody(loaded.model, loaded.state, i).omega_locked.norm();
  text += absl::StrFormat("    turns by %.3g rad a step (%.6g rad/s)\n",
                          speed * time_step, speed);
  if (body.ancf() != nullptr) {
    const double frequency = PenaltyFrequency(*body.ancf());
    text += absl::StrFormat(
        "    penalty %s Pa: fastest strain %.3g rad/s, %.3g periods a step; "
        "starts %s\n",
        DescribePenalty(given), frequency, frequency * time_step / (2.0 * kPi),
        given.start == Start::kRelaxed ? "relaxed" : "undeformed");
  }
  return text;
}

std::string DescribeNode(const NodeDescription& node) {
  return absl::StrFormat("  %s: mass %.6g kg at %s m%s\n", node.name, node.mass,
                         DescribeVector(node.position),
                         node.fixed ? ", fixed" : "");
}

std::string DescribeEnds(const std::array<PointDescription, 2>& ends) {
  return DescribePoint(ends[0]) + " to " + DescribePoint(ends[1]);
}

std::string DescribeTruss(const TrussDescription& truss) {
  return absl::StrFormat(
      "  %s: %s, EA %.6g N, %.6g kg/m%s\n", truss.name,
      DescribeEnds(truss.ends), truss.young_modulus * truss.area,
      truss.density * truss.area, truss.tension_only ? ", tension only" : "");
}

std::string DescribeSpring(const SpringDescription& spring) {
  return absl::StrFormat("  %s: %s, %.6g N/m, %.6g m long\n", spring.name,
                         DescribeEnds(spring.ends), spring.stiffness,
                         spring.length);
}

std::string DescribeLoad(const std::variant<ForceLoad, TorqueLoad>& load) {
  if (const auto* force = std::get_if<ForceLoad>(&load)) {
    return absl::StrFormat("  force %s N on %s\n", DescribeVector(force->force),
                           DescribePoint(force->point));
  }
  const auto& torque = std::get<TorqueLoad>(load);
  return absl::StrFormat("  torque %s N m on %s\n",
                         DescribeVector(torque.torque), torque.body);
}

// "<title>: <number>" and a line for each element, `describe(index)`.
template <typename Describe>
void AddList(const char* title, size_t size, const Describe& describe,
             std::string* text) {
  if (size == 0) return;
  *text += absl::StrFormat("%s: %d\n", title, size);
  for (size_t i = 0; i < std::min(size, kMaxListed); ++i) *text += describe(i);
  if (size > kMaxListed) {
    *text += absl::StrFormat("  ... and %d more\n", size - kMaxListed);
  }
}

}  // namespace

double PenaltyFrequency(const AncfRigidBody& body) {
  // Gₖ as terms: component `c` of the derivative by vector `v` is 1.
  struct Term {
    int vector;
    int component;
  };
  std::array<std::vector<Term>, AncfRigidBody::kNumStrains> terms;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<size_t>(k);
    const auto [m, n] = AncfRigidBody::kShearPairs[i];
    terms[i] = {{k, k}};
    terms[i + 3] = {{m, n}, {n, m}};
  }
  const Matrix3d inverse = body.second_moment().inverse();
  const Vector6d& b = body.penalty_stiffness();
  Eigen::Matrix<double, 6, 6> s = Eigen::Matrix<double, 6, 6>::Zero();
  for (int k = 0; k < 6; ++k) {
    for (int l = 0; l < 6; ++l) {
      for (const Term& x : terms[static_cast<size_t>(k)]) {
        for (const Term& y : terms[static_cast<size_t>(l)]) {
          if (x.component == y.component) {
            s(k, l) +=
                std::sqrt(b(k)) * std::sqrt(b(l)) * inverse(x.vector, y.vector);
          }
        }
      }
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(
      s, Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().maxCoeff());
}

std::string DescribeCase(const LoadedCase& loaded) {
  const Case& given = loaded.description;
  const ModelDescription& model = given.model;
  std::string text = EscapeControls(given.name) + "\n";
  if (!given.purpose.empty()) {
    absl::StrAppend(&text, "  ", EscapeControls(given.purpose), "\n");
  }
  text += absl::StrFormat("Gravity: %s m/s^2\n", DescribeVector(model.gravity));
  AddList(
      "Rigid bodies", model.rigid_bodies.size(),
      [&](size_t i) { return DescribeBody(loaded, i); }, &text);
  AddList(
      "Nodes", model.nodes.size(),
      [&](size_t i) { return DescribeNode(model.nodes[i]); }, &text);
  AddList(
      "Trusses", model.trusses.size(),
      [&](size_t i) { return DescribeTruss(model.trusses[i]); }, &text);
  AddList(
      "Springs", model.springs.size(),
      [&](size_t i) { return DescribeSpring(model.springs[i]); }, &text);
  AddList(
      "Shared points", model.shared_points.size(),
      [&](size_t i) {
        return "  " + DescribeEnds(model.shared_points[i]) + "\n";
      },
      &text);
  AddList(
      "Loads", model.loads.size(),
      [&](size_t i) { return DescribeLoad(model.loads[i]); }, &text);
  text += absl::StrFormat("Degrees of freedom: %d\n",
                          loaded.model.degrees_of_freedom());

  const IntegratorSettings& integrator = given.integrator;
  const int64_t num_steps = NumberOfSteps(integrator);
  text += absl::StrFormat(
      "Integrator: energy_momentum, order %d, %d steps of %.6g s to %.6g s, "
      "tolerance %s\n",
      integrator.order, num_steps, integrator.time_step,
      static_cast<double>(num_steps) * integrator.time_step,
      integrator.tolerance.has_value()
          ? absl::StrFormat("%.6g", *integrator.tolerance)
          : "round_off");
  const int64_t rows = 1 + num_steps / given.output_every +
                       (num_steps % given.output_every == 0 ? 0 : 1);
  text += absl::StrFormat("Output: every %d steps, %d rows\n",
                          given.output_every, rows);

  const ConservedQuantities conserved = QuantitiesConservedBy(loaded.model);
  const auto yes_or_no = [](bool value) { return value ? "yes" : "no"; };
  text += absl::StrFormat(
      "Conserved: energy %s, momentum %s, angular momentum %s\n",
      yes_or_no(conserved.energy), yes_or_no(conserved.momentum),
      yes_or_no(conserved.angular_momentum));
  return text;
}

}  // namespace emmy
