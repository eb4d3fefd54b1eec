#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "planner/gait/change_paths.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"

namespace regrasp::gait {

/// Groups of contacts near each other, so that grasps can be told from those much like them.
class ContactClusters {
 public:
  explicit ContactClusters(const std::vector<SurfacePoint>& points);

  /// By finger: the group of its contact, kNone where it is free.
  [[nodiscard]] ContactAssignment KindOf(ContactAssignment holding) const;

 private:
  std::vector<int> groups_;  ///< by contact
};

/// How much a search has looked at of what is like a rest, and how far that puts it back: so that
/// a dead end does not hold the search up.
class NoveltyPenalty {
 public:
  /// @param kinds  outlives this object. @param steps  that the object's track has.
  NoveltyPenalty(const ContactClusters& kinds, int steps) : clusters_(kinds), at_(steps + 1, 0) {}

  /// A rest was looked at. @param step  of the track, where it ends; in [0, steps].
  void Count(const ContactAssignment& holding, int step);
  /// A rest's score less what it is put back, in steps: for each one that ends where it ends, that
  /// is of its kind, and that the same fingers hold.
  [[nodiscard]] double PenaltyFor(double score, const ContactAssignment& holding, int step) const;

 private:
  const ContactClusters& clusters_;
  std::vector<int> at_;                    ///< rests, by the step that they end at
  std::map<ContactAssignment, int> like_;  ///< by the kind of their grasp
  std::map<std::vector<bool>, int> with_;  ///< by which fingers hold
};

/// The grasp that a gait is to end with, if one is asked for, and the ways in which fingers can
/// hold it.
class GoalGrasp {
 public:
  /// @param points   its contacts, by number; none: any grasp will do.
  /// @param surface  what numbers mean; outlives this object.
  GoalGrasp(std::vector<int> points, const std::vector<SurfacePoint>& surface)
      : points_(std::move(points)), surface_(surface) {}

  /// A way that the hand can hold it, at the goal pose.
  void AddWay(ContactAssignment way) { ways_.push_back(std::move(way)); }

  /// A grasp from which there is a way on to it.
  void AddTarget(ContactAssignment target) { targets_.push_back(std::move(target)); }
  /// The way or target that is nearest (DistanceFrom); null where there are none.
  [[nodiscard]] const ContactAssignment* NearestTo(const ContactAssignment& holding) const;
  /// Of those that the same fingers hold the nearest, so many at most.
  [[nodiscard]] std::vector<ContactAssignment> NearestOfSameFingers(
      const ContactAssignment& holding, int most) const;

  [[nodiscard]] bool IsWithinReach() const { return points_.empty() || !ways_.empty(); }
  [[nodiscard]] bool IsHeldBy(const ContactAssignment& holding) const;
  /// Fingers that are not where a way or a target has them, those that hold by how far they are
  /// from there.
  [[nodiscard]] double DistanceFrom(const ContactAssignment& holding) const;
  /// Contacts that a finger may end with.
  [[nodiscard]] std::set<int> ContactsOf(FingerIndex finger) const;

 private:
  [[nodiscard]] double DistanceBetween(int from, int to) const;
  [[nodiscard]] double DistanceBetween(const ContactAssignment& from,
                                       const ContactAssignment& to) const;

  std::vector<int> points_;
  const std::vector<SurfacePoint>& surface_;
  std::vector<ContactAssignment> ways_;
  std::vector<ContactAssignment> targets_;
};

/// What fingers may hold after one change: a finger is placed, released or both, or slides.
class SuccessorGenerator {
 public:
  /// @param may_hold_more  a finger may be placed or released alone, too. All others outlive this
  ///                       object.
  SuccessorGenerator(const HandSetup& setup, ObjectMotionChecker& checker, const GoalGrasp& goal,
                     SlideRoutes& routes, bool may_hold_more)
      : setup_(setup),
        checker_(checker),
        goal_(goal),
        routes_(routes),
        may_hold_more_(may_hold_more) {}

  /// After a change at a node, whether it is a grasp or not.
  [[nodiscard]] std::vector<ContactAssignment> After(const ContactAssignment& from, int node);
  /// Contacts for a finger that holds nothing, where it keeps off the fingers that hold: goals
  /// first, then those that it can keep longest.
  [[nodiscard]] std::vector<int> PlacesFor(FingerIndex finger, const ContactAssignment& from,
                                           int node);

 private:
  /// Of a share of the contacts, which is another one at each node: those that a finger reaches.
  [[nodiscard]] const std::vector<int>& ReachedAt(FingerIndex finger, int node, int share);
  /// A finger is placed, if it is valid, and each of the others released or none.
  void AddSwitches(const ContactAssignment& from, FingerIndex placed, int point,
                   std::vector<ContactAssignment>& holdings) const;
  /// A finger that holds slides.
  void AddSlides(const ContactAssignment& from, FingerIndex finger, int node,
                 std::vector<ContactAssignment>& holdings);
  /// Those of goals and targets that the same fingers slide to, all at once.
  void AddSlidesTogether(const ContactAssignment& from, int node,
                         std::vector<ContactAssignment>& holdings);
  /// Whether so many fingers of a grasp may slide at once.
  [[nodiscard]] bool MaySlide(const ContactAssignment& from, std::size_t fingers) const;
  /// Whether there is a way along the surface between two points.
  [[nodiscard]] bool IsWay(int from, int to) { return routes_.Between(from, to) != nullptr; }

  const HandSetup& setup_;
  ObjectMotionChecker& checker_;
  const GoalGrasp& goal_;
  SlideRoutes& routes_;
  bool may_hold_more_;
  std::map<std::tuple<int, int, int>, std::vector<int>> within_reach_;  ///< by finger, node, share
};

}  // namespace regrasp::gait
