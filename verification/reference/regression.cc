#include "verification/reference/regression.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "emmy/base/build_info.h"
#include "emmy/diagnostics/invariants.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

constexpr int kSteps = 2000;
constexpr int kEvery = 100;
constexpr double kPenalty = 1e10;  // [Pa]

// Fills one row, and at the first also the columns.
class Row {
 public:
  Row(ReferenceTable* table, bool first) : table_(table), first_(first) {}
  ~Row() { table_->rows.push_back(std::move(values_)); }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  void Add(const std::string& name, const std::string& unit, double value) {
    if (first_) table_->columns.push_back({name, unit, 0.0});
    values_.push_back(value);
  }

  template <typename Derived>
  void Add(const std::string& name, const std::string& unit,
           const Eigen::MatrixBase<Derived>& vector) {
    for (Eigen::Index i = 0; i < vector.size(); ++i) {
      Add(absl::StrCat(name, "_", i + 1), unit, vector(i));
    }
  }

 private:
  ReferenceTable* table_;
  bool first_;
  std::vector<double> values_;
};

void AddRow(const Run& run, ReferenceTable* table) {
  const bool first = table->columns.empty();
  Row row(table, first);
  const State& state = run.state();
  const bool ancf = run.model().bodies()[0].ancf() != nullptr;
  row.Add("step", "-", static_cast<double>(state.step));
  row.Add("time", "s", state.time.value);
  row.Add("position", "m", state.position.value.head<3>());
  row.Add(ancf ? "gradient" : "quaternion", "-",
          state.position.value.tail(state.position.value.size() - 3));
  row.Add("velocity", "m/s", state.velocity.value.head<3>());
  row.Add(ancf ? "gradient_rate" : "body_omega", ancf ? "1/s" : "rad/s",
          state.velocity.value.tail(state.velocity.value.size() - 3));
  row.Add("strain", "-", state.strain.value);
  const BodyMotion motion = run.Motion();
  row.Add("attitude", "-", motion.quaternion);
  row.Add("omega_locked", "rad/s", motion.omega_locked);
  row.Add("omega_polar", "rad/s", motion.omega_polar);
  row.Add("omega_polar_exact", "rad/s", motion.omega_polar_exact);
  const Invariants invariants = MeasureInvariants(run.model(), state);
  row.Add("kinetic_energy", "J", invariants.kinetic_energy.ToDouble());
  row.Add("penalty_energy", "J", invariants.penalty_energy.ToDouble());
  row.Add("angular_momentum", "kg m^2/s",
          invariants.angular_momentum.ToDouble());
}

absl::StatusOr<ReferenceTable> Compute(const std::string& name,
                                       const std::string& body,
                                       const ModelDescription& description,
                                       const Scheme& scheme) {
  absl::StatusOr<Run> run = Run::Start(description, kPaperTimeStep, scheme);
  if (!run.ok()) return run.status();
  const BuildInfo build = GetBuildInfo();
  ReferenceTable table;
  table.name = name;
  table.kind = "regression";
  table.source = absl::StrFormat(
      "the box of the paper's section 5.1 as %s, %d steps of %g s, every %d",
      body, kSteps, kPaperTimeStep, kEvery);
  table.command = "emmy regenerate --only " + name;
  table.version = build.version;
  table.compiler = build.compiler;
  AddRow(*run, &table);
  for (int i = 0; i < kSteps / kEvery; ++i) {
    const absl::Status status = run->Advance(kEvery);
    if (!status.ok()) return status;
    AddRow(*run, &table);
  }
  return table;
}

RegressionRun Describe(const std::string& name, const std::string& body,
                       ModelDescription description) {
  return {.name = name,
          .compute = [name, body, description = std::move(description)](
                         const Scheme& scheme) {
            return Compute(name, body, description, scheme);
          }};
}

}  // namespace

const std::vector<RegressionRun>& RegressionRuns() {
  static const std::vector<RegressionRun>* const runs =
      new std::vector<RegressionRun>{
          Describe("paper_box_ancf",
                   absl::StrFormat("an ANCF body, %s, started undeformed",
                                   PenaltyLabel(kPenalty)),
                   PaperBoxAncf(kPenalty)),
          Describe("paper_box_ancf_relaxed",
                   absl::StrFormat("an ANCF body, %s, started relaxed",
                                   PenaltyLabel(kPenalty)),
                   PaperBoxAncf(kPenalty, Start::kRelaxed)),
          Describe("paper_box_conventional", "a conventional body",
                   PaperBoxConventional())};
  return *runs;
}

std::string RegressionPath(const std::string& root, const std::string& name) {
  return absl::StrCat(root, "/reference_data/regression/", name, ".json");
}

}  // namespace emmy::verification
