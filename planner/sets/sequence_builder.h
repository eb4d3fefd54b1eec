#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/planning/candidate_sequence.h"
#include "planner/sampling/surface_sampler.h"
#include "planner/sets/grasp_set_model.h"

namespace regrasp::sets {

/// Assign fingers to the contacts of the next waypoint of a sliding step.
///
/// Each finger stays on its face. If the next grasp has no contact on a finger's face, this finger
/// takes the remaining contact.
/// @param next  as many contacts as there are holding fingers; at most one on a new face.
[[nodiscard]] plan::FingerGrasp FollowTo(const plan::FingerGrasp& holding,
                                         const grasp::Grasp& next);

/// Sequence of steps under construction.
class FingerSequence {
 public:
  /// @param start  initial grasp.
  /// @param fingers  number of fingers of the hand.
  FingerSequence(const grasp::Grasp& start, int fingers);

  /// Append a finger switch to a grasp; no step if it is the current grasp.
  ///
  /// Two consecutive switches are merged if the hand has enough fingers.
  /// @param region  half-width of the contact region of the new contacts, if known; such a switch
  ///     is not merged.
  void SwitchTo(const grasp::Grasp& after, std::optional<search::VertexPair> chosen_for,
                std::optional<double> region = std::nullopt);

  /// Append a sliding step along waypoints, the first of which is the current grasp.
  void AlignAlong(const std::vector<grasp::Grasp>& waypoints,
                  std::optional<search::VertexPair> chosen_for);

  [[nodiscard]] const planning::CandidateSequence& candidate() const { return candidate_; }

 private:
  void AddStep(plan::Step step, std::optional<search::VertexPair> chosen_for);
  [[nodiscard]] bool CanJoinLastSwitch(const grasp::Grasp& after) const;

  planning::CandidateSequence candidate_;
  int fingers_;
  plan::FingerGrasp holding_;
  plan::FingerGrasp held_before_;  ///< grasp before the last step
};

/// Fraction of the best switch's margin that suffices for a switch at the current or goal grasp,
/// because that avoids a sliding step.
inline constexpr double kGoodShare = 0.5;

/// Distance between equal contacts due to rounding, divided by the diameter.
inline constexpr double kContactRounding = 1e-12;

/// Converts paths of a switching graph to sequences from one start to one goal (Phoka 2010,
/// sections 3.4 and 4.6).
///
/// A switch uses the current or the goal grasp if that costs little margin, otherwise the two
/// grasps with the best score. Sliding steps inside the sets connect the switches.
template <GraspSetModel Model>
class SequenceBuilder {
 public:
  using Place = typename Model::Place;

  /// All arguments must outlive this object. @param fingers  number of fingers of the hand.
  SequenceBuilder(Model& model, const grasp::Grasp& start, const grasp::Grasp& goal, int fingers)
      : model_(model), start_(start), goal_(goal), fingers_(fingers) {}

  /// Make the sequence of a path.
  /// @param path  sets, from the one that contains `from` to the one that contains `to`.
  /// @param banned  output: a switch of the path, if doubles find neither the switch nor a sliding
  ///     step to it.
  /// @returns nullopt if a switch was banned.
  /// @throws NoGrasp  if both grasps are in one set and no sliding step connects them.
  [[nodiscard]] std::optional<planning::CandidateSequence> Make(
      const std::vector<SetIndex>& path, const Place& from, const Place& to,
      std::set<search::VertexPair>& banned) {
    const auto switches = ChooseSwitches(path, from, to, banned);
    if (!switches) return std::nullopt;
    FingerSequence sequence(start_, fingers_);
    sequence.SwitchTo(GraspAt(from), std::nullopt);
    const Place* at = &from;
    for (const ChosenSwitch& chosen : *switches) {
      if (!AlignTo(*at, chosen.change.before, chosen.edge, sequence)) {
        banned.insert(chosen.edge);
        return std::nullopt;
      }
      sequence.SwitchTo(GraspAt(chosen.change.after), chosen.edge, chosen.region);
      at = &chosen.change.after;
    }
    if (!AlignTo(*at, to, std::nullopt, sequence)) {
      if (switches->empty())
        throw sampling::NoGrasp{
            "the sliding step from start to goal is too short for double precision"};
      banned.insert(switches->back().edge);
      return std::nullopt;
    }
    sequence.SwitchTo(goal_, std::nullopt);
    return sequence.candidate();
  }

