#include "verification/models/large_models.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "absl/strings/str_cat.h"

namespace emmy::verification {
namespace {

constexpr double kSide = 14.0;          // [m]
constexpr double kSpin = 0.2;           // [rad/s]
constexpr double kSaddle = 0.05;        // Height of the start [m].
constexpr double kSectionArea = 1e-6;   // [m^2]
constexpr double kYoungModulus = 7e10;  // [Pa]
constexpr double kDensity = 2700.0;     // [kg/m^3]
constexpr double kCornerMass = 0.1;     // [kg]
constexpr double kPenalty = 1e10;       // [Pa]

std::string NodeName(int i, int j) { return absl::StrCat("node_", i, "_", j); }

Case EmptyCase(const std::string& name, const std::string& purpose,
               double duration = 1.0) {
  Case value;
  value.name = name;
  value.purpose = purpose;
  value.integrator.time_step = 1e-3;
  value.integrator.duration = duration;
  value.output_every = 100;
  return value;
}

// A net of n × n nodes with a hub, of trusses or cables.
class NetBuilder {
 public:
  NetBuilder(int n, bool tension_only)
      : n_(n), mesh_(kSide / (n - 1)), tension_only_(tension_only) {}

  ModelDescription Build() {
    AddHub();
    for (int i = 0; i < n_; ++i) {
      for (int j = 0; j < n_; ++j) AddNode(i, j);
    }
    for (int i = 0; i < n_; ++i) {
      for (int j = 0; j < n_; ++j) {
        if (i + 1 < n_) AddTruss(i, j, i + 1, j);
        if (j + 1 < n_) AddTruss(i, j, i, j + 1);
        if (i + 1 < n_ && j + 1 < n_) {
          AddTruss(i, j, i + 1, j + 1);
          AddTruss(i + 1, j, i, j + 1);
        }
      }
    }
    return std::move(model_);
  }

 private:
  Vector3d Position(int i, int j) const {
    const double x = -0.5 * kSide + mesh_ * i;
    const double y = -0.5 * kSide + mesh_ * j;
    // Zero on the diagonals, where the hub's corners are.
    const double z = 4.0 * kSaddle * (x * x - y * y) / (kSide * kSide);
    return {x, y, z};
  }

  void AddHub() {
    RigidBodyDescription hub;
    hub.name = "hub";
    hub.inertia = BoxInertia{{mesh_, mesh_, 0.5 * mesh_}, kDensity};
    hub.penalty = kPenalty;
    hub.angular_velocity = {0.0, 0.0, kSpin};
    model_.rigid_bodies.push_back(hub);
  }

  void AddNode(int i, int j) {
    NodeDescription node;
    node.name = NodeName(i, j);
    node.position = Position(i, j);
    node.velocity = Vector3d(Vector3d(0.0, 0.0, kSpin).cross(node.position));
    const bool corner = (i == 0 || i == n_ - 1) && (j == 0 || j == n_ - 1);
    node.mass = corner ? kCornerMass : 0.0;
    // The node at the centre, or the four around it.
    if (std::abs(node.position(0)) < 0.75 * mesh_ &&
        std::abs(node.position(1)) < 0.75 * mesh_) {
      node.position(2) = 0.0;
      model_.shared_points.push_back(
          {NodePoint{node.name}, BodyPoint{"hub", node.position}});
    }
    model_.nodes.push_back(node);
  }

  void AddTruss(int i, int j, int k, int l) {
    TrussDescription truss;
    truss.name = absl::StrCat("truss_", model_.trusses.size());
    truss.ends = {NodePoint{NodeName(i, j)}, NodePoint{NodeName(k, l)}};
    truss.area = kSectionArea;
    truss.density = kDensity;
    truss.young_modulus = kYoungModulus;
    truss.tension_only = tension_only_;
    model_.trusses.push_back(truss);
  }

