// One energy-momentum step of conventional bodies with trusses, cables,
// springs, nodes, joints and loads: the comparator of structures.
//
// Unknown: Δv and ΔW of each body, Δw of each node. With Θ = Δt W̄ and
// R̄ = ½ (R₀ + R₁) = R₀ (1 − ½ Hat(Θ))⁻¹, a point ξ of a body moves by
//   Δx = Δt v̄_c,  v̄_c = v̄ + (R₀ W̄) × (R̄ ξ)                        (CRB-6)
// exactly, and a force f̄ on it does the work f̄·Δx if it enters as
//   M Δv = Δt f̄,  J ΔW + Δt W̄ × J W̄ = Δt R̄⁻¹ ((R̄ ξ) × f̄)          (CRB-7)
// The end of an element with mass has a velocity of its own, advanced by
//   v_c1 = v_c0 + 2 (v̄_c − v_c0)                                  (CRB-8)
// and its momentum m (v_c/3 + v_other/6) acts on the body as −Δp/Δt. Energy,
// momentum and angular momentum are kept exactly, as for the ANCF body. The
// effective mass matrix changes with the attitude: the tangent is formed and
// factorised anew in every step.
//
// A joint adds impulses −λ̂ = −Δt λ and λ̂ at its two points as above, and
//   2 (v̄_c1 − v̄_c2 + c₀/Δt) = 0,  c = x_c1 − x_c2                  (CONJ-1)
// so that the gap c₁ at the end is zero; c₀ is measured in extended precision,
// and what rounding left of it is closed by the next step. Corrections are
// those of Newton's method with the exact Jacobian of the joints (CONJ-4).
//
// Not covered: structures that mix conventional and ANCF bodies.

#ifndef EMMY_INTEGRATE_CONVENTIONAL_STRUCTURE_STEP_H_
#define EMMY_INTEGRATE_CONVENTIONAL_STRUCTURE_STEP_H_

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "emmy/base/double_double.h"
#include "emmy/base/types.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/conventional_tangent.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
#include "emmy/numerics/newton.h"

namespace emmy {

class ConventionalStructureStep {
 public:
  // Gathers the bodies of `model` to which something is attached, and what is
  // attached. Empty if there are none. Fails with kUnimplemented where an
  // ANCF body is attached too. `model` must outlive the step.
  static absl::StatusOr<std::optional<ConventionalStructureStep>> Create(
      const Model& model, double time_step, const NewtonOptions& options);

  // Whether body `index` of the model is solved here.
  bool Contains(size_t index) const { return local_body_[index] >= 0; }

  // Solves (CRB-7) and (CONJ-1); `state` is not changed. Ends with
  // kSingularTangent, too, if a joint opens along a direction that other joints
  // held at the start of the run.
  BodyStepResult Solve(const State& state);

  // Advances `state` by the last solution, except its time.
  void Commit(State& state) const;

  // The joint that opens or else the body with the largest residual, after a
  // step that failed.
  std::string WorstPart() const;

 private:
  struct Body {
    size_t index = 0;
    const ModelBody* body = nullptr;
    double least_inertia = 0.0;  // Smallest principal value of J.
    // Start.
    Vector4d quaternion;
    Matrix3d rotation;  // R₀
    Vector3d x0, x0_compensation, v0, v0_compensation, w0, w0_compensation;
    // Iterate.
    Vector3d mean_velocity, mean_omega, increment;  // v̄, W̄, Δx̄
    Matrix3d mean_rotation, inverse_mean_rotation;  // R̄, R̄⁻¹
    Vector3d torque;                                // Σ (R̄ ξ) × impulses
    // For joints: R₀, by columns, and the radius of gyration [m].
    std::array<DoubleDouble3, 3> frame;
    double gyration = 0.0;
  };
  struct Node {
    const VectorCoordinate* vector = nullptr;
    Vector3d q0, q0_compensation, w0, w0_compensation, mean_rate, increment;
  };
  struct End {
    int body = -1;  // Local; else
    int node = -1;  // local; else the ground.
    Vector3d xi = Vector3d::Zero();
    Eigen::Index velocity_offset = -1;
    // Start and iterate.
    Vector3d start, rest;           // x₀: value and compensation.
    Vector3d v0, v0_compensation;   // Own velocity, body ends with mass.
    Vector3d arm;                   // R̄ ξ
    Vector3d mean_rate, increment;  // v̄_c, Δx
    Vector3d rate_increment;        // Δv_c
  };
  struct Line {
    const ModelLine* line = nullptr;
    std::array<End, 2> ends;
    double strain = 0.0;  // At the start, and its compensation.
    double strain_compensation = 0.0;
    Vector3d mean;  // d̄
    LineElement::Response response = {};
  };
  struct Joint {
    const ModelJoint* joint = nullptr;
    Eigen::Index multiplier = 0;  // In the state.
    std::array<End, 2> ends;
    // Start: projection onto what is held, inertial axes; c₀/Δt.
    Matrix3d held = Matrix3d::Identity();
    Vector3d closing_rate;
  };
  struct Mass {  // Between nodes, each ordered pair.
    int row = 0;
    int column = 0;
    double mass = 0.0;
  };
  struct Force {
    End end;
    Vector3d force;
  };
  struct Torque {
    int body = 0;
    Vector3d torque;
  };
  struct Scale {
    double rate = 0.0;
    double work = 0.0;
    double moment = 0.0;
  };
  using Index = Eigen::Index;