 private:
  using Switch = typename Model::Switch;

  struct BestSwitch {
    std::optional<Switch> found;
    double margin = 0;  ///< smaller margin of its grasps; negative if one fails the criteria
  };

  struct ChosenSwitch {
    Switch change;
    search::VertexPair edge;
    std::optional<double> region;
  };

  [[nodiscard]] std::optional<std::vector<ChosenSwitch>> ChooseSwitches(
      const std::vector<SetIndex>& path, const Place& from, const Place& to,
      std::set<search::VertexPair>& banned) {
    std::vector<ChosenSwitch> switches;
    Place at = from;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const search::VertexPair edge = search::Unordered(path[i], path[i + 1]);
      const bool last = i + 2 == path.size();
      const auto found = ChooseSwitch(path[i], path[i + 1], at, last ? &to : nullptr);
      if (!found) {
        banned.insert(edge);
        return std::nullopt;
      }
      at = found->after;
      switches.push_back({*found, edge, std::nullopt});
    }
    if constexpr (requires(Switch & change) { model_.Refine(change); }) {
      for (ChosenSwitch& chosen : switches) {
        chosen.region = model_.Refine(chosen.change);
      }
    }
    return switches;
  }

  [[nodiscard]] std::optional<Switch> ChooseSwitch(SetIndex from, SetIndex to, const Place& at,
                                                   const Place* goal) {
    if (goal != nullptr) {
      auto between = model_.FindSwitch({from, to, &at, goal});
      if (between) return between;
    }
    const BestSwitch& best = FindBest(from, to);
    if (!best.found) return std::nullopt;
    const double least = std::max(kGoodShare * best.margin, 0.0);
    auto from_here = model_.FindSwitch({from, to, &at});
    if (from_here && MarginOf(from_here->after) >= least) return from_here;
    if (goal != nullptr) {
      auto to_goal = model_.FindSwitch({from, to, nullptr, goal});
      if (to_goal && MarginOf(to_goal->before) >= least) return to_goal;
    }
    return best.found;
  }

  [[nodiscard]] const BestSwitch& FindBest(SetIndex from, SetIndex to) {
    const auto [known, is_new] = best_.try_emplace({from, to});
    if (is_new) {
      known->second.found = model_.FindSwitch({from, to});
      if (const auto& found = known->second.found) {
        known->second.margin = std::min(MarginOf(found->before), MarginOf(found->after));
      }
    }
    return known->second;
  }

  /// Return the margin of a grasp; negative if it does not meet the criteria.
  [[nodiscard]] double MarginOf(const Place& place) const {
    return model_.evaluator().Margin(GraspAt(place)).value_or(-1);
  }

  /// Return the contacts of a place; those of start and goal exactly as given.
  [[nodiscard]] grasp::Grasp GraspAt(const Place& place) const {
    grasp::Grasp grasp = model_.GraspOf(place);
    const double rounding = kContactRounding * model_.evaluator().object().diameter();
    for (grasp::Contact& contact : grasp) {
      for (const grasp::Grasp* given : {&start_, &goal_}) {
        for (const grasp::Contact& other : *given) {
          const bool same = other.face == contact.face && (other.p - contact.p).norm() <= rounding;
          if (same) contact = other;
        }
      }
    }
    return grasp;
  }

  /// Append a sliding step. @returns false if no path is found inside the set.
  [[nodiscard]] bool AlignTo(const Place& from, const Place& to,
                             std::optional<search::VertexPair> chosen_for,
                             FingerSequence& sequence) {
    if (AreSame(GraspAt(from), GraspAt(to))) return true;
    std::vector<grasp::Grasp> waypoints;
    for (const Place& place : model_.FindRoute(from, to)) waypoints.push_back(GraspAt(place));
    if (waypoints.empty()) return false;
    sequence.AlignAlong(waypoints, chosen_for);
    return true;
  }

  [[nodiscard]] static bool AreSame(const grasp::Grasp& a, const grasp::Grasp& b) {
    return std::ranges::equal(a, b, [](const grasp::Contact& x, const grasp::Contact& y) {
      return x.face == y.face && x.p == y.p;
    });
  }

  Model& model_;
  const grasp::Grasp& start_;
  const grasp::Grasp& goal_;
  int fingers_;
  /// Best switches by the sets before and after.
  std::map<std::pair<SetIndex, SetIndex>, BestSwitch> best_;
};

}  // namespace regrasp::sets
