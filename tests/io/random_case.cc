#include "tests/io/random_case.h"

#include <bit>
#include <cmath>
#include <string>

namespace emmy {
namespace {

class Generator {
 public:
  explicit Generator(std::mt19937_64& random) : random_(random) {}

  Case Make() {
    Case result;
    result.name = Name();
    if (Coin()) result.purpose = Name();
    ModelDescription& model = result.model;
    model.gravity = Vector();
    Repeat([&] { model.rigid_bodies.push_back(Body()); });
    Repeat([&] { model.nodes.push_back(Node()); });
    Repeat([&] { model.trusses.push_back(Truss()); });
    Repeat([&] { model.springs.push_back(Spring()); });
    Repeat([&] { model.shared_points.push_back({Point(), Point()}); });
    Repeat([&] {
      if (Coin()) {
        model.loads.emplace_back(ForceLoad{Point(), Vector()});
      } else {
        model.loads.emplace_back(TorqueLoad{Name(), Vector()});
      }
    });
    result.integrator.order = 2 * (1 + Below(3));
    result.integrator.time_step = Within(1e-6, 1.0);
    result.integrator.duration = Within(1e-3, 1e3);
    if (Coin()) result.integrator.tolerance = Within(1e-15, 0.9);
    result.output_every = 1 + Below(1000);
    return result;
  }

 private:
  bool Coin() { return Below(2) == 0; }
  int Below(int n) {
    return static_cast<int>(random_() % static_cast<uint64_t>(n));
  }
  template <typename Function>
  void Repeat(const Function& function) {
    for (int i = Below(4); i > 0; --i) function();
  }
  double Within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  double Number() {
    switch (Below(4)) {
      case 0:
        return Below(3) - 1;  // Written like an integer.
      case 1:
        return -0.0;
      default:
        break;
    }
    double x = 0.0;
    do {
      x = std::bit_cast<double>(random_());
    } while (!std::isfinite(x));
    return x;
  }
  double Positive() { return std::abs(Number()) + 5e-324; }
  Vector3d Vector() { return Vector3d(Number(), Number(), Number()); }
  std::string Name() {
    static const char* const kNames[] = {"box",   "a b",    "Körper", "x\"y\\",
                                         "a/b~c", "日本語", "1",      "\t"};
    return kNames[Below(8)] + std::to_string(Below(100));
  }

  RigidBodyDescription Body() {
    RigidBodyDescription body;
    body.name = Name();
    if (Coin()) body.formulation = Formulation::kConventional;
    if (Coin()) {
      body.inertia = BoxInertia{Vector(), Positive()};
    } else {
      TensorInertia inertia{Positive(), Matrix3d::Zero(), Positive()};
      for (int i = 0; i < 9; ++i) inertia.tensor(i / 3, i % 3) = Number();
      body.inertia = inertia;
    }
    switch (Below(3)) {
      case 0:
        body.penalty = Positive();
        break;
      case 1:
        body.penalty =
            std::array<double, 6>{Positive(), Positive(), Positive(),
                                  Positive(), Positive(), Positive()};
        break;
      default:
        break;
    }
    body.position = Vector();
    if (Coin()) {
      body.orientation = Quaternion{Number(), Number(), Number(), Number()};
    } else {
      body.orientation = RotationVector{Vector()};
    }
    body.velocity = Vector();
    body.angular_velocity = Vector();
    body.angular_velocity_in_body_axes = Coin();
    if (Coin()) body.start = Start::kRelaxed;
    return body;
  }

  PointDescription Point() {
    switch (Below(3)) {
      case 0:
        return BodyPoint{Name(), Vector()};
      case 1:
        return NodePoint{Name()};
      default:
        return GroundPoint{Vector()};
    }
  }

  NodeDescription Node() {
    NodeDescription node;
    node.name = Name();
    node.mass = Number();
    node.position = Vector();
    if (Coin()) {
      node.velocity = Vector();
    } else {
      node.velocity = MovesWith{Name()};
    }
    node.fixed = Coin();
    return node;
  }

  TrussDescription Truss() {
    TrussDescription truss;
    truss.name = Name();
    truss.ends = {Point(), Point()};
    truss.area = Positive();
    truss.density = Positive();
    truss.young_modulus = Positive();
    truss.tension_only = Coin();
    if (Coin()) truss.length = Positive();
    return truss;
  }

  SpringDescription Spring() {
    SpringDescription spring;
    spring.name = Name();
    spring.ends = {Point(), Point()};
    spring.stiffness = Positive();
    spring.length = Positive();
    return spring;
  }

  std::mt19937_64& random_;
};

}  // namespace

Case RandomCase(std::mt19937_64& random) { return Generator(random).Make(); }

}  // namespace emmy
