// Any bytes as a case: read, built and stepped, or refused with a message.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "absl/strings/string_view.h"
#include "emmy/base/check.h"
#include "emmy/integrate/energy_momentum.h"
#include "emmy/io/case_file.h"
#include "emmy/io/case_writer.h"
#include "emmy/model/validation.h"

namespace emmy {
namespace {

// Beyond this a step takes too long to be tried in great numbers.
bool IsSmall(const ModelDescription& model) {
  constexpr size_t kMost = 24;
  return model.rigid_bodies.size() + model.nodes.size() + model.trusses.size() +
             model.springs.size() + model.shared_points.size() +
             model.loads.size() <=
         kMost;
}

// A message is one line of text that has something to say.
void CheckMessage(const absl::Status& status) {
  const absl::string_view message = status.message();
  EMMY_CHECK(!message.empty(), "no message");
  EMMY_CHECK(IsPrintable(std::string(message)),
             "control character in: " << std::string(message));
}

void Try(absl::string_view text) {
  const absl::StatusOr<Case> value = ParseCase(text);
  if (!value.ok()) return CheckMessage(value.status());
  const std::string written = WriteCase(*value);
  const absl::StatusOr<Case> again = ParseCase(written);
  EMMY_CHECK(again.ok() && WriteCase(*again) == written, written);
  if (!IsSmall(value->model)) return;
  absl::StatusOr<BuiltModel> built = BuildModel(value->model);
  if (!built.ok()) return CheckMessage(built.status());
  if (!IsFinite(MeasureInvariants(built->model, built->state))) return;
  absl::StatusOr<EnergyMomentumIntegrator> integrator =
      EnergyMomentumIntegrator::Create(built->model,
                                       OptionsOf(value->integrator));
  if (!integrator.ok()) return CheckMessage(integrator.status());
  const StepReport report = integrator->Step(built->state);
  EMMY_CHECK(report.ok() == report.message.empty(), report.message);
  if (report.ok()) {
    EMMY_CHECK(built->state.position.value.allFinite() &&
                   built->state.velocity.value.allFinite() &&
                   built->state.strain.value.allFinite(),
               "accepted a step that is not finite");
  }
}

}  // namespace
}  // namespace emmy

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(data, data + size);
  emmy::Try(text);
  return 0;
}