  int n_;
  double mesh_;
  bool tension_only_;
  ModelDescription model_;
};

RigidBodyDescription ChainBox(int index, const Vector3d& position) {
  RigidBodyDescription box;
  box.name = absl::StrCat("box_", index);
  box.inertia = BoxInertia{{3.0, 2.0, 1.0}, kDensity};
  box.penalty = kPenalty;
  box.position = position;
  return box;
}

// Different for every box, without a period that a chain could resonate with.
Vector3d ChainOmega(int index) {
  return {0.3 * std::cos(1.7 * index), 0.1 * std::sin(0.9 * index),
          0.1 * std::cos(1.3 * index)};
}

}  // namespace

Case SpinningNet(int n) {
  Case value = EmptyCase(
      absl::StrCat("spinning_net_", n),
      "A spinning square net with both diagonals, a hub and corner masses.");
  value.model = NetBuilder(n, /*tension_only=*/false).Build();
  return value;
}

Case SlackCableNet(int n) {
  Case value =
      EmptyCase(absl::StrCat("slack_cable_net_", n),
                "A spinning net of cables that go slack and taut.", 5.0);
  value.model = NetBuilder(n, /*tension_only=*/true).Build();
  // Not carried round by the spin: the net ripples and its cables go slack. All
  // but the nodes that the hub holds.
  std::set<std::string> held;
  for (const auto& [node, body] : value.model.shared_points) {
    held.insert(std::get<NodePoint>(node).node);
  }
  for (NodeDescription& node : value.model.nodes) {
    if (held.count(node.name) > 0) continue;
    auto& velocity = std::get<Vector3d>(node.velocity);
    velocity(2) += 0.2 * std::sin(3.0 * node.position(0)) *
                   std::cos(2.0 * node.position(1));
  }
  return value;
}

Case BoxChain(int n) {
  Case value = EmptyCase(absl::StrCat("box_chain_", n),
                         "A chain of boxes joined by spherical joints.");
  const Vector3d arm(1.5, 0.0, 0.0);
  Vector3d velocity = Vector3d::Zero();
  Vector3d mean = Vector3d::Zero();
  for (int i = 0; i < n; ++i) {
    RigidBodyDescription box =
        ChainBox(i, Vector3d(3.0 * (i - 0.5 * (n - 1)), 0.0, 0.0));
    box.angular_velocity = ChainOmega(i);
    // The joint moves alike with both its boxes.
    if (i > 0) {
      velocity += (ChainOmega(i - 1) + ChainOmega(i)).cross(arm);
      value.model.shared_points.push_back(
          {BodyPoint{absl::StrCat("box_", i - 1), arm},
           BodyPoint{box.name, -arm}});
    }
    box.velocity = velocity;
    mean += velocity / n;
    value.model.rigid_bodies.push_back(box);
  }
  // Drifting slowly, so that the momentum is a number to be kept.
  for (RigidBodyDescription& box : value.model.rigid_bodies) {
    box.velocity += Vector3d(0.1, 0.2, 0.3) - mean;
  }
  return value;
}

namespace {

// The same of conventional bodies.
Case Conventional(Case value) {
  value.name = absl::StrCat("conventional_", value.name);
  value.purpose.back() = ',';
  value.purpose += " of conventional bodies.";
  for (RigidBodyDescription& box : value.model.rigid_bodies) {
    box.formulation = Formulation::kConventional;
    box.penalty = std::monostate();
  }
  return value;
}

}  // namespace

Case ConventionalBoxChain(int n) { return Conventional(BoxChain(n)); }

Case BoxRing(int n) {
  Case value = EmptyCase(absl::StrCat("box_ring_", n),
                         "A ring of boxes joined by spherical joints.");
  constexpr double kLength = 3.0;
  const Vector3d half(0.5 * kLength, 0.0, 0.0);
  const Vector3d up(0.0, 0.0, 1.0);
  const double turn = 2.0 * std::acos(-1.0) / n;
  const double inner_radius = 0.5 * kLength / std::tan(0.5 * turn);
  // Corner i rises alike with both its boxes.
  const auto rise = [n](int i) { return 0.1 * std::sin(0.9 * (i % n)); };
  for (int i = 0; i < n; ++i) {
    const double angle = turn * i;
    RigidBodyDescription box = ChainBox(
        i, inner_radius * Vector3d(std::sin(angle), -std::cos(angle), 0.0));
    box.orientation = RotationVector{angle * up};
    const Vector3d along(std::cos(angle), std::sin(angle), 0.0);
    box.angular_velocity =
        kSpin * up + 0.1 * std::cos(0.7 * i) * along -
        ((rise(i + 1) - rise(i)) / kLength) * up.cross(along);
    box.velocity = (kSpin * up).cross(box.position) +
                   0.5 * (rise(i + 1) + rise(i)) * up + Vector3d(0.1, 0.2, 0.3);
    value.model.rigid_bodies.push_back(box);
    value.model.shared_points.push_back(
        {BodyPoint{box.name, half},
         BodyPoint{absl::StrCat("box_", (i + 1) % n), -half}});
  }
  return value;
}

Case ConventionalBoxRing(int n) { return Conventional(BoxRing(n)); }

Case BoxGrid(int n) {
  Case value = EmptyCase(absl::StrCat("box_grid_", n),
                         "A square grid of boxes joined by spherical joints.");
  const Vector3d along(1.5, 0.0, 0.0);
  const Vector3d across(0.0, 1.0, 0.0);
  const auto name = [](int i, int j) {
    return absl::StrCat("box_", i, "_", j);
  };
  // Out of the plane: ω = (ωx(j), ωy(i), 0) and vz = f(i) + g(j), so that
  // neighbours move alike where they meet.
  const auto tilt = [](int k) { return 0.1 * std::sin(0.9 * k); };
  std::vector<double> rise(static_cast<size_t>(n), 0.0);   // g by j.
  std::vector<double> climb(static_cast<size_t>(n), 0.0);  // f by i.
  double mean = 0.0;
  for (int k = 0; k < n; ++k) {
    const auto here = static_cast<size_t>(k);
    if (k > 0) {
      rise[here] = rise[here - 1] + across(1) * (tilt(k - 1) + tilt(k));
      climb[here] = climb[here - 1] - along(0) * (tilt(k - 1) + tilt(k));
    }
    mean += (rise[here] + climb[here]) / n;
  }
  const Vector3d spin(0.0, 0.0, kSpin);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      RigidBodyDescription box = ChainBox(
          0,
          Vector3d(3.0 * (i - 0.5 * (n - 1)), 2.0 * (j - 0.5 * (n - 1)), 0.0));
      box.name = name(i, j);
      box.angular_velocity = spin + Vector3d(tilt(j), tilt(i), 0.0);
      box.velocity = spin.cross(box.position) +
                     Vector3d(0.1, 0.2,
                              0.3 - mean + climb[static_cast<size_t>(i)] +
                                  rise[static_cast<size_t>(j)]);
      value.model.rigid_bodies.push_back(box);
      if (i > 0) {
        value.model.shared_points.push_back(
            {BodyPoint{name(i - 1, j), along}, BodyPoint{box.name, -along}});
      }
      if (j > 0) {
        value.model.shared_points.push_back(
            {BodyPoint{name(i, j - 1), across}, BodyPoint{box.name, -across}});
      }
    }
  }
  return value;
}

