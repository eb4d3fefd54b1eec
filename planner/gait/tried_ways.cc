#include "planner/gait/tried_ways.h"

#include <algorithm>
#include <optional>

namespace regrasp::gait {

bool TriedWays::IsCarriedOut(int rest) {
  if (!are_tried()) return true;
  const int last = tree_.LastCarried(rest);
  const int from = last < 0 ? grid_.start() : tree_[last].node;
  if (grid_.StepOf(tree_[rest].node) - grid_.StepOf(from) < at_once_) return true;
  const std::optional<Gait> gait = tree_.WayTo(rest, tree_[rest].node);
  return gait && Try(rest, *gait);
}

bool TriedWays::Try(int rest, const Gait& gait) {
  const CarriedGait carried = carry_out_(gait);
  if (carried.is_cut_short) return false;  // which says nothing of the rest
  at_once_ = carried.is_whole ? std::min(2 * at_once_, kMostAtOnce)
                              : std::max(at_once_ / 2, kFewestAtOnce);
  if (carried.is_whole) {
    TakeAsCarried(rest);
    return true;
  }
  ++in_vain_[carried.reason];
  const int cut = tree_.CutOffAfter(rest, carried.is_held ? carried.changes : -1);
  if (cut < 0) {
    tree_[rest].ends_in_vain = true;
    KeepBeforeMiddle(rest, grid_.steps());
    tree_.MarkCarried(rest);
    return false;
  }
  const Rest& failed = tree_[cut];
  if (failed.parent >= 0) {
    TakeAsCarried(failed.parent);
    failed_.insert({failed.parent, failed.node, failed.hold.holding});
    const int step = grid_.StepOf(failed.node);
    if (carried.fails_in_move) {
      KeepBeforeMiddle(failed.parent, step);
    } else {
      CountFailedChange(failed.parent, step);
    }
  }
  return false;
}

void TriedWays::KeepBeforeMiddle(int rest, int step) {
  const int from = grid_.StepOf(tree_[rest].node);
  if (step > from) tree_.KeepBefore(rest, (from + step) / 2);
}

void TriedWays::CountFailedChange(int rest, int step) {
  FailedChanges& failed = failed_changes_[rest];
  ++failed.count;
  failed.first_step = std::min(failed.first_step, step);
  if (failed.count >= kMostFailedChanges) tree_.KeepBefore(rest, failed.first_step - 1);
}

void TriedWays::TakeAsCarried(int rest) {
  tree_.MarkCarried(rest);
  farthest_ = std::max(farthest_, grid_.StepOf(tree_[rest].node));
}

}  // namespace regrasp::gait
