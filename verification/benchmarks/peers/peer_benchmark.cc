// The same cases by Emmy, by a plain Runge-Kutta method and by the engines
// found when this was configured: peers/CASE/WHO. The errors are the largest
// over a run of fixed length before the time is taken; `label` says how an
// engine is set.

#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "verification/benchmarks/peers/peer_system.h"
#include "verification/models/large_models.h"
#include "verification/runs/paper_box.h"

namespace emmy::verification {
namespace {

constexpr double kPenalty = 1e10;  // [Pa]
constexpr double kKept = 1e-15;    // As in the claims; Emmy's rows only.
constexpr double kAnything = 1e300;

using Maker = std::function<std::unique_ptr<PeerSystem>()>;

// How long the errors are looked at.
struct Look {
  int steps = 0;
  int every = 0;  // Steps between two looks.
};
constexpr Look kTenSeconds = {.steps = 10000, .every = 10};
constexpr Look kOneSecond = {.steps = 1000, .every = 20};

struct Checked {
  std::unique_ptr<PeerSystem> system;  // At the end of the run.
  std::string error;
};

Checked Check(const Maker& make, const Look& look, double bound) {
  Checked checked;
  checked.system = make();
  PeerSystem& system = *checked.system;
  system.Observe();
  for (int step = 1; step <= look.steps; ++step) {
    checked.error = system.Step();
    if (!checked.error.empty()) return checked;
    if (step % look.every == 0) system.Observe();
  }
  const LawErrors errors = system.Errors();
  // Written so that NaN fails.
  if (!(errors.energy <= bound) || !(errors.angular_momentum <= bound)) {
    checked.error =
        absl::StrCat("energy error ", errors.energy,
                     ", angular momentum error ", errors.angular_momentum);
  }
  return checked;
}

void Time(benchmark::State& state, const std::string& name, const Maker& make,
          const Look& look, double bound) {
  // Repetitions go on with the run that was looked at.
  static auto* const runs = new std::map<std::string, Checked>;
  auto run = runs->find(name);
  if (run == runs->end()) {
    runs->clear();  // One case in memory, and in the caches, at a time.
    run = runs->emplace(name, Check(make, look, bound)).first;
  }
  Checked& checked = run->second;
  for (auto _ : state) {
    if (checked.error.empty()) checked.error = checked.system->Step();
    if (checked.error.empty()) continue;
    state.SkipWithError(checked.error.c_str());
    break;
  }
  const LawErrors errors = checked.system->Errors();
  state.counters["energy_error"] = errors.energy;
  state.counters["angular_momentum_error"] = errors.angular_momentum;
  state.SetLabel(checked.system->Settings());
}

void Add(const std::string& name, const Look& look, const Maker& make,
         double bound = kAnything) {
  benchmark::RegisterBenchmark(
      absl::StrCat("peers/", name).c_str(),
      [=](benchmark::State& state) { Time(state, name, make, look, bound); })
      ->Unit(benchmark::kMicrosecond);
}

void AddEmmy(const std::string& name, const Look& look,
             const std::function<ModelDescription()>& describe) {
  Add(
      name, look, [=] { return MakeEmmy(describe()); }, kKept);
}

// The engines with this case; `iterative` chooses ODE's solver. Simbody's
// steps are shorter by `substeps`, 0 to leave it out.
void AddEngines(const std::string& name, const Look& look,
                const std::function<PeerCase()>& make, OdeStepper stepper,
                int substeps) {
#ifdef EMMY_PEER_BULLET
  if (make().springs.empty()) {
    Add(absl::StrCat(name, "/bullet"), look,
        [=] { return MakeBullet(make(), 10); });
  }
#endif
#ifdef EMMY_PEER_ODE
  Add(absl::StrCat(name, "/ode"), look,
      [=] { return MakeOde(make(), stepper); });
#endif
#ifdef EMMY_PEER_SIMBODY
  Add(absl::StrCat(name, "/simbody"), look,
      [=] { return MakeSimbody(make(), substeps); });
#endif
  // Without engines nothing above is compiled.
  static_cast<void>(look);
  static_cast<void>(make);
  static_cast<void>(stepper);
  static_cast<void>(substeps);
}

void AddAll() {
  AddEmmy("box/emmy_ancf", kTenSeconds,
          [] { return PaperBoxAncf(kPenalty, Start::kRelaxed); });
  AddEmmy("box/emmy_conventional", kTenSeconds, PaperBoxConventional);
  Add("box/runge_kutta", kTenSeconds, MakeRungeKutta);
  AddEngines("box", kTenSeconds, PeerBox, OdeStepper::kDirect, 1);

  AddEmmy("bar/emmy_ancf", kTenSeconds,
          [] { return PaperTrussAncf(kPenalty); });
  AddEmmy("bar/emmy_conventional", kTenSeconds, PaperTrussConventional);
  // Explicit steps of 1 ms would blow the spring's 9000 rad/s up.
  AddEngines("bar/spring", kTenSeconds, PeerBoxWithSpring, OdeStepper::kDirect,
             10);
  AddEngines("bar/rigid", kTenSeconds, PeerBoxWithRigidBar, OdeStepper::kDirect,
             1);

  for (const auto& [name, formulation] :
       {std::pair("emmy_ancf", Formulation::kAncf),
        std::pair("emmy_conventional", Formulation::kConventional)}) {
    const Maker make = [which = formulation] {
      return MakeEmmyBatch(FreeBoxes(1000, which));
    };
    Add(absl::StrCat("free_boxes:1000/", name), kOneSecond, make, kKept);
  }
  AddEngines(
      "free_boxes:1000", kOneSecond, [] { return PeerFreeBoxes(1000); },
      OdeStepper::kIterative, 1);

  for (const int n : {100, 1000}) {
    const std::string chain = absl::StrCat("chain:", n);
    AddEmmy(absl::StrCat(chain, "/emmy_ancf"), kOneSecond,
            [n] { return BoxChain(n).model; });
    AddEngines(
        chain, kOneSecond, [n] { return PeerChain(n); }, OdeStepper::kIterative,
        1);
  }
}

[[maybe_unused]] const bool kAdded = (AddAll(), true);

}  // namespace
}  // namespace emmy::verification
