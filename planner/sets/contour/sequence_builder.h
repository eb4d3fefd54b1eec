#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/sets/contour/contour_switch.h"

namespace regrasp {

/// Which grasps a switch is made at.
enum class SwitchObjective {
  kRoom,    ///< well inside both sets, from the grasp at hand and to the goal where that serves
  kRegion,  ///< the largest contact regions
};

/// Turns paths of the switching graph of a contour into sequences from one start to one goal (Phoka
/// 2010, section 4.6): at each switch one finger is placed and one released; between switches the
/// fingers align inside the set, around corners where they must.
class ContourSequenceBuilder {
 public:
  /// @param start, goal  grasps of two contacts; at is where contact space has them.
  struct End {
    Grasp grasp;
    PlacedGrasp at;
  };

  /// All arguments must outlive this object.
  ContourSequenceBuilder(SetGeometry& geometry, const GraspEvaluator& evaluator,
                         SwitchObjective aim, const End& start, const End& goal);
  ContourSequenceBuilder(const ContourSequenceBuilder&) = delete;
  ContourSequenceBuilder& operator=(const ContourSequenceBuilder&) = delete;

  /// No steps: for a goal that is the start.
  [[nodiscard]] CandidateSequence MakeEmpty() const;

  /// @param path    of sets, from that of the start to that of the goal.
  /// @param banned  gets a switch of the path where doubles find no common place.
  /// @returns nullopt then.
  [[nodiscard]] std::optional<CandidateSequence> Make(const std::vector<int>& path,
                                                      std::set<VertexPair>& banned);

 private:
  [[nodiscard]] std::optional<ContourSwitch> ChooseMaxMarginSwitch(int from, int to, bool last);
  [[nodiscard]] const std::optional<ContourSwitch>& BestMaxMarginSwitch(int from, int to,
                                                                        const PlacedScore& margin);
  void Enlarge(int from, int to, ContourSwitch& found);
  [[nodiscard]] double RegionOf(const ContourSwitch& found) const;
  [[nodiscard]] bool IsGood(const ContourSwitch& found) const;
  [[nodiscard]] Grasp GraspOf(const PlacedGrasp& grasp) const;
  [[nodiscard]] FingerGrasp Held(const PlacedGrasp& grasp) const;
  void AlignTo(const PlacedGrasp& to, std::optional<VertexPair> chosen_for,
               CandidateSequence& draft);
  void SwitchTo(const ContourSwitch& found, VertexPair chosen_for, CandidateSequence& draft);

  SetGeometry& geometry_;
  const GraspEvaluator& evaluator_;
  SwitchObjective aim_;
  const End& start_;
  const End& goal_;
  /// Found once for all paths, by the sets before and after.
  std::map<std::pair<int, int>, std::optional<ContourSwitch>> max_margin_;
  std::map<std::pair<int, int>, std::optional<ContourSwitch>> largest_;
  PlacedGrasp at_;              ///< the grasp at hand
  std::array<int, 2> fingers_;  ///< that hold it, by the edges of its piece
};

}  // namespace regrasp
