#include "planner/planning/solve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/base/number.h"
#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/force_closure.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/grasp/unit_contacts.h"
#include "planner/object/read_object.h"
#include "planner/plan/plan_reach.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp::planning {

namespace {

using Kind = GraspChoice::Kind;
using Status = PlanResult::Status;

/// Find the first two contacts that are within a distance of each other.
std::optional<std::pair<int, int>> ContactsAtSamePoint(const grasp::Grasp& grasp,
                                                       double same_point) {
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    for (std::size_t j = i + 1; j < grasp.size(); ++j) {
      if ((grasp[i].p - grasp[j].p).norm() <= same_point) return std::pair(i, j);
    }
  }
  return std::nullopt;
}

std::string RangeText(const grasp::ContactLimits& range) {
  return (range.least == range.most ? "" : std::to_string(range.least) + " to ") +
         std::to_string(range.most);
}

/// Resolve start and goal grasps of a request.
class GraspResolver {
 public:
  GraspResolver(const Planner& planner, const PlanRequest& request)
      : planner_(planner),
        request_(request),
        scope_(planner.ScopeIn(request.object->dimension()).value()),
        evaluator_(*request.object, request.criteria, request.hand) {}

  /// Return a given grasp after its check, or a grasp drawn uniformly on the surface.
  [[nodiscard]] GraspChoice Resolve(GraspChoice choice, RandomUse use) const {
    if (choice.kind == Kind::kAny) {
      if (planner_.traits().needs_hand) return choice;
      throw std::invalid_argument("start or goal of any kind requires a hand");
    }
    if (choice.kind == Kind::kGiven) {
      Check(choice);
      return choice;
    }
    // Fingers may only be at the given points, and the planner has their grasps.
    if (request_.given_points != nullptr) choice.kind = Kind::kRandom;
    if (choice.kind == Kind::kRandom && planner_.traits().has_graph) return choice;
    RandomStream random(request_.seed, use);
    choice.grasp = sampling::DrawOnSurface(*request_.object, scope_.contacts_drawn, evaluator_,
                                           random, choice.name, [&] { request_.deadline.Check(); });
    choice.kind = Kind::kGiven;
    return choice;
  }

 private:
  void Check(const GraspChoice& choice) const {
    const auto refuse = [&](const std::string& why) {
      throw InputError(choice.name + ": /contacts: " + why);
    };
    const grasp::Grasp& grasp = choice.grasp;
    const int found = static_cast<int>(grasp.size());
    const bool soft = request_.hand.torsion > 0;
    const grasp::ContactLimits taken{soft ? evaluator_.fewest_contacts() : scope_.contacts.least,
                                     std::min(scope_.contacts.most, request_.hand.fingers)};
    if (found < taken.least || found > taken.most) {
      refuse("planner " + planner_.name() + " requires " + RangeText(taken) + " contacts, found " +
             std::to_string(found));
    }
    if (const auto pair =
            ContactsAtSamePoint(grasp, criteria::kSamePoint * request_.object->diameter())) {
      refuse("contacts " + std::to_string(pair->first) + " and " + std::to_string(pair->second) +
             " are at the same point");
    }
    for (std::size_t i = 0; i < grasp.size() && request_.given_points != nullptr; ++i) {
      const double off =
          (object::NearestPoint(*request_.given_points, grasp[i].p) - grasp[i].p).norm();
      if (off <= object::kAtGivenPoint * request_.object->diameter()) continue;
      refuse("contact " + std::to_string(i) + " is " + FormatShort(off) +
             " from the nearest given point");
    }
    CheckForceClosure(grasp, refuse);
    if (const auto obstacle = plan::FindRestObstacle(*request_.object, plan::FingersInOrder(grasp),
                                                     request_.hand.fingertip_radius)) {
      refuse("with one finger per contact: " + obstacle->detail);
    }
  }

  template <typename Refuse>
  void CheckForceClosure(const grasp::Grasp& grasp, const Refuse& refuse) const {
    const double friction_angle = request_.criteria.friction_angle;
    const grasp::SoftContacts felt(grasp, evaluator_.torsion());
    if (grasp::IsForceClosure(felt.view(), evaluator_.frame(), friction_angle)) return;
    const auto required = grasp::ComputeRequiredFrictionAngle(felt.view(), evaluator_.frame());
    if (!required) {
      refuse("not force closure at any friction angle below 90°, found " +
             FormatShort(Degrees(friction_angle)) + "°");
    }
    const auto [needed, given] =
        FormatRequiredDegrees(Degrees(required->upper), Degrees(friction_angle));
    refuse("not force closure: requires a friction angle of " + needed + "°, found " + given + "°");
  }

  const Planner& planner_;
  const PlanRequest& request_;
  PlannerScope scope_;
  criteria::GraspEvaluator evaluator_;
};

PlanResult Negative(Status status, std::string message) {
  PlanResult result;
  result.status = status;
  result.message = std::move(message);
  return result;
}

}  // namespace

PlanResult Solve(const Planner& planner, const PlanRequest& request) {
  if (!(request.criteria.min_quality >= 0))
    throw std::invalid_argument("min_quality must be at least 0");
  if (!(request.hand.torsion >= 0) || !std::isfinite(request.hand.torsion)) {
    throw std::invalid_argument("torsion must be finite and at least 0");
  }
  if (const std::string why = WhyNotServed(planner, request); !why.empty()) throw InputError(why);
  PlanRequest resolved = request;
  if (resolved.hand.fingers == 0) {
    resolved.hand.fingers = planner.ScopeIn(request.object->dimension())->fingers;
  }
  try {
    const GraspResolver resolver(planner, resolved);
    resolved.start = resolver.Resolve(request.start, RandomUse::kStart);
    resolved.goal = resolver.Resolve(request.goal, RandomUse::kGoal);
    if (std::isfinite(request.memory)) {
      const auto need = planner.EstimateMemory(resolved);
      const std::string why = need ? MemoryComplaint(*need, request.memory) : "";
      if (!why.empty()) return Negative(Status::kNoGrasp, why);
    }
    return planner.Plan(resolved);
  } catch (const sampling::NoGrasp& none) {
    return Negative(Status::kNoGrasp, none.message);
  } catch (const TimeUp&) {
    return Negative(Status::kNoSequence, "planner " + planner.name() + ": time limit reached");
  }
}

}  // namespace regrasp::planning
