#pragma once

#include <span>
#include <string>
#include <vector>

#include "planner/certificate/force_proof.h"
#include "planner/motion/motion_segment.h"
#include "planner/plan/json_reader.h"
#include "planner/plan/plan.h"

namespace regrasp::certificate {

/// Proofs for the first `entries` entries of a plan, the hold of the initial grasp included. The
/// plan's own certificates are taken where they hold.
/// @param located  its contacts placed on the object (LocatePlan). @param half_angle  radians.
[[nodiscard]] std::vector<EntryProof> FindPlanProofs(const plan::Plan& located, double half_angle,
                                                     int entries);

/// What exact arithmetic says of the proofs of one entry.
struct EntryVerdict {
  plan::EntryIndex index{0};
  std::string kind;  ///< "hold", or as StepKind
  motion::ProofVerdict rest;
  std::vector<motion::ProofVerdict> motions;

  /// The grasp and all motions are proved.
  [[nodiscard]] bool proved() const;
};

/// Checks proofs against the plan, in order from the hold.
/// @throws std::invalid_argument  more proofs than the plan has entries.
[[nodiscard]] std::vector<EntryVerdict> CheckPlanProofs(const plan::Plan& located, double mu,
                                                        std::span<const EntryProof> proofs);

[[nodiscard]] Json EntryProofJson(const EntryProof& proof, int dimension);
/// @throws InputError
[[nodiscard]] EntryProof ReadEntryProof(const plan::JsonReader& json, int dimension);

}  // namespace regrasp::certificate
