// The groups of claims; one file each.

#ifndef EMMY_VERIFICATION_CLAIMS_GROUPS_H_
#define EMMY_VERIFICATION_CLAIMS_GROUPS_H_

#include <vector>

#include "verification/claim.h"

namespace emmy::verification {

std::vector<Claim> KinematicsClaims();       // kinematics.cc
std::vector<Claim> LawClaims();              // laws.cc
std::vector<Claim> SymmetryClaims();         // symmetry.cc
std::vector<Claim> VibrationClaims();        // vibration.cc
std::vector<Claim> AgreementClaims();        // agreement.cc
std::vector<Claim> ConservationClaims();     // conservation.cc
std::vector<Claim> GrowthClaims();           // growth.cc
std::vector<Claim> LargeStepClaims();        // large_steps.cc
std::vector<Claim> PenaltyClaims();          // penalty.cc
std::vector<Claim> AngularVelocityClaims();  // angular_velocity.cc
std::vector<Claim> OrderClaims();            // order.cc
std::vector<Claim> CompositionClaims();      // composition.cc
std::vector<Claim> ExternalClaims();         // external.cc
// external_structures.cc
std::vector<Claim> ExternalStructureClaims();
std::vector<Claim> StructureClaims();  // structures.cc
// conventional_joints.cc
std::vector<Claim> ConventionalJointClaims();
std::vector<Claim> BaselineClaims();  // baselines.cc
std::vector<Claim> FigureClaims();    // figures.cc

}  // namespace emmy::verification

#endif  // EMMY_VERIFICATION_CLAIMS_GROUPS_H_
