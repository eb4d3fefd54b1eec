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

/// Clusters of nearby contacts, which make similar grasps recognizable.
class ContactClusters {
 public:
  explicit ContactClusters(const std::vector<SurfacePoint>& points);

  /// Return the cluster of each finger's contact; kNone for idle fingers.
  [[nodiscard]] ContactAssignment ClustersOf(ContactAssignment assignment) const;

 private:
  std::vector<int> cluster_of_;  ///< [contact]
};

/// Penalty for stances that resemble those already expanded, which lets the search leave dead ends.
class NoveltyPenalty {
 public:
  /// @param clusters  clusters of contacts; outlives this object.
  /// @param steps  number of track steps.
  NoveltyPenalty(const ContactClusters& clusters, int steps)
      : clusters_(clusters), by_step_(steps + 1, 0) {}

  /// Count an expanded stance.
  /// @param step  track step that it reaches, in [0, steps].
  void Count(const ContactAssignment& assignment, int step);
  /// Return the score minus the penalty, in track steps.
  /// The penalty counts expanded stances with the same end step, the same clusters, and the same
  /// holding fingers.
  [[nodiscard]] double Penalized(double score, const ContactAssignment& assignment, int step) const;

 private:
  const ContactClusters& clusters_;
  std::vector<int> by_step_;                      ///< expanded stances by end step
  std::map<ContactAssignment, int> by_clusters_;  ///< expanded stances by clusters
  std::map<std::vector<bool>, int> by_fingers_;   ///< expanded stances by set of holding fingers
};

/// Goal grasp, if any, with the assignments of fingers that can hold it.
class GoalGrasp {
 public:
  /// @param points  contact numbers of the goal grasp; empty: any grasp.
  /// @param surface  contacts by number; outlives this object.
  GoalGrasp(std::vector<int> points, const std::vector<SurfacePoint>& surface)
      : points_(std::move(points)), surface_(surface) {}

  /// Add an assignment that the hand can hold at the goal pose.
  void AddAssignment(ContactAssignment assignment) {
    assignments_.push_back(std::move(assignment));
  }

  /// Add an assignment from which the goal is known to be reachable.
  void AddTarget(ContactAssignment target) { targets_.push_back(std::move(target)); }
  /// Return the nearest goal assignment or target (DistanceFrom); null if there are none.
  [[nodiscard]] const ContactAssignment* NearestTo(const ContactAssignment& assignment) const;
  /// Return the nearest goal assignments and targets with the same holding fingers, at most `most`.
  [[nodiscard]] std::vector<ContactAssignment> NearestOfSameFingers(
      const ContactAssignment& assignment, int most) const;

  [[nodiscard]] bool IsReachable() const { return points_.empty() || !assignments_.empty(); }
  [[nodiscard]] bool IsHeldBy(const ContactAssignment& assignment) const;
  /// Return the distance to the nearest goal assignment or target.
  /// Counts the differing fingers, each weighted by the distance between its contacts.
  [[nodiscard]] double DistanceFrom(const ContactAssignment& assignment) const;
  /// Return the contacts at which a finger may end.
  [[nodiscard]] std::set<int> ContactsOf(FingerIndex finger) const;

 private:
  [[nodiscard]] double DistanceBetween(int from, int to) const;
  [[nodiscard]] double DistanceBetween(const ContactAssignment& from,
                                       const ContactAssignment& to) const;

  std::vector<int> points_;
  const std::vector<SurfacePoint>& surface_;
  std::vector<ContactAssignment> assignments_;
  std::vector<ContactAssignment> targets_;
};

/// Generator of contact assignments after one contact change.
class SuccessorGenerator {
 public:
  /// @param may_change_count  whether a finger may also be placed or released alone. All other
  ///     arguments outlive this object.
  SuccessorGenerator(const HandSetup& setup, ObjectMotionChecker& checker, const GoalGrasp& goal,
                     SlideRoutes& routes, bool may_change_count)
      : setup_(setup),
        checker_(checker),
        goal_(goal),
        routes_(routes),
        may_change_count_(may_change_count) {}

  /// Return all assignments after one change at a grid node. They need not be admissible grasps.
  [[nodiscard]] std::vector<ContactAssignment> After(const ContactAssignment& from, int node);
  /// Return contacts for an idle finger that are clear of the holding fingers.
  /// Goal contacts come first, then those that the finger keeps longest.
  [[nodiscard]] std::vector<int> ContactCandidates(FingerIndex finger,
                                                   const ContactAssignment& from, int node);

 private:
  /// Return the contacts of one subset that a finger reaches at a grid node.
  /// The subsets rotate with the node.
  [[nodiscard]] const std::vector<int>& ReachedAt(FingerIndex finger, int node, int subset);
  /// Add the assignments after a finger switch.
  /// A finger is placed, if valid, and at most one other finger is released.
  void AddSwitches(const ContactAssignment& from, FingerIndex placed, int point,
                   std::vector<ContactAssignment>& assignments) const;
  /// Add the assignments in which one holding finger slides.
  void AddSlides(const ContactAssignment& from, FingerIndex finger, int node,
                 std::vector<ContactAssignment>& assignments);
  /// Add goal assignments and targets that the same fingers reach by sliding simultaneously.
  void AddSlidesTogether(const ContactAssignment& from, int node,
                         std::vector<ContactAssignment>& assignments);
  /// Return whether a number of fingers of a grasp may slide simultaneously.
  [[nodiscard]] bool MaySlide(const ContactAssignment& from, std::size_t fingers) const;
  /// Return whether there is a surface route between two contacts.
  [[nodiscard]] bool HasRoute(int from, int to) { return routes_.Between(from, to) != nullptr; }

  const HandSetup& setup_;
  ObjectMotionChecker& checker_;
  const GoalGrasp& goal_;
  SlideRoutes& routes_;
  bool may_change_count_;
  std::map<std::tuple<int, int, int>, std::vector<int>>
      within_reach_;  ///< cached reach, by finger, grid node and subset
};

}  // namespace regrasp::gait
