#include "planner/plan/plan_reach.h"

#include <algorithm>
#include <vector>

#include "planner/base/number.h"
#include "planner/criteria/reach.h"

namespace regrasp::plan {

using Eigen::Vector3d;

namespace {

/// Waypoint number of a fault that is located between waypoints.
constexpr int kBetweenWaypoints = -1;

std::string Name(const FingerContact& held) { return "finger " + std::to_string(held.finger); }

double CentreDistance(const grasp::Contact& a, const grasp::Contact& b, double radius) {
  return (criteria::BallCentre(a, radius) - criteria::BallCentre(b, radius)).norm();
}

/// Return the obstacle of two fingers that overlap.
/// @param grasp  grasp at that instant.
Obstacle Overlap(const FingerContact& a, const FingerContact& b, const FingerGrasp& grasp,
                 double radius) {
  const auto [apart, needed] =
      FormatWithLimit(CentreDistance(a.contact, b.contact, radius), 2 * radius, 4);
  return {"fingers " + std::to_string(a.finger) + " and " + std::to_string(b.finger) +
              " overlap: their centres are " + apart + " apart, expected at least " + needed +
              " for fingers of radius " + FormatShort(radius) + " (units of the object file)",
          {.fingers = {a.finger, b.finger}, .grasp = grasp, .finger_radius = radius}};
}

Obstacle Unreached(const FingerContact& held, const std::string& why, const FingerGrasp& grasp,
                   double radius) {
  return {Name(held) + ": " + why,
          {.fingers = {held.finger}, .grasp = grasp, .finger_radius = radius}};
}

/// Return the obstacle with a prefix of its text.
Obstacle Named(const std::string& where, Obstacle obstacle, int waypoint) {
  obstacle.detail = where + obstacle.detail;
  obstacle.fault.waypoint = waypoint;
  return obstacle;
}

std::optional<Obstacle> FindOverlap(const FingerGrasp& grasp, double radius) {
  for (std::size_t i = 0; i < grasp.size(); ++i) {
    for (std::size_t j = i + 1; j < grasp.size(); ++j) {
      const grasp::Contact& a = grasp[i].contact;
      const grasp::Contact& b = grasp[j].contact;
      if (criteria::KeepApart(std::vector{a, b}, radius)) continue;
      return Overlap(grasp[i], grasp[j], grasp, radius);
    }
  }
  return std::nullopt;
}

/// Find a contact that its finger cannot reach.
/// @param grasp  contacts to check.
/// @param shown  whole grasp that contains them.
std::optional<Obstacle> FindUnreached(const object::Object& object, const FingerGrasp& grasp,
                                      const FingerGrasp& shown, double radius) {
  for (const FingerContact& held : grasp) {
    if (const auto obstacle = criteria::FindObstacle(object, held.contact, radius)) {
      return Unreached(held, *obstacle, shown, radius);
    }
  }
  return std::nullopt;
}

/// Search for an instant of [begin, end] that `fails`.
/// Skips intervals about an instant for which `is_clear` returns true.
/// @param is_clear  predicate (t, half): nothing fails from t − half to t + half.
template <class Fails, class IsClear>
std::optional<double> FindInstant(double begin, double end, const Fails& fails,
                                  const IsClear& is_clear) {
  const double half = (end - begin) / 2;
  const double middle = begin + half;
  if (is_clear(middle, half)) return std::nullopt;
  if (fails(middle)) return middle;
  if (half < kShortestReachInterval) return std::nullopt;
  if (const auto found = FindInstant(begin, middle, fails, is_clear)) return found;
  return FindInstant(middle, end, fails, is_clear);
}

/// Find an instant at which the object blocks a moving finger.
std::optional<double> FindBlocked(const object::Object& object, const motion::ContactMotion& motion,
                                  double radius) {
  const FaceIndex from = motion.At(0).face;
  const FaceIndex to = motion.At(1).face;
  // The far end of the segment that a finger sweeps has the largest speed.
  const double length = radius + object.diameter();
  const double speed = motion.velocity().norm() + motion.turn() * length;
  const auto fails = [&](double t) { return !criteria::CanReach(object, motion.At(t), radius); };
  const auto is_clear = [&](double t, double half) {
    const grasp::Contact contact = motion.At(t);
    const Vector3d rest = criteria::BallCentre(contact, radius);
    const auto near =
        object.FacesNearSegment(rest, rest - object.diameter() * contact.n, radius + half * speed);
    return std::ranges::all_of(near, [&](FaceIndex face) { return face == from || face == to; });
  };
  return FindInstant(0, 1, fails, is_clear);
}

/// Find an instant at which two moving fingers overlap.
std::optional<double> FindMeeting(const motion::ContactMotion& a, const motion::ContactMotion& b,
                                  double radius) {
  const double speed = (a.velocity() - b.velocity()).norm() + radius * (a.turn() + b.turn());
  const auto fails = [&](double t) {
    return !criteria::KeepApart(std::vector{a.At(t), b.At(t)}, radius);
  };
  const auto is_clear = [&](double t, double half) {
    return CentreDistance(a.At(t), b.At(t), radius) >= 2 * radius + half * speed;
  };
  return FindInstant(0, 1, fails, is_clear);
}

std::optional<Obstacle> FindPathObstacle(const object::Object& object, const FingerGrasp& from,
                                         const FingerGrasp& to, double radius) {
  // Points that are reachable at both ends are reachable on the path, which stays on the surface.
  if (radius <= 0) return std::nullopt;
  std::vector<motion::ContactMotion> motions;
  for (const FingerContact& held : from) {
    const FingerContact* end = FindFinger(to, held.finger);
    if (end == nullptr) return std::nullopt;
    motions.emplace_back(held.contact, end->contact);
  }
  const auto at = [](double t) { return FormatShort(t) + " of the path: "; };
  const auto grasp_at = [&](double t) {
    FingerGrasp there = from;
    for (std::size_t i = 0; i < there.size(); ++i) there[i].contact = motions[i].At(t);
    return there;
  };
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (const auto t = FindBlocked(object, motions[i], radius)) {
      const auto why = criteria::FindObstacle(object, motions[i].At(*t), radius);
      return Named(at(*t), Unreached(from[i], why.value_or(""), grasp_at(*t), radius),
                   kBetweenWaypoints);
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (const auto t = FindMeeting(motions[i], motions[j], radius)) {
        const FingerGrasp there = grasp_at(*t);
        return Named(at(*t), Overlap(there[j], there[i], there, radius), kBetweenWaypoints);
      }
    }
  }
  return std::nullopt;
}

std::optional<Obstacle> FindAlignObstacle(const object::Object& object, const Align& align,
                                          double radius) {
  for (int w = 0; w < std::ssize(align.waypoints); ++w) {
    const std::string waypoint = "waypoint " + std::to_string(w);
    if (const auto found = FindRestObstacle(object, align.waypoints[w], radius)) {
      return Named(waypoint + ": ", *found, w);
    }
    if (w == 0) continue;
    const auto found = FindPathObstacle(object, align.waypoints[w - 1], align.waypoints[w], radius);
    if (found) return Named("before " + waypoint + ", ", *found, w - 1);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Obstacle> FindRestObstacle(const object::Object& object, const FingerGrasp& grasp,
                                         double radius) {
  if (auto found = FindUnreached(object, grasp, grasp, radius)) return found;
  return FindOverlap(grasp, radius);
}

std::optional<Obstacle> FindStepObstacle(const object::Object& object, const FingerGrasp& before,
                                         const Step& step, double radius) {
  if (const auto* align = std::get_if<Align>(&step)) {
    return FindAlignObstacle(object, *align, radius);
  }
  if (std::holds_alternative<Move>(step)) return std::nullopt;
  const FingerGrasp& placed = std::get<Switch>(step).place;
  FingerGrasp during = before;
  during.insert(during.end(), placed.begin(), placed.end());
  if (auto found = FindUnreached(object, placed, during, radius)) return found;
  return FindOverlap(during, radius);
}

std::optional<PlanObstacle> FindPlanObstacle(const object::Object& object,
                                             const FingerGrasp& initial,
                                             std::span<const Step> steps, double radius) {
  EntryIndex index{0};
  if (auto found = FindRestObstacle(object, initial, radius)) {
    return PlanObstacle{index, found->detail};
  }
  FingerGrasp holding = initial;
  for (const Step& step : steps) {
    ++index;
    if (auto found = FindStepObstacle(object, holding, step, radius)) {
      return PlanObstacle{index, found->detail};
    }
    holding = GraspAfter(holding, step);
  }
  return std::nullopt;
}

}  // namespace regrasp::plan
