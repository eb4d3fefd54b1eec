#pragma once

#include <map>
#include <vector>

#include "planner/criteria/grasp_criteria.h"
#include "planner/grasp/contact.h"
#include "planner/hand/hand.h"
#include "planner/object/object.h"

namespace regrasp::criteria {

/// What a planner asks of grasps that a hand is to rest in: GraspCriteria, and that the hand can be
/// there. For grasps whose contacts are anywhere; GraspMemory has those of numbered contacts.
class GraspEvaluator {
 public:
  /// @param object  must outlive this object.
  GraspEvaluator(const object::Object& object, const GraspCriteria& criteria,
                 const hand::Hand& hand = {});

  /// Force closure, meets the criteria, and the hand can be there.
  [[nodiscard]] bool IsGood(const grasp::Grasp& grasp) const;

  /// Whether the hand can be there, good or not: fingers at different points (CanMeet), each with
  /// clearance for a fingertip (HasClearance), and it can come there (CanReach).
  [[nodiscard]] bool IsReachable(const grasp::Grasp& grasp) const;

  /// How good it is to rest in a grasp: its margin to the required half-angle, radians, where it is
  /// good; otherwise a negative number, the worse the lower its quality.
  /// Remembers what it was asked: searches come back to the same grasps. Not for several threads.
  [[nodiscard]] double Score(const grasp::Grasp& grasp) const;

  [[nodiscard]] double Quality(const grasp::Grasp& grasp) const;

  [[nodiscard]] const object::WrenchFrame& frame() const { return frame_; }
  [[nodiscard]] double half_angle() const { return criteria_.half_angle; }
  [[nodiscard]] double min_quality() const { return criteria_.min_quality; }
  [[nodiscard]] double finger_radius() const { return hand_.fingertip_radius; }
  [[nodiscard]] const object::Object& object() const { return object_; }

 private:
  [[nodiscard]] bool CanAllMeet(const grasp::Grasp& grasp) const;
  [[nodiscard]] bool AreReachable(const grasp::Grasp& contacts) const;
  [[nodiscard]] double ComputeScore(const grasp::Grasp& grasp) const;

  const object::Object& object_;
  object::WrenchFrame frame_;
  GraspCriteria criteria_;
  hand::Hand hand_;
  double same_point_;
  mutable std::map<std::vector<double>, double> scores_;  ///< by the numbers of a grasp
};

}  // namespace regrasp::criteria