Case BoxTree(int n) {
  Case value = EmptyCase(absl::StrCat("box_tree_", n),
                         "A binary tree of boxes joined by spherical joints.");
  // On the box towards the root, and the box's own end.
  const std::array<Vector3d, 2> branches = {Vector3d(1.5, 1.0, 0.0),
                                            Vector3d(1.5, -1.0, 0.0)};
  const Vector3d foot(-1.5, 0.0, 0.0);
  for (int i = 0; i < n; ++i) {
    RigidBodyDescription box = ChainBox(i, Vector3d(0.0, 0.0, 0.0));
    box.angular_velocity = ChainOmega(i);
    box.velocity = Vector3d(0.1, 0.2, 0.3);
    if (i > 0) {
      const int parent = (i - 1) / 2;
      const RigidBodyDescription& other =
          value.model.rigid_bodies[static_cast<size_t>(parent)];
      const Vector3d& branch = branches[static_cast<size_t>((i - 1) % 2)];
      box.position = other.position + branch - foot;
      box.velocity = other.velocity + other.angular_velocity.cross(branch) -
                     box.angular_velocity.cross(foot);
      value.model.shared_points.push_back(
          {BodyPoint{other.name, branch}, BodyPoint{box.name, foot}});
    }
    value.model.rigid_bodies.push_back(box);
  }
  return value;
}

Case TrussedBoxes(int n) {
  Case value = EmptyCase(absl::StrCat("trussed_boxes_", n),
                         "Boxes in a row, neighbours joined by four trusses.");
  constexpr double kGap = 2.0;
  const std::array<Vector3d, 4> corners = {
      Vector3d(1.5, 1.0, 0.5), Vector3d(1.5, -1.0, 0.5),
      Vector3d(1.5, 1.0, -0.5), Vector3d(1.5, -1.0, -0.5)};
  for (int i = 0; i < n; ++i) {
    RigidBodyDescription box =
        ChainBox(i, Vector3d((3.0 + kGap) * (i - 0.5 * (n - 1)), 0.0, 0.0));
    // Spinning about the row, each with a wobble of its own.
    box.angular_velocity = Vector3d(0.5, 0.0, 0.0) + 0.02 * ChainOmega(i);
    value.model.rigid_bodies.push_back(box);
    if (i == 0) continue;
    for (size_t k = 0; k < corners.size(); ++k) {
      TrussDescription truss;
      truss.name = absl::StrCat("truss_", i, "_", k);
      const Vector3d& here = corners[k];
      // Crossed over, to resist shear and twist as well.
      const Vector3d there(-here(0), -here(1), here(2));
      truss.ends = {BodyPoint{absl::StrCat("box_", i - 1), here},
                    BodyPoint{box.name, there}};
      truss.area = 1e-4;
      truss.density = kDensity;
      truss.young_modulus = kYoungModulus;
      value.model.trusses.push_back(truss);
    }
  }
  return value;
}

}  // namespace emmy::verification
