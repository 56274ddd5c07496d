#include "emmy/model/rigid_body_assembly.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "emmy/base/double_double.h"
#include "emmy/element/relaxed_start.h"
#include "emmy/model/validation.h"
#include "emmy/numerics/rotation.h"

namespace emmy {
namespace {

// Products of sizes, which may be nothing or no number although no size is.
absl::StatusOr<RigidBodyInertia> CheckInRange(const std::string& pointer,
                                              const RigidBodyInertia& inertia) {
  if (!std::isfinite(inertia.mass) || !std::isfinite(inertia.volume) ||
      !inertia.second_moment.allFinite()) {
    return FieldError(
        pointer, "a body with finite mass, volume and second moments [SI]",
        absl::StrCat(NumberText(inertia.mass), " kg, ",
                     NumberText(inertia.volume), " m^3 and ",
                     NumberText(inertia.second_moment.diagonal().maxCoeff()),
                     " kg m^2"));
  }
  const double moment = inertia.second_moment.diagonal().minCoeff();
  if (!(std::min({inertia.mass, inertia.volume, moment}) < kLeastMass)) {
    return inertia;
  }
  return FieldError(
      pointer,
      absl::StrCat("a body with mass, volume and second moments >= ",
                   NumberText(kLeastMass), " [SI]"),
      absl::StrCat(NumberText(inertia.mass), " kg, ",
                   NumberText(inertia.volume), " m^3 and ", NumberText(moment),
                   " kg m^2"));
}

absl::StatusOr<RigidBodyInertia> MakeInertia(
    const std::string& pointer, const RigidBodyDescription& description) {
  if (const auto* box = std::get_if<BoxInertia>(&description.inertia)) {
    for (int i = 0; i < 3; ++i) {
      absl::Status status = CheckPositive(
          absl::StrCat(pointer, "/box/size/", i), box->size(i), "m");
      if (!status.ok()) return status;
    }
    absl::Status status =
        CheckPositive(pointer + "/box/density", box->density, "kg/m^3");
    if (!status.ok()) return status;
    return CheckInRange(pointer + "/box",
                        RigidBodyInertia::Box(box->size, box->density));
  }
  const auto& given = std::get<TensorInertia>(description.inertia);
  absl::Status status =
      CheckPositive(pointer + "/inertia/mass", given.mass, "kg");
  if (!status.ok()) return status;
  status = CheckPositive(pointer + "/inertia/volume", given.volume, "m^3");
  if (!status.ok()) return status;
  const std::string tensor_pointer = pointer + "/inertia/tensor";
  for (int i = 0; i < 3; ++i) {
    status = CheckFinite(absl::StrCat(tensor_pointer, "/", i),
                         given.tensor.row(i).transpose(), "kg m^2");
    if (!status.ok()) return status;
    for (int j = 0; j < i; ++j) {
      if (given.tensor(i, j) == given.tensor(j, i)) continue;
      return FieldError(absl::StrCat(tensor_pointer, "/", i, "/", j),
                        absl::StrCat("equal to its mirror entry ", j, "/", i,
                                     " (the tensor is symmetric) [kg m^2]"),
                        absl::StrCat(NumberText(given.tensor(i, j)), " and ",
                                     NumberText(given.tensor(j, i))));
    }
  }
  absl::StatusOr<RigidBodyInertia> inertia =
      RigidBodyInertia::FromTensor(given.mass, given.tensor, given.volume);
  if (!inertia.ok()) {
    return absl::InvalidArgumentError(
        absl::StrCat(tensor_pointer, ": ", inertia.status().message()));
  }
  return CheckInRange(pointer + "/inertia", *inertia);
}

absl::StatusOr<Vector6d> MakePenalty(const std::string& pointer,
                                     const RigidBodyDescription& description) {
  if (const auto* one = std::get_if<double>(&description.penalty)) {
    absl::Status status = CheckPositive(pointer + "/penalty", *one, "Pa");
    if (!status.ok()) return status;
    return Vector6d::Constant(*one).eval();
  }
  if (const auto* six =
          std::get_if<std::array<double, 6>>(&description.penalty)) {
    Vector6d penalty;
    for (int k = 0; k < 6; ++k) {
      penalty(k) = (*six)[static_cast<size_t>(k)];
      absl::Status status = CheckPositive(absl::StrCat(pointer, "/penalty/", k),
                                          penalty(k), "Pa");
      if (!status.ok()) return status;
    }
    return penalty;
  }
  return FieldError(pointer + "/penalty",
                    "given for an ancf body, one number or six [Pa]",
                    "nothing");
}

// The orientation as a quaternion of any positive length.
absl::StatusOr<Vector4d> MakeQuaternion(
    const std::string& pointer, const RigidBodyDescription& description) {
  if (const auto* rotation =
          std::get_if<RotationVector>(&description.orientation)) {
    absl::Status status = CheckFinite(pointer + "/orientation/rotation_vector",
                                      rotation->vector, "rad");
    if (!status.ok()) return status;
    if (!std::isfinite(rotation->vector.squaredNorm())) {
      return FieldError(pointer + "/orientation/rotation_vector",
                        "an angle whose square is a finite number [rad]",
                        NumberText(rotation->vector.stableNorm()));
    }
    return RotationVectorToQuaternion(rotation->vector);
  }
  const auto& given = std::get<Quaternion>(description.orientation);
  const Vector4d q(given.w, given.x, given.y, given.z);
  const std::string field = pointer + "/orientation/quaternion";
  for (int i = 0; i < 4; ++i) {
    if (!std::isfinite(q(i))) {
      return FieldError(absl::StrCat(field, "/", i), "a finite number",
                        NumberText(q(i)));
    }
  }
  // Scaled by its largest entry, so that its square cannot leave the range.
  const double largest = q.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) {
    return FieldError(field, "a quaternion [w, x, y, z] that is not zero",
                      "[0, 0, 0, 0]");
  }
  if (largest > 1e-100 && largest < 1e100) return q;
  // By a power of two, which rounds nothing; of subnormal numbers it is itself
  // out of range.
  const int exponent = std::ilogb(largest);
  return q.unaryExpr([=](double x) { return std::ldexp(x, -exponent); }).eval();
}

// The unit quaternion in extended precision.
std::array<DoubleDouble, 4> Normalized(const Vector4d& q) {
  DoubleDouble square;
  for (int i = 0; i < 4; ++i) {
    square += DoubleDouble(TwoProduct(q(i), q(i)));
  }
  const DoubleDouble length = Sqrt(square);
  std::array<DoubleDouble, 4> unit;
  for (int i = 0; i < 4; ++i) {
    unit[static_cast<size_t>(i)] = DoubleDouble(q(i)) / length;
  }
  return unit;
}

absl::Status CheckMotion(const std::string& pointer,
                         const RigidBodyDescription& description) {
  absl::Status status =
      CheckFinite(pointer + "/position", description.position, "m");
  if (!status.ok()) return status;
  status = CheckFinite(pointer + "/velocity", description.velocity, "m/s");
  if (!status.ok()) return status;
  return CheckFinite(pointer + (description.angular_velocity_in_body_axes
                                    ? "/angular_velocity_body"
                                    : "/angular_velocity"),
                     description.angular_velocity, "rad/s");
}

// Columns of the attitude, R̃.
using Frame = std::array<DoubleDouble3, 3>;

DoubleDouble3 Combine(const Frame& frame, const DoubleDouble3& factors) {
  return factors[0] * frame[0] + factors[1] * frame[1] + factors[2] * frame[2];
}

void Store(const DoubleDouble3& vector, Eigen::Index offset, VectorXd& value,
           VectorXd& compensation) {
  value.segment<3>(offset) = vector.ToDouble();
  compensation.segment<3>(offset) = vector.LowPart();
}

absl::Status AssembleAncf(const std::string& pointer,
                          const RigidBodyDescription& description,
                          const RigidBodyInertia& inertia, const Frame& frame,
                          AssembledRigidBody& assembled) {
  absl::StatusOr<Vector6d> penalty = MakePenalty(pointer, description);
  if (!penalty.ok()) return penalty.status();
  const double largest = penalty->maxCoeff();
  if (!std::isfinite(inertia.volume * largest)) {
    return FieldError(pointer + "/penalty",
                      "so small that its product with the volume is a finite "
                      "number [J]",
                      absl::StrCat(NumberText(largest), " Pa and ",
                                   NumberText(inertia.volume), " m^3"));
  }
  absl::StatusOr<AncfRigidBody> body = AncfRigidBody::Create(inertia, *penalty);
  if (!body.ok()) return body.status();

  DoubleDouble3 omega = DoubleDouble3::FromDouble(description.angular_velocity);
  if (description.angular_velocity_in_body_axes) omega = Combine(frame, omega);

  assembled.strain.setZero(AncfRigidBody::kNumStrains);
  Frame gradients = frame;
  if (description.start == Start::kRelaxed) {
    const Vector3d omega_body(Dot(omega, frame[0]).ToDouble(),
                              Dot(omega, frame[1]).ToDouble(),
                              Dot(omega, frame[2]).ToDouble());
    const Vector6d strain = RelaxedStrain(*body, omega_body);
    const absl::StatusOr<Frame> stretch = StretchOfStrain(strain);
    if (!stretch.ok()) {
      return absl::InvalidArgumentError(
          absl::StrCat(pointer, "/start: ", stretch.status().message(),
                       "; raise the penalty or start undeformed"));
    }
    for (size_t j = 0; j < 3; ++j) {
      gradients[j] = Combine(frame, (*stretch)[j]);
    }
    assembled.strain = strain;
  }
  constexpr int kSize = AncfRigidBody::kNumCoordinates;
  assembled.position.setZero(kSize);
  assembled.position_compensation.setZero(kSize);
  assembled.velocity.setZero(kSize);
  assembled.velocity_compensation.setZero(kSize);
  assembled.position.head<3>() = description.position;
  assembled.velocity.head<3>() = description.velocity;
  for (size_t j = 0; j < 3; ++j) {
    const auto offset = static_cast<Eigen::Index>(3 + 3 * j);
    Store(gradients[j], offset, assembled.position,
          assembled.position_compensation);
    Store(Cross(omega, gradients[j]), offset, assembled.velocity,
          assembled.velocity_compensation);
  }
  assembled.element = *std::move(body);
  return absl::OkStatus();
}

absl::Status AssembleConventional(const std::string& pointer,
                                  const RigidBodyDescription& description,
                                  const RigidBodyInertia& inertia,
                                  const std::array<DoubleDouble, 4>& quaternion,
                                  const Frame& frame,
                                  AssembledRigidBody& assembled) {
  if (!std::holds_alternative<std::monostate>(description.penalty)) {
    return absl::InvalidArgumentError(
        pointer + "/penalty: not allowed for a conventional body");
  }
  if (description.start != Start::kUndeformed) {
    return absl::InvalidArgumentError(
        pointer +
        "/start: must be \"undeformed\" for a conventional body, got "
        "\"relaxed\"");
  }
  assembled.element = ConventionalRigidBody(inertia);
  assembled.position.setZero(ConventionalRigidBody::kNumPositions);
  assembled.position_compensation = assembled.position;
  assembled.velocity.setZero(ConventionalRigidBody::kNumVelocities);
  assembled.velocity_compensation = assembled.velocity;
  assembled.position.head<3>() = description.position;
  assembled.velocity.head<3>() = description.velocity;
  for (size_t i = 0; i < 4; ++i) {
    const auto row = static_cast<Eigen::Index>(3 + i);
    assembled.position(row) = quaternion[i].hi;
    assembled.position_compensation(row) = quaternion[i].lo;
  }
  const DoubleDouble3 omega =
      DoubleDouble3::FromDouble(description.angular_velocity);
  DoubleDouble3 omega_body = omega;
  if (!description.angular_velocity_in_body_axes) {
    for (size_t j = 0; j < 3; ++j) {
      omega_body[static_cast<int>(j)] = Dot(omega, frame[j]);
    }
  }
  Store(omega_body, 3, assembled.velocity, assembled.velocity_compensation);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<AssembledRigidBody> AssembleRigidBody(
    const std::string& pointer, const RigidBodyDescription& description) {
  const absl::StatusOr<RigidBodyInertia> inertia =
      MakeInertia(pointer, description);
  if (!inertia.ok()) return inertia.status();
  const absl::StatusOr<Vector4d> given = MakeQuaternion(pointer, description);
  if (!given.ok()) return given.status();
  absl::Status status = CheckMotion(pointer, description);
  if (!status.ok()) return status;

  const std::array<DoubleDouble, 4> quaternion = Normalized(*given);
  const Frame frame = QuaternionToMatrix(quaternion);
  AssembledRigidBody assembled(*inertia);
  assembled.angular_velocity = description.angular_velocity;
  if (description.angular_velocity_in_body_axes) {
    assembled.angular_velocity =
        Combine(frame, DoubleDouble3::FromDouble(description.angular_velocity))
            .ToDouble();
  }
  status = description.formulation == Formulation::kAncf
               ? AssembleAncf(pointer, description, *inertia, frame, assembled)
               : AssembleConventional(pointer, description, *inertia,
                                      quaternion, frame, assembled);
  if (!status.ok()) return status;
  return assembled;
}

}  // namespace emmy
