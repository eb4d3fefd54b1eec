#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_memory.h"
#include "planner/gait/change_paths.h"
#include "planner/gait/gait.h"
#include "planner/gait/hand_scene.h"
#include "planner/gait/object_motion.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/rolling.h"

namespace regrasp::gait {

/// A grasp, and the nodes of the grid that it can be carried to.
struct StanceNode {
  Stance hold;
  int node = 0;                    ///< at which it was taken
  ReachablePoses carried = {};     ///< to where
  std::set<int> switched_at = {};  ///< nodes, in earlier turns
  int turns = 0;                   ///< that it had
  double score = 0;
  int parent = -1;
  bool is_carried = false;    ///< the way to it was tried, and carried out
  bool ends_in_vain = false;  ///< the way on with it to the goal is not carried out
  /// Step of the track: moves with it were tried, and are not carried out much farther.
  int farthest = std::numeric_limits<int>::max();
  int slides = 0;  ///< from the first rest to this one
  /// Worked out when its turn comes: the change, from where the parent brought the object.
  std::vector<PlanSegment> way = {};
  bool is_cut_off = false;  ///< the object can't be brought there
  /// Moves from node to node that were worked out, empty where they can't be done.
  std::map<std::pair<int, int>, std::vector<Keyframe>> moves = {};
  GridEdges blocked = {};  ///< those that can't
  Keyframe at = {};        ///< at `node`
  /// With reserve, where tips have rolled to at `node`: before the change, and after it.
  RolledTips rolled_before = {}, rolled = {};
};

/// Why ways could not be gone.
struct PathFailureCounts {
  std::int64_t no_path = 0;   ///< changes for which a finger found no free path
  std::int64_t no_slide = 0;  ///< slides that a finger could not follow, or that lose the object
  std::int64_t no_move = 0;   ///< moves that a finger could not follow, or that hit something
};

/// The rests that a search has come to, by number, each from another one, and the ways between
/// them. Ways are worked out when they are asked for, as they cost much.
class StanceTree {
 public:
  /// @param is_enough  of a node, for a holding: where it is carried to, no more need be looked
  /// for.
  /// @param has_given_start  the first rests are given by what they hold, and fingers that hold
  ///                         nothing may begin anywhere. All others outlive this object.
  StanceTree(const HandSetup& setup, const PoseGrid& grid, ObjectMotionChecker& checker,
             criteria::GraspMemory& memory, SlideRoutes& routes, RandomStream& random,
             std::function<bool(int, const ContactAssignment&)> is_enough, bool has_given_start)
      : setup_(setup),
        checker_(checker),
        paths_(setup, memory, checker, routes, random),
        is_enough_(std::move(is_enough)),
        has_given_start_(has_given_start),
        grid_(grid) {}

  /// References to rests hold when others are added. @returns the rest's number.
  int Add(StanceNode rest);
  [[nodiscard]] StanceNode& operator[](int rest) { return rests_[rest]; }
  [[nodiscard]] const StanceNode& operator[](int rest) const { return rests_[rest]; }
  [[nodiscard]] int size() const { return static_cast<int>(rests_.size()); }
  [[nodiscard]] const PathFailureCounts& counts() const { return counts_; }

  /// The first rest of the way to a rest.
  [[nodiscard]] int RootOf(int rest) const;
  /// A rest after a change, which is not in the tree yet.
  [[nodiscard]] StanceNode After(int from, const ContactAssignment& to, int node) const;

  /// The last rest of the way to one that was carried out; −1: none.
  [[nodiscard]] int LastExecuted(int rest) const;
  /// The way to a rest is carried out.
  void MarkExecuted(int rest);
  /// Cuts off the rest of the way to `rest` that comes after so many changes; −1: the first one.
  /// @returns it; −1 where it is none of them.
  int CutOffAfter(int rest, int changes);
  /// The object is not carried with a rest beyond a step: cuts off what comes of that.
  void LimitBefore(int rest, int step);

  /// Finds where a rest is carried, but for moves that can't be done.
  void ExtendReachable(StanceNode& rest);
  /// Works out the change to a rest, from where its parent brought the object.
  /// @returns whether there is a way.
  [[nodiscard]] bool PlanPathFromParent(StanceNode& rest);
  /// The whole way to a rest and with it to one of its nodes, where it is free. A rest that the
  /// object can't be brought to is cut off, with all that came of it.
  [[nodiscard]] std::optional<Gait> PathTo(int rest, int node);

  /// The same way to a rest with a finger that waits elsewhere all the time since it held
  /// something, or, after a given start, since the beginning.
  /// @returns that rest, by number; −1 where the finger is in the way, or where the beginning says
  ///          where it is.
  [[nodiscard]] int WithIdlePosture(int rest, FingerIndex finger, const Posture& posture);
  /// Of a rest to which the finger that is placed finds no way: has it wait above its contact
  /// before that (WithIdlePosture).
  /// @returns the rest as it is come to so, by number; −1 where it is not.
  [[nodiscard]] int AfterIdlingAbove(int rest);

 private:
  /// The move with a rest's grasp from a node to a neighbour; null where it can't be done.
  [[nodiscard]] const std::vector<Keyframe>* MoveBetween(StanceNode& rest, int from, int to);
  /// The move with a rest's grasp to a node that it comes to, past what can't be done; nullopt
  /// where there is no way round it.
  [[nodiscard]] std::optional<std::vector<Keyframe>> MoveFrom(StanceNode& rest, int node);
  void CutOff(int rest);
  /// Fingers that hold nothing before a rest and in it stay where they are: with another way to its
  /// parent that may be elsewhere, where one that was lifted found no way to where it was to wait.
  void IdleAsBefore(StanceNode& rest) const;

  const HandSetup& setup_;
  ObjectMotionChecker& checker_;
  ChangePaths paths_;
  std::function<bool(int, const ContactAssignment&)> is_enough_;
  bool has_given_start_;
  const PoseGrid& grid_;
  std::deque<StanceNode> rests_;  ///< which stay where they are when others come
  PathFailureCounts counts_;
};

}  // namespace regrasp::gait
