#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "planner/criteria/grasp_evaluator.h"
#include "planner/planning/candidate_sequence.h"
#include "planner/sets/polygon/attached_graph.h"
#include "planner/sets/polygon/switch_point.h"

namespace regrasp {

/// Turns paths of the switching graph into sequences from one start to one goal (Phoka 2010,
/// section 3.4).
///
/// A switch happens at the grasp at hand, or at the goal's, where that costs little, otherwise
/// where its two grasps score best; between switches the fingers align along straight lines inside
/// the set. Two switches in a row are one where the hand has the fingers.
class PolygonSequenceBuilder {
 public:
  /// All arguments must outlive this object.
  PolygonSequenceBuilder(const Polygon& polygon, const PolygonGraph& graph, GraphCells& cells,
                         const GraspEvaluator& evaluator, const Grasp& start, const Grasp& goal);
  PolygonSequenceBuilder(const PolygonSequenceBuilder&) = delete;
  PolygonSequenceBuilder& operator=(const PolygonSequenceBuilder&) = delete;

  /// No steps: for a goal that is the start.
  [[nodiscard]] CandidateSequence MakeEmpty() const;

  /// @param path  of sets, from one that `from` belongs to, to one that `to` belongs to.
  /// @param banned  gets a switch of the path where doubles find no way through it.
  /// @returns nullopt then.
  [[nodiscard]] std::optional<CandidateSequence> Make(const std::vector<int>& path,
                                                      const Attachment& from, const Attachment& to,
                                                      std::set<VertexPair>& banned);

 private:
  [[nodiscard]] std::optional<SwitchPoint> ChooseSwitch(int from, int to, const Eigen::VectorXd& at,
                                                        const Attachment* goal);
  [[nodiscard]] Grasp GraspAt(const GraspSet& set, const Eigen::VectorXd& parameters) const;
  [[nodiscard]] bool AlignTo(int vertex, const Eigen::VectorXd& from, const Eigen::VectorXd& to,
                             std::optional<VertexPair> chosen_for, CandidateSequence& draft);
  void SwitchTo(const Grasp& after, std::optional<VertexPair> chosen_for, CandidateSequence& draft);
  void AddStep(Step step, std::optional<VertexPair> chosen_for, CandidateSequence& draft);

  const Polygon& polygon_;
  const PolygonGraph& graph_;
  GraphCells& cells_;
  const GraspEvaluator& evaluator_;
  const Grasp& start_;
  const Grasp& goal_;
  GraspScore score_;
  std::map<VertexPair, std::optional<SwitchPoint>> best_switches_;  ///< by the path's order
  FingerGrasp holding_;
  FingerGrasp held_before_;  ///< before the last step
};

}  // namespace regrasp
