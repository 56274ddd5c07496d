// How round-off grows with the number of steps: like a random walk.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "absl/strings/str_format.h"
#include "emmy/diagnostics/invariants.h"
#include "verification/claims/groups.h"
#include "verification/runs/fit.h"
#include "verification/runs/paper_box.h"
#include "verification/runs/run.h"

namespace emmy::verification {
namespace {

constexpr double kPercentile = 0.9;

// Numbers of steps at which the errors are read: 10³, 10^3.5, …
std::vector<int64_t> Readings(Level level) {
  std::vector<int64_t> steps;
  const int last = level == Level::kFull ? 6 : 5;
  for (int half = 2 * 3; half <= 2 * last; ++half) {
    steps.push_back(std::llround(std::pow(10.0, 0.5 * half)));
  }
  return steps;
}

// The same start, shifted by `member` units in the last place.
ModelDescription Shifted(ModelDescription model, int member) {
  Vector3d& omega = model.rigid_bodies[0].angular_velocity;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < member; ++k) {
      omega(i) = std::nextafter(omega(i), 2.0);
    }
  }
  return model;
}

struct Growth {
  std::vector<double> steps;
  // One row a reading, one entry a member; relative errors there.
  std::vector<std::vector<double>> energy;
  std::vector<std::vector<double>> angular_momentum;
};

absl::Status AddMember(const ModelDescription& description,
                       const Scheme& scheme, Growth* growth) {
  absl::StatusOr<Run> run = Run::Start(description, kPaperTimeStep, scheme);
  if (!run.ok()) return run.status();
  const Invariants start = MeasureInvariants(run->model(), run->state());
  const double energy = start.TotalEnergy().ToDouble();
  const double momentum = Norm(start.angular_momentum).ToDouble();
  for (size_t i = 0; i < growth->steps.size(); ++i) {
    const auto target = static_cast<int64_t>(growth->steps[i]);
    absl::Status status = run->Advance(target - run->state().step);
    if (!status.ok()) return status;
    const Invariants now = MeasureInvariants(run->model(), run->state());
    growth->energy[i].push_back(
        std::abs((now.TotalEnergy() - start.TotalEnergy()).ToDouble()) /
        energy);
    growth->angular_momentum[i].push_back(
        Norm(now.angular_momentum - start.angular_momentum).ToDouble() /
        momentum);
  }
  return absl::OkStatus();
}

std::vector<double> Percentiles(
    const std::vector<std::vector<double>>& readings) {
  std::vector<double> percentiles;
  for (const std::vector<double>& reading : readings) {
    percentiles.push_back(Percentile(reading, kPercentile));
  }
  return percentiles;
}

// `energy_walks`: whether the energy is rounded to doubles and so walks at
// random. The conventional body's depends on its angular velocity alone, which
// is a pair of doubles: see conservation/conventional_energy.
absl::StatusOr<ClaimResult> Measure(const ClaimSetting& setting,
                                    const ModelDescription& description,
                                    const std::string& name,
                                    bool energy_walks) {
  const int members = IsFull(setting) ? 64 : 32;
  Growth growth;
  for (const int64_t steps : Readings(setting.level)) {
    growth.steps.push_back(static_cast<double>(steps));
  }
  growth.energy.resize(growth.steps.size());
  growth.angular_momentum.resize(growth.steps.size());
  for (int member = 0; member < members; ++member) {
    const absl::Status status =
        AddMember(Shifted(description, member), setting.scheme, &growth);
    if (!status.ok()) return status;
  }
  const std::vector<double> energy = Percentiles(growth.energy);
  const std::vector<double> momentum = Percentiles(growth.angular_momentum);
  ClaimResult result;
  if (energy_walks) {
    result.values.push_back({"energy", FitPower(growth.steps, energy)});
  }
  result.values.push_back(
      {"angular momentum", FitPower(growth.steps, momentum)});
  result.notes.push_back(absl::StrFormat(
      "%d starts, %g to %g steps; 90th percentiles at the end: energy %.2g, "
      "angular momentum %.2g",
      members, growth.steps.front(), growth.steps.back(), energy.back(),
      momentum.back()));
  result.figures.push_back(
      {.name = "growth_" + name,
       .title = "Growth of round-off, " + name + " body",
       .columns = {{"steps", growth.steps},
                   {"energy error 90th percentile", energy},
                   {"angular momentum error 90th percentile", momentum}},
       .script = R"(set xlabel 'Number of steps'
set ylabel 'Relative error, 90th percentile'
set key top left
root(x) = 1e-19 * sqrt(x)
linear(x) = 1e-21 * x
plot data using 1:2 with linespoints lt 1 title 'Energy', \
     data using 1:3 with linespoints lt 4 title 'Angular momentum', \
     root(x) with lines lt 7 dt 2 lw 1.5 title 'Slope 1/2 (random walk)', \
     linear(x) with lines lt 7 dt 4 lw 1.5 title 'Slope 1 (bias)'
)",
       .powers_of_ten = true});
  return result;
}

Claim GrowthClaim(const std::string& name, ModelDescription description,
                  const std::string& equations, bool energy_walks) {
  return {.id = "growth/" + name + "_body",
          .sentence = "Round-off of the " + name + " body's " +
                      (energy_walks ? "energy and " : "") +
                      "angular momentum grows like a random walk: no rounding "
                      "is biased.",
          .equations = equations,
          .reference = Reference::kExact,
          .metric =
              "p of 90th percentile of |error after N steps| = C N^p, "
              "starts shifted by ulps",
          .unit = "-",
          .bound = {.lower = 0.35,
                    .upper = 0.65,
                    .derivation =
                        "independent roundings add like a random walk, p = "
                        "1/2 (Brouwer's law), biased ones give p = 1. A 90th "
                        "percentile of 32 values scatters by 15 %, which "
                        "moves the fit over two decades by 0.05: the limits "
                        "are three of these"},
          .measure = [name, description = std::move(description),
                      energy_walks](const ClaimSetting& setting) {
            return Measure(setting, description, name, energy_walks);
          }};
}

}  // namespace

std::vector<Claim> GrowthClaims() {
  std::vector<Claim> claims;
  claims.push_back(
      GrowthClaim("ancf", PaperBoxAncf(1e10), "(SUM-2), (EM-1..5)", true));
  claims.push_back(GrowthClaim("conventional", PaperBoxConventional(),
                               "(SUM-2), (CRB-3..5)", false));
  return claims;
}

}  // namespace emmy::verification
