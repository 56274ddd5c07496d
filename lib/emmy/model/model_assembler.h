// Collects the checked parts of a description; alone may write a Model.
//
// Elimination is local: a node tied to a body or the ground has no
// coordinates; its mass, and the forces on it, go to the body by constant
// weights (reduction full = C · reduced, (PNT-1)). Bodies that share a point
// keep their coordinates and get a constraint G q = const with constant G, or a
// joint if they are conventional.

#ifndef EMMY_MODEL_MODEL_ASSEMBLER_H_
#define EMMY_MODEL_MODEL_ASSEMBLER_H_

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "emmy/base/double_double.h"
#include "emmy/model/model.h"
#include "emmy/model/model_builder.h"
#include "emmy/model/model_description.h"
#include "emmy/model/node_ties.h"
#include "emmy/model/state.h"

namespace emmy {

class ModelAssembler {
 public:
  explicit ModelAssembler(const ModelDescription& description)
      : description_(description) {}

  absl::StatusOr<BuiltModel> Assemble() &&;

 private:
  struct NamedItem {
    enum class Kind { kBody, kNode, kLine };
    Kind kind = Kind::kBody;
    size_t index = 0;
    std::string pointer;
  };
  struct Motion {
    DoubleDouble3 position;
    Vector3d velocity = Vector3d::Zero();
  };

  // In the order of Assemble; each returns at the first field at fault.
  absl::Status AddGravity();
  absl::Status AddBodies();
  absl::Status ReadNodes();
  absl::Status TieSharedPoints();
  absl::Status AddNodes();
  absl::Status AddConstraints();
  absl::Status AddJoint(const AnchorPair& pair);
  absl::Status AddTrusses();
  absl::Status AddSprings();
  absl::Status AddLoads();
  absl::Status CheckMasses() const;

  // Names head the columns of the results, so they are shared by all kinds.
  absl::Status AddName(const std::string& pointer, const std::string& name,
                       NamedItem::Kind kind, size_t index);
  absl::StatusOr<ResolvedPoint> Resolve(const std::string& pointer,
                                        const PointDescription& point) const;
  absl::StatusOr<Vector3d> StartVelocity(const std::string& pointer,
                                         const NodeDescription& node) const;

  // The point as a function of coordinates; nodes must have been added.
  Point MakePoint(const ResolvedPoint& resolved) const;
  Point BodyPointOf(const ResolvedBodyPoint& body_point) const;
  Point Closed(const AnchorPair& pair) const;
  Motion MotionOf(const Point& point) const;
  Motion MotionOf(const ResolvedPoint& resolved) const;
  absl::Status CheckTogether(const std::string& pointer, const Motion& first,
                             const Motion& second) const;

  int AddVector(const Vector3d& position, const Vector3d& velocity);
  void AddPointMass(const Point& point, double mass);
  void AddConsistentMass(const std::array<Point, 2>& ends, double mass);
  void AddMassBetween(const Point& first, const Point& second, double mass);
  absl::StatusOr<std::array<Point, 2>> MakeEnds(
      const std::string& pointer,
      const std::array<PointDescription, 2>& ends) const;
  // `pointer` is that of the element, for messages. Fails if the ends cannot
  // move apart.
  absl::Status AddLine(const std::string& pointer, const std::string& name,
                       const LineElement& element,
                       const std::array<Point, 2>& ends, double mass);
  void MeasureModel();

  const ModelDescription& description_;
  Model model_;
  State state_;
  std::unordered_map<std::string, NamedItem> items_;
  double size_ = 0.0;                    // Of the model [m].
  double largest_omega_ = 0.0;           // Of any body [rad/s].
  std::vector<Vector3d> body_omega_;     // Inertial, at the start.
  std::vector<Vector3d> node_velocity_;  // As described.
  NodeTies ties_{0};
  std::vector<int> vector_of_node_;  // Of representatives, or −1.
  std::vector<std::map<int, double>> mass_;
};

}  // namespace emmy

#endif  // EMMY_MODEL_MODEL_ASSEMBLER_H_
