#include "emmy/integrate/body_batch.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/base/check.h"
#include "emmy/base/work_team.h"
#include "emmy/integrate/ancf_body_step.h"
#include "emmy/integrate/batch_blocks.h"
#include "emmy/integrate/batch_kernels.h"
#include "emmy/integrate/batch_lanes.h"
#include "emmy/integrate/conventional_body_step.h"
#include "emmy/integrate/failure_text.h"
#include "emmy/model/state_size.h"

namespace emmy {
namespace {

bool IsDiagonal(const Matrix3d& m) {
  const Matrix3d diagonal = m.diagonal().asDiagonal();
  return m == diagonal;
}

// Bodies of one kind, kBatchLanes to a block; the lanes left over are not
// alive.
template <typename Block>
struct Group {
  bool principal = true;  // Else the ordinary step takes all steps.
  std::vector<size_t> bodies;
  std::vector<Block> blocks;
  std::atomic<size_t> taken = 0;  // Blocks that a thread has begun.

  Block& BlockOf(size_t i) {
    return blocks[i / static_cast<size_t>(kBatchLanes)];
  }
  const Block& BlockOf(size_t i) const {
    return blocks[i / static_cast<size_t>(kBatchLanes)];
  }
  static int LaneOf(size_t i) {
    return static_cast<int>(i % static_cast<size_t>(kBatchLanes));
  }
};

// What one thread did.
struct Work {
  int64_t iterations = 0;
  int64_t ordinary_steps = 0;
  std::vector<std::pair<size_t, BatchFailure>> failures;  // By body.
};

}  // namespace

struct BodyBatch::Data {
  const Model* model = nullptr;
  BodyBatchOptions options;
  BatchStep step;
  std::unique_ptr<WorkTeam> team;
  bool is_loaded = false;
  int64_t step_number = 0;
  CompensatedDouble time;
  Group<AncfBlock> ancf;
  Group<AncfBlock> tilted_ancf;
  Group<ConventionalBlock> conventional;
  Group<ConventionalBlock> tilted_conventional;
  // By body; made for those that need one, when they do.
  std::vector<std::unique_ptr<const AncfBodyStep>> ancf_steps;

  NewtonOptions newton() const {
    return {.tolerance = std::nullopt,
            .max_iterations = options.max_iterations};
  }

  template <typename Function>
  void ForEachGroup(const Function& function) {
    function(ancf);
    function(tilted_ancf);
    function(conventional);
    function(tilted_conventional);
  }

  void AddConstants(const ModelBody& body, int lane, AncfBlock* block) const {
    SetConstants(*body.ancf(), options.time_step, lane, block);
  }
  void AddConstants(const ModelBody& body, int lane,
                    ConventionalBlock* block) const {
    SetConstants(*body.conventional(), options.time_step, lane, block);
  }

  BodyStepResult Ordinary(size_t body, int lane, AncfBlock* block) {
    std::unique_ptr<const AncfBodyStep>& body_step = ancf_steps[body];
    if (body_step == nullptr) {
      body_step = std::make_unique<const AncfBodyStep>(
          *model->bodies()[body].ancf(), options.time_step, newton());
    }
    return TakeOrdinaryStep(*body_step, step, lane, block);
  }
  BodyStepResult Ordinary(size_t body, int lane, ConventionalBlock* block) {
    const ConventionalBodyStep body_step(*model->bodies()[body].conventional(),
                                         options.time_step, newton());
    return TakeOrdinaryStep(body_step, step, lane, block);
  }

  BatchFailure Failure(size_t body, int64_t failed_step,
                       const BodyStepResult& result) const {
    const std::string& name = model->bodies()[body].name;
    return {.body = name,
            .step = failed_step,
            .termination = result.termination,
            .message = absl::StrFormat(
                "step %d of body \"%s\": %s (time step %g s, %d iterations, "
                "last correction %.3g); the body stays as after its last good "
                "step; a smaller time step may help",
                failed_step, name, FailureText(result.termination),
                options.time_step, result.iterations, result.correction)};
  }

