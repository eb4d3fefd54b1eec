#include "planner/tree/least_travel.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <queue>

#include "planner/tree/path_plan.h"
#include "planner/tree/subset_graph.h"

namespace regrasp::tree {

namespace {

using Mask = SubsetGraph::Mask;

class TravelSearch {
 public:
  TravelSearch(const criteria::ContactSet& from, const criteria::ContactSet& to,
               const std::vector<int>& contacts, int most_steps, double bound, SearchSpace& space)
      : graph_(from, to, contacts, UseAligns::kYes, space),
        space_(space),
        most_steps_(most_steps),
        bound_(bound),
        distances_(contacts.size(), std::vector<double>(contacts.size())) {
    for (int a = 0; a < graph_.contact_count(); ++a) {
      for (int b = 0; b < graph_.contact_count(); ++b) distances_[a][b] = graph_.Distance(a, b);
    }
  }

  std::optional<GraspPath> Search() {
    for (;;) {
      FindLastTravels();
      const std::vector<Mask> masks = Find();
      if (masks.empty()) return std::nullopt;
      auto path = graph_.MakePath(masks);
      if (!path) continue;
      // Over an edge an align's path is longer than the straight one.
      if (TravelOf(*path, space_) < bound_) return path;
      return std::nullopt;
    }
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  /// A path to a grasp, and the one that it goes on from.
  struct Label {
    double travel;
    int steps;
    Mask mask;
    int parent;  ///< in `settled_`; -1 for the start
    bool operator<(const Label& other) const {
      if (travel != other.travel) return travel > other.travel;
      if (steps != other.steps) return steps > other.steps;
      return mask > other.mask;
    }
  };

  void FindLastTravels() {
    last_travel_.assign(graph_.mask_count(), kNone);
    const auto any = [](Mask /*mask*/, double /*travel*/ = 0) { return true; };
    graph_.ForEachSwitch(graph_.to(), any, [&](Mask mask) {
      last_travel_[mask] = TravelOfSwitch(mask, graph_.to());
    });
    graph_.ForEachAlign(graph_.to(), any, [&](Mask mask, double travel) {
      last_travel_[mask] = std::min(last_travel_[mask], travel);
    });
  }

  /// The grasps of the path; none where there is none.
  std::vector<Mask> Find() {
    fewest_.assign(graph_.mask_count(), std::numeric_limits<int>::max());
    settled_.clear();
    queue_ = {};
    queue_.push({0, 0, graph_.from(), -1});
    while (!queue_.empty() && !space_.IsSpent()) {
      const Label label = queue_.top();
      queue_.pop();
      // What was settled before has travelled less.
      if (fewest_[label.mask] <= label.steps || !graph_.Admits(label.mask)) continue;
      fewest_[label.mask] = label.steps;
      settled_.push_back(label);
      if (label.mask == graph_.to()) return PathToLast();
      Expand(label, static_cast<int>(settled_.size()) - 1);
    }
    return {};
  }

  void Expand(const Label& label, int number) {
    const int steps = label.steps + 1;
    const auto push = [&](Mask next, double travel) {
      if (label.travel + travel < bound_) queue_.push({label.travel + travel, steps, next, number});
    };
    if (last_travel_[label.mask] < kNone) push(graph_.to(), last_travel_[label.mask]);
    if (steps >= most_steps_) return;
    const auto matters = [&](Mask next, double travel = 0) {
      return fewest_[next] > steps && label.travel + travel < bound_ &&
             (steps + 1 < most_steps_ || last_travel_[next] < kNone);
    };
    graph_.ForEachSwitch(label.mask, matters,
                         [&](Mask next) { push(next, TravelOfSwitch(label.mask, next)); });
    graph_.ForEachAlign(label.mask, matters, push);
  }

  /// As TravelOf has it.
  [[nodiscard]] double TravelOfSwitch(Mask from, Mask to) const {
    const Mask left = from & ~to;
    if (left == 0) return 0;
    double travel = 0;
    for (Mask placed = to & ~from; placed != 0; placed &= placed - 1) {
      const std::vector<double>& to_others = distances_[std::countr_zero(placed)];
      double nearest = std::numeric_limits<double>::infinity();
      for (Mask rest = left; rest != 0; rest &= rest - 1) {
        nearest = std::min(nearest, to_others[std::countr_zero(rest)]);
      }
      travel += nearest;
    }
    return travel;
  }

  [[nodiscard]] std::vector<Mask> PathToLast() const {
    std::vector<Mask> path;
    for (int at = static_cast<int>(settled_.size()) - 1; at >= 0; at = settled_[at].parent) {
      path.push_back(settled_[at].mask);
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  SubsetGraph graph_;
  SearchSpace& space_;
  int most_steps_;
  double bound_;
  std::vector<std::vector<double>> distances_;
  std::vector<double>
      last_travel_;          ///< by mask: of one step to the goal; kNone where there is none
  std::vector<int> fewest_;  ///< by mask: steps of the paths settled so far
  std::vector<Label> settled_;
  std::priority_queue<Label> queue_;
};

}  // namespace

std::optional<GraspPath> SearchLeastTravel(const criteria::ContactSet& from,
                                           const criteria::ContactSet& to,
                                           const std::vector<int>& contacts, int most_steps,
                                           double bound, SearchSpace& space) {
  return TravelSearch(from, to, contacts, most_steps, bound, space).Search();
}

}  // namespace regrasp::tree
