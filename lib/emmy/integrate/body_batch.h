// Thousands of independent bodies, stepped several at a time by SIMD and on
// several threads.
//
// The same equations, to the same round-off, as the steps of one body
// (ancf_body_step.h, conventional_body_step.h), which stand by: a body whose
// iteration is too slow with the closed-form tangent takes that step by them,
// and bodies that are not in principal axes take all steps so. The results are
// the same bits for any number of threads, division of a run into calls, and
// whatever other bodies there are; and for any instruction set that has fused
// multiply-add (x86-64 from AVX2 on, Arm). Those without it agree with each
// other, and with these to round-off.
//
// Not covered: anything attached to a body (EnergyMomentumIntegrator), orders
// above two, a tolerance above round-off.

#ifndef EMMY_INTEGRATE_BODY_BATCH_H_
#define EMMY_INTEGRATE_BODY_BATCH_H_

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "emmy/base/export.h"
#include "emmy/model/model.h"
#include "emmy/model/state.h"
#include "emmy/numerics/newton.h"

namespace emmy {

// How a batch is stepped.
struct BodyBatchOptions {
  double time_step = 0.0;   // Δt [s]; negative steps go back in time.
  int num_threads = 1;      // At least 1.
  int max_iterations = 60;  // Of the step of one body.
};

// A body that could not be stepped. It stays as after its last good step.
struct BatchFailure {
  std::string body;  // Name.
  int64_t step = 0;  // The one that failed, by the count of State::step.
  Termination termination = Termination::kMaxIterations;  // Why.
  std::string message;  // The same in words, with what may help.
};

// What became of the steps of a batch.
struct [[nodiscard]] BatchReport {
  int64_t iterations = 0;              // Sum over bodies and steps.
  int64_t ordinary_steps = 0;          // Taken by the steps of one body.
  std::vector<BatchFailure> failures;  // In the order of the model's bodies.
  // Whether every body took every step.
  bool ok() const { return failures.empty(); }
};

class EMMY_EXPORT BodyBatch {
 public:
  // `model` must outlive the batch. Fails with kInvalidArgument, naming the
  // option, if one is out of range or if the model has anything but free
  // bodies.
  static absl::StatusOr<BodyBatch> Create(const Model& model,
                                          const BodyBatchOptions& options);
  // Moves the bodies; the batch moved from may only be assigned to or
  // destroyed.
  BodyBatch(BodyBatch&&) noexcept;
  // The same.
  BodyBatch& operator=(BodyBatch&&) noexcept;
  ~BodyBatch();

  // Takes over a state of the model (EMMY_CHECK: of its size); bodies that had
  // failed take part again.
  void Load(const State& state);

  // Advances all bodies. Each is done with all steps before the next is begun,
  // so that many steps in a call cost less than many calls. A body that fails
  // is left where it is and reported once; the others go on. EMMY_CHECK: a
  // state is loaded, and num_steps is not negative.
  BatchReport Step(int64_t num_steps);

  // Writes the state of all bodies, time and step number, of the state that
  // was loaded or one of the same model. Differences by which a step's start is
  // predicted (EXTRA-1) are zero where a batch keeps none, from order two on
  // for ANCF bodies.
  void Store(State* state) const;

 private:
  struct Data;

  explicit BodyBatch(std::unique_ptr<Data> data);

  std::unique_ptr<Data> data_;
};

}  // namespace emmy

#endif  // EMMY_INTEGRATE_BODY_BATCH_H_