  ConventionalStructureStep(const Model& model, double time_step,
                            const NewtonOptions& options)
      : model_(&model), time_step_(time_step), options_(options) {}

  absl::Status Gather();
  absl::Status GatherLines();
  void GatherMasses();
  absl::Status GatherLoads();
  absl::StatusOr<End> MakeEnd(const Point& point);
  absl::StatusOr<int> LocalNode(int vector);
  int LocalBody(size_t index);

  // Blocks of three unknowns: v and W of the bodies, nodes, joints.
  int BodyBlock(int body) const { return 2 * body; }
  int NodeBlock(int node) const {
    return 2 * static_cast<int>(bodies_.size()) + node;
  }
  int JointBlock(int joint) const {
    return NodeBlock(static_cast<int>(nodes_.size())) + joint;
  }
  int NumBlocks() const { return JointBlock(static_cast<int>(joints_.size())); }
  Index BodyRow(int body) const {
    return 3 * static_cast<Index>(BodyBlock(body));
  }
  Index NodeRow(int node) const {
    return 3 * static_cast<Index>(NodeBlock(node));
  }
  Index JointRow(int joint) const {
    return 3 * static_cast<Index>(JointBlock(joint));
  }

  void Load(const State& state);
  void LoadEnd(const State& state, End* end) const;
  void Evaluate();
  void EvaluateEnd(End* end) const;
  void AddImpulse(const End& end, const Vector3d& impulse);
  void EvaluateBody(size_t index);
  void EvaluateLine(Line* line);
  bool FormTangent();
  BodyStepResult Iterate(bool damped);
  BodyStepResult IterateAndCheck(bool damped);
  Scale Scales() const;
  double LargestCorrection(double rate) const;
  double Work() const;
  Vector3d Moment() const;
  void AddToTangent(const End& first, const End& second,
                    const Matrix3d& stiffness);
  // Joints.
  absl::Status GatherJoints();
  void MakePattern();
  DoubleDouble3 Place(const State& state, const End& end,
                      const Vector3d& rest) const;
  void LoadJoints(const State& state);
  std::pair<Vector3d, Vector3d> SplitRate(const End& end) const;
  void EvaluateJoints();
  void AddJointsToTangent();
  void LimitTurns();
  bool KeepsEnergy() const;
  const ModelJoint* OpenJoint() const;
  void CommitJoints(State& state) const;

  const Model* model_;
  double time_step_;
  NewtonOptions options_;
  std::vector<int> local_body_;          // By index of the model.
  std::vector<int> local_node_;          // By vector coordinate.
  std::vector<const ModelBody*> owner_;  // ANCF body of a vector coordinate.
  std::vector<Body> bodies_;
  std::vector<Node> nodes_;
  std::vector<Line> lines_;
  std::vector<Mass> masses_;
  std::vector<Force> forces_;
  std::vector<Torque> torques_;
  std::vector<Joint> joints_;
  const ModelJoint* open_joint_ = nullptr;  // Of the last solution.
  VectorXd unknown_, residual_, magnitude_, correction_;
  ConventionalTangent tangent_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_CONVENTIONAL_STRUCTURE_STEP_H_