  template <typename Block>
  void RunBlock(int64_t num_steps, size_t index, const Block* next,
                Group<Block>* group, Work* work);
  template <typename Block>
  void Run(int64_t num_steps, Group<Block>* group, Work* work);
};

namespace {

// The ordinary step for lanes of one block.
template <typename Data, typename Block>
class OrdinaryStep : public LaneFallback {
 public:
  OrdinaryStep(Data* data, const size_t* bodies, Block* block, Work* work)
      : data_(data), bodies_(bodies), block_(block), work_(work) {}

  void TakeStep(int64_t step, int lane) override {
    const size_t body = bodies_[lane];
    const BodyStepResult result = data_->Ordinary(body, lane, block_);
    ++work_->ordinary_steps;
    if (result.termination == Termination::kConverged) return;
    block_->centre.alive[lane] = 0.0;
    work_->failures.emplace_back(
        body, data_->Failure(body, data_->step_number + step + 1, result));
  }

 private:
  Data* data_;
  const size_t* bodies_;  // Of the block's lanes.
  Block* block_;
  Work* work_;
};

}  // namespace

template <typename Block>
void BodyBatch::Data::RunBlock(int64_t num_steps, size_t index,
                               const Block* next, Group<Block>* group,
                               Work* work) {
  const size_t first = index * static_cast<size_t>(kBatchLanes);
  Block& block = group->blocks[index];
  OrdinaryStep<Data, Block> fallback(this, group->bodies.data() + first, &block,
                                     work);
  if (group->principal) {
    AdvanceBlock(step, num_steps, &block, next, &fallback);
  } else {
    for (int64_t j = 0; j < num_steps; ++j) {
      for (int lane = 0; lane < kBatchLanes; ++lane) {
        if (block.centre.alive[lane] != 0.0) fallback.TakeStep(j, lane);
      }
    }
  }
  for (size_t i = first; i < std::min(first + static_cast<size_t>(kBatchLanes),
                                      group->bodies.size());
       ++i) {
    double& iterations = block.centre.iterations[group->LaneOf(i)];
    work->iterations += static_cast<int64_t>(iterations);
    iterations = 0.0;
  }
}

// Takes some blocks after the other until all are taken: no thread waits long
// for a slower one.
template <typename Block>
void BodyBatch::Data::Run(int64_t num_steps, Group<Block>* group, Work* work) {
  constexpr size_t kMostAtATime = 16;
  const size_t num_blocks = group->blocks.size();
  // Several portions a thread, also where there are few blocks.
  const size_t portion =
      std::clamp<size_t>(num_blocks / (4 * team->size()), 1, kMostAtATime);
  while (true) {
    const size_t first = group->taken.fetch_add(portion);
    if (first >= num_blocks) return;
    const size_t end = std::min(first + portion, num_blocks);
    for (size_t i = first; i < end; ++i) {
      RunBlock(num_steps, i, i + 1 < end ? &group->blocks[i + 1] : nullptr,
               group, work);
    }
  }
}

BodyBatch::BodyBatch(std::unique_ptr<Data> data) : data_(std::move(data)) {}
BodyBatch::BodyBatch(BodyBatch&&) noexcept = default;
BodyBatch& BodyBatch::operator=(BodyBatch&&) noexcept = default;
BodyBatch::~BodyBatch() = default;

absl::StatusOr<BodyBatch> BodyBatch::Create(const Model& model,
                                            const BodyBatchOptions& options) {
  if (!std::isfinite(options.time_step) || options.time_step == 0.0) {
    return absl::InvalidArgumentError(
        absl::StrCat("time_step: must be a finite number other than 0 [s], "
                     "got ",
                     options.time_step));
  }
  if (options.max_iterations < 1) {
    return absl::InvalidArgumentError(absl::StrCat(
        "max_iterations: must be at least 1, got ", options.max_iterations));
  }
  if (options.num_threads < 1) {
    return absl::InvalidArgumentError(absl::StrCat(
        "num_threads: must be at least 1, got ", options.num_threads));
  }
  if (!model.nodes().empty() || !model.lines().empty() ||
      !model.constraints().empty() || !model.joints().empty() ||
      !model.forces().empty() || !model.torques().empty()) {
    return absl::InvalidArgumentError(
        "model: a batch takes free rigid bodies alone, without nodes, "
        "elements, shared points or loads other than gravity");
  }
  auto data = std::make_unique<Data>();
  data->model = &model;
  data->options = options;
  data->team =
      std::make_unique<WorkTeam>(static_cast<size_t>(options.num_threads));
  data->step.time_step = options.time_step;
  data->step.inverse_time_step = 1.0 / options.time_step;
  for (int i = 0; i < 3; ++i) {
    data->step.velocity_increment[i] = options.time_step * model.gravity()(i);
  }
  data->step.has_gravity = model.gravity() != Vector3d::Zero();
  data->tilted_ancf.principal = false;
  data->tilted_conventional.principal = false;
  data->ancf_steps.resize(model.bodies().size());
  for (size_t i = 0; i < model.bodies().size(); ++i) {
    const ModelBody& body = model.bodies()[i];
    const bool principal = IsDiagonal(body.inertia().tensor) &&
                           IsDiagonal(body.inertia().second_moment);
    if (body.ancf() != nullptr) {
      (principal ? data->ancf : data->tilted_ancf).bodies.push_back(i);
    } else {
      (principal ? data->conventional : data->tilted_conventional)
          .bodies.push_back(i);
    }
  }
  return BodyBatch(std::move(data));
}

void BodyBatch::Load(const State& state) {
  EMMY_CHECK(data_ != nullptr, "a batch that was moved from");
  Data& data = *data_;
  const Model& model = *data.model;
  EMMY_CHECK(SizeOf(state) == SizeOf(model), "a state of " << SizeOf(state)
                                                           << " for a model of "
                                                           << SizeOf(model));
  data.step_number = state.step;
  data.time = state.time;
  data.is_loaded = true;
  data.ForEachGroup([&](auto& group) {
    using Block = typename std::decay_t<decltype(group.blocks)>::value_type;
    const auto lanes = static_cast<size_t>(kBatchLanes);
    const size_t num_bodies = group.bodies.size();
    group.blocks.assign((num_bodies + lanes - 1) / lanes, Block{});
    for (size_t i = 0; i < group.blocks.size() * lanes; ++i) {
      // Lanes left over calculate too: with numbers that do no harm.
      const size_t source = std::min(i, num_bodies - 1);
      const ModelBody& body = model.bodies()[group.bodies[source]];
      Block& block = group.BlockOf(i);
      const int lane = group.LaneOf(i);
      data.AddConstants(body, lane, &block);
      LoadLane(body, state, lane, &block);
      if (i >= num_bodies) block.centre.alive[lane] = 0.0;
    }
  });
}

BatchReport BodyBatch::Step(int64_t num_steps) {
  EMMY_CHECK(data_ != nullptr, "a batch that was moved from");
  Data& data = *data_;
  EMMY_CHECK(data.is_loaded, "Load before Step");
  EMMY_CHECK(num_steps >= 0, num_steps);
  data.ForEachGroup([](auto& group) { group.taken = 0; });
  std::vector<Work> work(data.team->size());
  data.team->Run(
      work.size(), [&](size_t member, size_t /*first*/, size_t /*last*/) {
        data.ForEachGroup(
            [&](auto& group) { data.Run(num_steps, &group, &work[member]); });
      });

  data.step_number += num_steps;
  for (int64_t i = 0; i < num_steps; ++i) data.time.Add(data.options.time_step);
  BatchReport report;
  std::vector<std::pair<size_t, BatchFailure>> failures;
  for (Work& part : work) {
    report.iterations += part.iterations;
    report.ordinary_steps += part.ordinary_steps;
    for (auto& failure : part.failures) failures.push_back(std::move(failure));
  }
  std::sort(failures.begin(), failures.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [body, failure] : failures) {
    report.failures.push_back(std::move(failure));
  }
  return report;
}

void BodyBatch::Store(State* state) const {
  EMMY_CHECK(data_ != nullptr, "a batch that was moved from");
  Data& data = *data_;
  EMMY_CHECK(data.is_loaded, "Load before Store");
  EMMY_CHECK(SizeOf(*state) == SizeOf(*data.model),
             "a state of " << SizeOf(*state) << " for a model of "
                           << SizeOf(*data.model));
  state->step = data.step_number;
  state->time = data.time;
  data.ForEachGroup([&](auto& group) {
    for (size_t i = 0; i < group.bodies.size(); ++i) {
      StoreLane(group.BlockOf(i), group.LaneOf(i),
                data.model->bodies()[group.bodies[i]], state);
    }
  });
}

}  // namespace emmy
