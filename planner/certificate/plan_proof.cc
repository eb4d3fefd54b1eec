#include "planner/certificate/plan_proof.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "planner/certificate/check_motion_proof.h"
#include "planner/certificate/find_motion_proof.h"
#include "planner/certificate/find_proof.h"
#include "planner/plan/contact_motion.h"

namespace regrasp {

namespace {

using Kind = GraspProof::Kind;

/// One entry as the proofs see it: the grasp at its end, and the waypoints of an align.
struct Entry {
  std::string kind;
  Grasp rest;
  std::vector<Grasp> waypoints;
};

std::vector<Entry> EntriesOf(const Plan& plan) {
  FingerGrasp holding = plan.initial;
  std::vector<Entry> entries = {{"hold", ContactsOf(holding), {}}};
  for (const Step& step : plan.steps) {
    holding = GraspAfter(holding, step);
    Entry entry{StepKind(step), ContactsOf(holding), {}};
    if (const auto* align = std::get_if<Align>(&step)) {
      for (const FingerGrasp& waypoint : align->waypoints) {
        entry.waypoints.push_back(ContactsOf(waypoint));
      }
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::vector<MotionPiece> FindWay(const Grasp& from, const Grasp& to, int dimension,
                                 double half_angle) {
  if (from.size() != to.size()) return {};
  GraspMotion motion;
  for (std::size_t i = 0; i < from.size(); ++i) motion.emplace_back(from[i], to[i]);
  return FindMotionProof(motion, dimension, half_angle).value_or(std::vector<MotionPiece>());
}

Json ForcesJson(const std::vector<Eigen::Vector3d>& forces, int dimension) {
  Json json = Json::array();
  for (const Eigen::Vector3d& force : forces) json.push_back(VectorJson(force, dimension));
  return json;
}

std::vector<Eigen::Vector3d> ReadForces(const JsonReader& json, int dimension) {
  std::vector<Eigen::Vector3d> forces;
  for (const JsonReader& force : json.Elements()) forces.push_back(force.Vector(dimension));
  return forces;
}

Json GraspProofJson(const GraspProof& proof, int dimension) {
  switch (proof.kind) {
    case Kind::kForces:
      return {{"forces", ForcesJson(proof.forces, dimension)}};
    case Kind::kTwist:
      return {{"twist", {{"v", VectorJson(proof.v, 3)}, {"omega", VectorJson(proof.omega, 3)}}}};
    case Kind::kLine:
      return {{"line", proof.line}};
    case Kind::kNone:
      break;
  }
  return nullptr;
}

GraspProof ReadGraspProof(const JsonReader& json, int dimension) {
  GraspProof proof;
  if (json.IsNull()) return proof;
  if (json.Has("forces")) {
    proof.kind = Kind::kForces;
    proof.forces = ReadForces(json.Member("forces"), dimension);
  } else if (json.Has("twist")) {
    proof.kind = Kind::kTwist;
    proof.v = json.Member("twist").Member("v").Vector(3);
    proof.omega = json.Member("twist").Member("omega").Vector(3);
  } else {
    proof.kind = Kind::kLine;
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
  const auto is_proved = [](const ProofVerdict& verdict) {
    return verdict.kind == ProofVerdict::Kind::kForceClosure;
  };
  return is_proved(rest) && std::all_of(ways.begin(), ways.end(), is_proved);
}

std::vector<EntryProof> FindPlanProofs(const Plan& located, double half_angle, int entries) {
  std::vector<EntryProof> proofs;
  for (const Entry& entry : EntriesOf(located)) {
    if (static_cast<int>(proofs.size()) >= entries) break;
    EntryProof proof;
    proof.rest = FindGraspProof(entry.rest, located.dimension, half_angle);
    for (std::size_t i = 1; i < entry.waypoints.size(); ++i) {
      proof.ways.push_back(
          FindWay(entry.waypoints[i - 1], entry.waypoints[i], located.dimension, half_angle));
    }
    proofs.push_back(std::move(proof));
  }
  return proofs;
}

std::vector<EntryVerdict> CheckPlanProofs(const Plan& located, double mu,
                                          std::span<const EntryProof> proofs) {
  const std::vector<Entry> entries = EntriesOf(located);
  if (proofs.size() > entries.size()) {
    throw std::invalid_argument("more proofs than the plan has entries");
  }
  std::vector<EntryVerdict> verdicts;
  for (std::size_t i = 0; i < proofs.size(); ++i) {
    const Entry& entry = entries[i];
    EntryVerdict verdict{static_cast<int>(i), entry.kind, {}, {}};
    verdict.rest = CheckGraspProof(entry.rest, located.dimension, mu, proofs[i].rest);
    for (std::size_t k = 1; k < entry.waypoints.size(); ++k) {
      const bool has = k <= proofs[i].ways.size();
      verdict.ways.push_back(
          CheckMotionProof(entry.waypoints[k - 1], entry.waypoints[k], located.dimension, mu,
                           has ? proofs[i].ways[k - 1] : std::vector<MotionPiece>()));
    }
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

Json EntryProofJson(const EntryProof& proof, int dimension) {
  Json json = {{"rest", GraspProofJson(proof.rest, dimension)}};
  if (proof.ways.empty()) return json;
  json["ways"] = Json::array();
  for (const std::vector<MotionPiece>& way : proof.ways) {
    Json pieces = Json::array();
    for (const MotionPiece& piece : way) {
      pieces.push_back({{"from", piece.from},
                        {"to", piece.to},
                        {"start", ForcesJson(piece.start, dimension)},
                        {"end", ForcesJson(piece.end, dimension)}});
    }
    json["ways"].push_back(std::move(pieces));
  }
  return json;
}

EntryProof ReadEntryProof(const JsonReader& json, int dimension) {
  EntryProof proof;
  proof.rest = ReadGraspProof(json.Member("rest"), dimension);
  if (!json.Has("ways")) return proof;
  for (const JsonReader& way : json.Member("ways").Elements()) {
    std::vector<MotionPiece>& pieces = proof.ways.emplace_back();
    for (const JsonReader& piece : way.Elements()) {
      pieces.push_back({piece.Member("from").Number(), piece.Member("to").Number(),
                        ReadForces(piece.Member("start"), dimension),
                        ReadForces(piece.Member("end"), dimension)});
    }
  }
  return proof;
}

}  // namespace regrasp
