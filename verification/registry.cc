#include "verification/registry.h"

#include <mutex>

#include "verification/claims/groups.h"
#include "verification/parallel.h"

namespace emmy::verification {

const std::vector<Claim>& AllClaims() {
  static const std::vector<Claim>* const claims = [] {
    auto* all = new std::vector<Claim>;
    for (const auto& group :
         {KinematicsClaims, LawClaims, ConservationClaims, SymmetryClaims,
          VibrationClaims, AgreementClaims, GrowthClaims, LargeStepClaims,
          PenaltyClaims, AngularVelocityClaims, OrderClaims, CompositionClaims,
          ExternalClaims, ExternalStructureClaims, StructureClaims,
          ConventionalJointClaims, BaselineClaims, FigureClaims}) {
      for (Claim& claim : group()) all->push_back(std::move(claim));
    }
    return all;
  }();
  return *claims;
}

const Claim* FindClaim(std::string_view id) {
  for (const Claim& claim : AllClaims()) {
    if (claim.id == id) return &claim;
  }
  return nullptr;
}

std::vector<Outcome> RunClaims(
    const std::vector<const Claim*>& claims, const ClaimSetting& setting,
    int num_threads, const std::function<void(const Outcome&)>& finished) {
  std::vector<Outcome> outcomes(claims.size());
  std::mutex mutex;
  ForEachInParallel(claims.size(), num_threads, [&](size_t i) {
    outcomes[i] = RunClaim(*claims[i], setting);
    if (finished) {
      const std::lock_guard<std::mutex> lock(mutex);
      finished(outcomes[i]);
    }
  });
  return outcomes;
}

}  // namespace emmy::verification
