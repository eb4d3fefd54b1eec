#include "planner/certificate/plan_proof.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "planner/certificate/align_certificate.h"
#include "planner/certificate/check_proof.h"
#include "planner/certificate/force_proof.h"
#include "planner/motion/check_motion_proof.h"
#include "planner/plan/json_reader.h"

namespace regrasp::certificate {

namespace {

using ProofKind = GraspProof::Kind;

/// Motion between two waypoints, with the same finger at each index.
struct Motion {
  grasp::Grasp from;
  grasp::Grasp to;
};

/// Entry of a plan as required by the proofs: its final grasp, and the motions of a sliding step.
struct Entry {
  std::string kind;
  grasp::Grasp rest;
  std::vector<Motion> motions;
  const plan::AlignCertificate* certificate = nullptr;  ///< certificate of the plan, or null
};

std::vector<Entry> EntriesOf(const plan::Plan& plan) {
  plan::FingerGrasp holding = plan.initial;
  std::vector<Entry> entries = {{"hold", plan::ContactsOf(holding), {}, nullptr}};
  for (const plan::Step& step : plan.steps) {
    holding = plan::GraspAfter(holding, step);
    Entry entry{plan::StepKind(step), plan::ContactsOf(holding), {}, nullptr};
    if (const auto* align = std::get_if<plan::Align>(&step)) {
      for (std::size_t w = 0; w + 1 < align->waypoints.size(); ++w) {
        entry.motions.push_back({plan::ContactsOf(align->waypoints[w]),
                                 ContactsInOrder(align->waypoints[w + 1], align->waypoints[w])});
      }
      if (align->certificate) entry.certificate = &*align->certificate;
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

/// Return the plan's own proof of a motion if it is valid, otherwise a new one; empty if none is
/// found.
motion::MotionSegments ProvePath(const Entry& entry, std::size_t index, int dimension,
                                 double friction_angle) {
  const auto& [from, to] = entry.motions[index];
  if (entry.certificate != nullptr && index < entry.certificate->size()) {
    const motion::MotionSegments& given = (*entry.certificate)[index];
    if (motion::CheckMotionProof(from, to, dimension, std::tan(friction_angle), given).proves())
      return given;
  }
  return FindPathProof(from, to, dimension, friction_angle).value_or(motion::MotionSegments());
}

Json GraspProofJson(const GraspProof& proof, int dimension) {
  switch (proof.kind) {
    case ProofKind::kForces: {
      Json json = {{"forces", plan::ForcesJson(proof.forces, dimension)}};
      if (!proof.torques.empty()) json["torques"] = proof.torques;
      return json;
    }
    case ProofKind::kTwist:
      return {{"twist",
               {{"v", plan::VectorJson(proof.v, 3)}, {"omega", plan::VectorJson(proof.omega, 3)}}}};
    case ProofKind::kLine:
      return {{"line", proof.line}};
    case ProofKind::kNone:
      break;
  }
  return nullptr;
}

GraspProof ReadGraspProof(const plan::JsonReader& json, int dimension) {
  GraspProof proof;
  if (json.IsNull()) return proof;
  if (json.Has("forces")) {
    proof.kind = ProofKind::kForces;
    proof.forces = plan::ReadForces(json.Member("forces"), dimension);
    proof.torques = plan::ReadTorques(json, "torques");
  } else if (json.Has("twist")) {
    proof.kind = ProofKind::kTwist;
    proof.v = json.Member("twist").Member("v").Vector(3);
    proof.omega = json.Member("twist").Member("omega").Vector(3);
  } else {
    proof.kind = ProofKind::kLine;
    const auto line = json.Member("line").Elements();
    if (line.size() != proof.line.size()) json.Member("line").Fail("expected two contacts");
    for (std::size_t i = 0; i < line.size(); ++i) {
      proof.line[i] = line[i].Integer(0, std::numeric_limits<int>::max());
    }
  }
  return proof;
}

}  // namespace

bool EntryVerdict::proved() const {
  return rest.proves() && std::ranges::all_of(motions, &motion::ProofVerdict::proves);
}

std::vector<EntryProof> FindPlanProofs(const plan::Plan& projected, double friction_angle,
                                       int entries) {
  std::vector<EntryProof> proofs;
  for (const Entry& entry : EntriesOf(projected)) {
    if (static_cast<int>(proofs.size()) >= entries) break;
    EntryProof proof;
    proof.rest = FindGraspProof(entry.rest, projected.dimension, friction_angle);
    for (std::size_t index = 0; index < entry.motions.size(); ++index) {
      proof.motions.push_back(ProvePath(entry, index, projected.dimension, friction_angle));
    }
    proofs.push_back(std::move(proof));
  }
  return proofs;
}

std::vector<EntryVerdict> CheckPlanProofs(const plan::Plan& projected, double mu,
                                          std::span<const EntryProof> proofs) {
  const std::vector<Entry> entries = EntriesOf(projected);
  if (proofs.size() > entries.size()) {
    throw std::invalid_argument("more proofs than steps of the plan");
  }
  std::vector<EntryVerdict> verdicts;
  for (std::size_t i = 0; i < proofs.size(); ++i) {
    const Entry& entry = entries[i];
    EntryVerdict verdict{plan::EntryIndex(static_cast<int>(i)), entry.kind, {}, {}};
    verdict.rest = CheckGraspProof(entry.rest, projected.dimension, mu, proofs[i].rest);
    for (std::size_t index = 0; index < entry.motions.size(); ++index) {
      const bool has = index < proofs[i].motions.size();
      verdict.motions.push_back(motion::CheckMotionProof(
          entry.motions[index].from, entry.motions[index].to, projected.dimension, mu,
          has ? proofs[i].motions[index] : motion::MotionSegments()));
    }
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

Json EntryProofJson(const EntryProof& proof, int dimension) {
  Json json = {{"rest", GraspProofJson(proof.rest, dimension)}};
  if (proof.motions.empty()) return json;
  json["ways"] = Json::array();
  for (const motion::MotionSegments& segments : proof.motions) {
    json["ways"].push_back(plan::MotionSegmentsJson(segments, dimension));
  }
  return json;
}

EntryProof ReadEntryProof(const plan::JsonReader& json, int dimension) {
  EntryProof proof;
  proof.rest = ReadGraspProof(json.Member("rest"), dimension);
  if (!json.Has("ways")) return proof;
  for (const plan::JsonReader& segments : json.Member("ways").Elements()) {
    proof.motions.push_back(plan::ReadMotionSegments(segments, dimension));
  }
  return proof;
}

}  // namespace regrasp::certificate
