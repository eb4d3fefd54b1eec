#pragma once

#include <span>
#include <string>
#include <vector>

#include "planner/certificate/force_proof.h"
#include "planner/motion/motion_segment.h"
#include "planner/plan/json_reader.h"
#include "planner/plan/plan.h"

namespace regrasp::certificate {

/// Find proofs of the first `entries` entries of a plan.
/// The first entry is the hold of the initial grasp.
/// Valid certificates of the plan are reused.
/// @param located  plan with contacts placed on the object (ProjectPlan).
/// @param friction_angle  friction angle, radians.
[[nodiscard]] std::vector<EntryProof> FindPlanProofs(const plan::Plan& projected,
                                                     double friction_angle, int entries);

/// Result of the exact check of one entry's proofs.
struct EntryVerdict {
  plan::EntryIndex index{0};
  std::string kind;  ///< "hold", or as StepKind
  motion::ProofVerdict rest;
  std::vector<motion::ProofVerdict> motions;

  /// Return whether the grasp and all motions are proved.
  [[nodiscard]] bool proved() const;
};

/// Check proofs against a plan, in order from the initial hold.
/// @throws std::invalid_argument  if there are more proofs than entries.
[[nodiscard]] std::vector<EntryVerdict> CheckPlanProofs(const plan::Plan& projected, double mu,
                                                        std::span<const EntryProof> proofs);

[[nodiscard]] Json EntryProofJson(const EntryProof& proof, int dimension);
/// Read the proofs of an entry from JSON.
/// @throws InputError  if the JSON is not an entry proof.
[[nodiscard]] EntryProof ReadEntryProof(const plan::JsonReader& json, int dimension);

}  // namespace regrasp::certificate
