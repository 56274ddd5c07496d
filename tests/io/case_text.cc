#include "tests/io/case_text.h"

#include <iomanip>
#include <sstream>
#include <variant>

namespace emmy {
namespace {

class Printer {
 public:
  std::string text() const { return out_.str(); }

  template <typename T>
  void Field(const char* name, const T& value) {
    out_ << name << " = ";
    Value(value);
    out_ << "\n";
  }

 private:
  void Value(const std::string& text) { out_ << std::quoted(text); }
  void Value(bool value) { out_ << value; }
  void Value(int value) { out_ << value; }
  void Value(int64_t value) { out_ << value; }
  void Value(double x) { out_ << std::hexfloat << x << " "; }
  void Value(Formulation value) { out_ << static_cast<int>(value); }
  void Value(Start value) { out_ << static_cast<int>(value); }
  void Value(Method value) { out_ << static_cast<int>(value); }
  void Value(std::monostate /*nothing*/) { out_ << "none"; }

  template <int rows, int columns>
  void Value(const Eigen::Matrix<double, rows, columns>& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) Value(matrix.data()[i]);
  }
  template <typename T, size_t n>
  void Value(const std::array<T, n>& array) {
    for (const T& element : array) Value(element);
  }
  template <typename T>
  void Value(const std::vector<T>& list) {
    out_ << list.size() << " {\n";
    for (const T& element : list) Value(element);
    out_ << "}";
  }
  template <typename T>
  void Value(const std::optional<T>& value) {
    if (value.has_value()) {
      Value(*value);
    } else {
      out_ << "none";
    }
  }
  template <typename... T>
  void Value(const std::variant<T...>& value) {
    out_ << "(" << value.index() << ") ";
    std::visit([this](const auto& alternative) { this->Value(alternative); },
               value);
  }

  void Value(const BoxInertia& v) {
    Field("size", v.size);
    Field("density", v.density);
  }
  void Value(const TensorInertia& v) {
    Field("mass", v.mass);
    Field("tensor", v.tensor);
    Field("volume", v.volume);
  }
  void Value(const Quaternion& q) {
    Value(std::array<double, 4>{q.w, q.x, q.y, q.z});
  }
  void Value(const RotationVector& v) { Value(v.vector); }
  void Value(const RigidBodyDescription& v) {
    Field("name", v.name);
    Field("formulation", v.formulation);
    Field("inertia", v.inertia);
    Field("penalty", v.penalty);
    Field("position", v.position);
    Field("orientation", v.orientation);
    Field("velocity", v.velocity);
    Field("angular_velocity", v.angular_velocity);
    Field("in_body_axes", v.angular_velocity_in_body_axes);
    Field("start", v.start);
  }
  void Value(const BodyPoint& v) {
    Field("body", v.body);
    Field("point", v.point);
  }
  void Value(const NodePoint& v) { Field("node", v.node); }
  void Value(const GroundPoint& v) { Field("ground", v.position); }
  void Value(const MovesWith& v) { Field("moves_with", v.body); }
  void Value(const NodeDescription& v) {
    Field("name", v.name);
    Field("mass", v.mass);
    Field("position", v.position);
    Field("velocity", v.velocity);
    Field("fixed", v.fixed);
  }
  void Value(const TrussDescription& v) {
    Field("name", v.name);
    Field("ends", v.ends);
    Field("area", v.area);
    Field("density", v.density);
    Field("young_modulus", v.young_modulus);
    Field("tension_only", v.tension_only);
    Field("length", v.length);
  }
  void Value(const SpringDescription& v) {
    Field("name", v.name);
    Field("ends", v.ends);
    Field("stiffness", v.stiffness);
    Field("length", v.length);
  }
  void Value(const ForceLoad& v) {
    Field("point", v.point);
    Field("force", v.force);
  }
  void Value(const TorqueLoad& v) {
    Field("body", v.body);
    Field("torque", v.torque);
  }

  std::ostringstream out_;
};

}  // namespace

std::string CaseText(const Case& value) {
  Printer printer;
  printer.Field("name", value.name);
  printer.Field("purpose", value.purpose);
  printer.Field("gravity", value.model.gravity);
  printer.Field("rigid_bodies", value.model.rigid_bodies);
  printer.Field("nodes", value.model.nodes);
  printer.Field("trusses", value.model.trusses);
  printer.Field("springs", value.model.springs);
  printer.Field("shared_points", value.model.shared_points);
  printer.Field("loads", value.model.loads);
  printer.Field("method", value.integrator.method);
  printer.Field("order", value.integrator.order);
  printer.Field("time_step", value.integrator.time_step);
  printer.Field("duration", value.integrator.duration);
  printer.Field("tolerance", value.integrator.tolerance);
  printer.Field("output_every", value.output_every);
  return printer.text();
}

}  // namespace emmy
