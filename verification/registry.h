// All claims, and how a selection of them is run.

#ifndef EMMY_VERIFICATION_REGISTRY_H_
#define EMMY_VERIFICATION_REGISTRY_H_

#include <functional>
#include <string_view>
#include <vector>

#include "verification/claim.h"

namespace emmy::verification {

// In the order in which they are printed; ids are unique. A new claim is
// added to the list of its group, a new group to registry.cc.
const std::vector<Claim>& AllClaims();

// Null if there is none.
const Claim* FindClaim(std::string_view id);

// Runs the claims on `num_threads` threads; outcomes are in the order of
// `claims` and do not depend on the number of threads. `finished` is called
// after each, from any thread but never from two at once; may be empty.
std::vector<Outcome> RunClaims(
    const std::vector<const Claim*>& claims, const ClaimSetting& setting,
    int num_threads, const std::function<void(const Outcome&)>& finished);

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_REGISTRY_H_
