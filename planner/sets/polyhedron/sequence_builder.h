#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/sets/polyhedron/focus_geometry.h"

namespace regrasp {

/// Turns paths of the switching graph of a solid into sequences from one start to one goal: at each
/// switch the fifth finger is placed and another one released; between switches the four fingers
/// align straight together with the focus point.
class PolyhedronSequenceBuilder {
 public:
  /// A grasp of four contacts and the cells that it belongs to.
  struct End {
    Grasp grasp;
    std::vector<FocusGrasp> at;
  };

  /// All arguments must outlive this object.
  PolyhedronSequenceBuilder(FocusGeometry& geometry, const GraspEvaluator& evaluator,
                            const End& start, const End& goal);
  PolyhedronSequenceBuilder(const PolyhedronSequenceBuilder&) = delete;
  PolyhedronSequenceBuilder& operator=(const PolyhedronSequenceBuilder&) = delete;

  /// No steps: for a goal that is the start.
  [[nodiscard]] CandidateSequence MakeEmpty() const;

  /// @param path    of cells, from one of the start's to one of the goal's.
  /// @param banned  gets a switch of the path where doubles find no way through it.
  /// @returns nullopt then.
  [[nodiscard]] std::optional<CandidateSequence> Make(const std::vector<int>& path,
                                                      std::set<VertexPair>& banned);

 private:
  [[nodiscard]] std::optional<FocusSwitch> ChooseSwitch(int from, int to, bool last);
  [[nodiscard]] double ScoreOf(const FocusGrasp& grasp) const;
  [[nodiscard]] FingerGrasp Held(const FocusGrasp& grasp) const;
  [[nodiscard]] bool AlignTo(const FocusGrasp& to, std::optional<VertexPair> chosen_for,
                             CandidateSequence& draft);
  void SwitchTo(const FocusSwitch& found, VertexPair chosen_for, CandidateSequence& draft);

  FocusGeometry& geometry_;
  const GraspEvaluator& evaluator_;
  const End& start_;
  const End& goal_;
  struct BestSwitch {
    std::optional<FocusSwitch> found;
    double score = 0;  ///< of its worse grasp
  };
  std::map<std::pair<int, int>, BestSwitch> best_switches_;  ///< by the cells before and after
  const FocusGrasp* goal_at_ = nullptr;                      ///< in the path's last cell
  FocusGrasp at_;                                            ///< the grasp at hand
  std::array<int, 4> fingers_;  ///< that hold it, by the faces of its cell
};

}  // namespace regrasp
