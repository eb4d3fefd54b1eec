#pragma once

#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#include "planner/gait/carrier.h"
#include "planner/gait/gait.h"
#include "planner/gait/goal_grasp.h"
#include "planner/gait/hand_setup.h"
#include "planner/gait/slide_path.h"

namespace regrasp::gait {

/// What fingers may hold after one change: a finger is placed, released or both, or slides.
class NextHoldings {
 public:
  /// @param may_hold_more  a finger may be placed or released alone, too. All others outlive this
  ///                       object.
  NextHoldings(const HandSetup& setup, Carrier& carrier, const GoalGrasp& goal, SlideRoutes& routes,
               bool may_hold_more)
      : setup_(setup),
        carrier_(carrier),
        goal_(goal),
        routes_(routes),
        may_hold_more_(may_hold_more) {}

  /// After a change at a node, whether it is a grasp or not.
  [[nodiscard]] std::vector<Holding> After(const Holding& from, int node);
  /// Contacts for a finger that holds nothing, where it keeps off the fingers that hold: goals
  /// first, then those that it can keep longest.
  [[nodiscard]] std::vector<int> PlacesFor(FingerIndex finger, const Holding& from, int node);

 private:
  /// Of a share of the contacts, which is another one at each node: those that a finger reaches.
  [[nodiscard]] const std::vector<int>& ReachedAt(FingerIndex finger, int node, int share);
  /// A finger is placed, if it is valid, and each of the others released or none.
  void AddSwitches(const Holding& from, FingerIndex placed, int point,
                   std::vector<Holding>& holdings) const;
  /// A finger that holds slides.
  void AddSlides(const Holding& from, FingerIndex finger, int node, std::vector<Holding>& holdings);
  /// Those of goals and targets that the same fingers slide to, all at once.
  void AddSlidesTogether(const Holding& from, int node, std::vector<Holding>& holdings);
  /// Whether so many fingers of a grasp may slide at once.
  [[nodiscard]] bool MaySlide(const Holding& from, std::size_t fingers) const;
  /// Whether there is a way along the surface between two points.
  [[nodiscard]] bool IsWay(int from, int to) { return routes_.Between(from, to) != nullptr; }

  const HandSetup& setup_;
  Carrier& carrier_;
  const GoalGrasp& goal_;
  SlideRoutes& routes_;
  bool may_hold_more_;
  std::map<std::tuple<int, int, int>, std::vector<int>> within_reach_;  ///< by finger, node, share
};

}  // namespace regrasp::gait
