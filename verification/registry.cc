#include "verification/registry.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>

#include "verification/claims/groups.h"

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
  std::atomic<size_t> next = 0;
  std::mutex mutex;
  const auto work = [&] {
    for (size_t i = next++; i < claims.size(); i = next++) {
      outcomes[i] = RunClaim(*claims[i], setting);
      if (finished) {
        const std::lock_guard<std::mutex> lock(mutex);
        finished(outcomes[i]);
      }
    }
  };
  std::vector<std::thread> threads;
  for (int i = 1; i < num_threads; ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  return outcomes;
}

}  // namespace emmy::verification
