#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "planner/gait/gait.h"
#include "planner/gait/pose_grid.h"
#include "planner/gait/rest_tree.h"
#include "planner/plan/reason.h"

namespace regrasp::gait {

/// How far something carried a gait out.
struct CarriedGait {
  int changes = 0;             ///< stretches that are no moves, before one failed
  bool is_held = true;         ///< before the first stretch
  bool fails_in_move = false;  ///< and in no change
  bool is_whole = false;       ///< none failed
  bool is_cut_short = false;   ///< the time was up before one failed
  plan::Reason reason = {};    ///< of what failed
};
/// How often what failed.
using FailureCounts = std::map<plan::Reason, std::int64_t>;
/// Tries a gait, or the beginning of one.
using CarryOut = std::function<CarriedGait(const Gait&)>;

/// Tries the ways of a tree of rests, and cuts off what is not carried out. The more steps of the
/// track are tried at once, the more often the last ones were carried out.
class TriedWays {
 public:
  /// Both outlive this object.
  TriedWays(const PoseGrid& grid, RestTree& tree) : grid_(grid), tree_(tree) {}

  /// From now on ways are tried; before, all are believed.
  void TryWith(CarryOut carry_out) { carry_out_ = std::move(carry_out); }
  [[nodiscard]] bool are_tried() const { return carry_out_ != nullptr; }

  /// Whether the way to a rest is carried out; few steps after what was carried out are believed.
  [[nodiscard]] bool IsCarriedOut(int rest);
  /// @param gait  the way to a rest, perhaps on to where it brings the object.
  /// @returns whether all of it is carried out; else what failed is cut off.
  [[nodiscard]] bool Try(int rest, const Gait& gait);
  /// Whether a change from a rest at a node to a grasp was tried in vain.
  [[nodiscard]] bool HasFailed(int rest, int node, const Holding& to) const {
    return failed_.contains({rest, node, to});
  }

  /// A step: a way was carried out so far, and what is believed goes no farther.
  [[nodiscard]] int MayReach() const {
    return are_tried() ? farthest_ + at_once_ : std::numeric_limits<int>::max();
  }
  [[nodiscard]] const FailureCounts& in_vain() const { return in_vain_; }  ///< ways

 private:
  static constexpr int kFewestAtOnce = 12;  ///< steps of the track, some 40 degrees
  static constexpr int kMostAtOnce = 96;
  /// A grasp from which so many changes failed is no good one to change from.
  static constexpr int kMostFailedChanges = 3;
  struct FailedChanges {
    int count = 0;
    int first_step = std::numeric_limits<int>::max();
  };

  /// The object is not carried with a rest to a step, and perhaps not half as far.
  void KeepBeforeMiddle(int rest, int step);
  void CountFailedChange(int rest, int step);
  void TakeAsCarried(int rest);

  const PoseGrid& grid_;
  RestTree& tree_;
  CarryOut carry_out_;
  int at_once_ = kFewestAtOnce;
  int farthest_ = 0;
  FailureCounts in_vain_;
  std::set<std::tuple<int, int, Holding>> failed_;  ///< rest, node and grasp
  std::map<int, FailedChanges> failed_changes_;     ///< by rest
};

}  // namespace regrasp::gait
