#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/planning/plan_request.h"
#include "planner/planning/plan_result.h"

namespace regrasp {
struct MemoryNeed;
}

namespace regrasp::planning {

struct GraphSummary;

/// Options of a PlanRequest that only some planners have.
enum class PlanOption {
  kMargin,  ///< Objective::kMargin
  kTravel,
  kRegions,
  kUniformSpanning,
  kContactPoints,
  kGivenPoints,
  kClusters,
  kNoLastResort,
  kEffort,
  kExplain,
  kHand,
  kSoftFingers,  ///< Hand::torsion above 0
  kFocusPoints,  ///< of GraphTasks
  kQueries,
};

/// As users write it: "--optimize margin".
[[nodiscard]] std::string OptionName(PlanOption option);

/// Those that a request asks for.
[[nodiscard]] std::vector<PlanOption> OptionsOf(const PlanRequest& request);

/// What a planner can do with objects of one dimension.
struct PlannerScope {
  int fingers = 0;                      ///< of the hand that it plans for
  grasp::ContactLimits contacts;        ///< of the grasps that it takes
  grasp::ContactLimits contacts_drawn;  ///< of those that are drawn evenly over the surface
};

/// What is known of a planner before it plans.
struct PlannerTraits {
  std::string name = {};  ///< as `--planner` takes it
  std::string what = {};  ///< what it plans, in a few words for `--help`
  std::optional<PlannerScope> in_plane = std::nullopt;  ///< nullopt: no planar objects
  std::optional<PlannerScope> in_space = std::nullopt;  ///< nullopt: no solids
  std::vector<PlanOption> options = {};
  /// Whether it plans on a graph of its own: SummarizeGraph builds it, and
  /// GraspChoice::Kind::kRandom means grasps of it. Otherwise kRandom means the same as kRandomAny.
  bool has_graph = true;
  /// Whether it plans for hands only (PlanRequest::in_hand).
  bool needs_hand = false;
};

/// A method of planning. Whoever wants a plan calls Solve (solve.h), which sees to all that
/// planners have in common; a planner supplies its traits and the planning alone.
class Planner {
 public:
  virtual ~Planner() = default;

  [[nodiscard]] const PlannerTraits& traits() const { return traits_; }
  [[nodiscard]] const std::string& name() const { return traits_.name; }

  /// @param dimension  of the object, 2 or 3.
  [[nodiscard]] const std::optional<PlannerScope>& ScopeIn(int dimension) const {
    return dimension == 2 ? traits_.in_plane : traits_.in_space;
  }

  /// What it is about to build for a request that it can serve; nullopt: nothing large.
  [[nodiscard]] virtual std::optional<MemoryNeed> EstimateMemory(const PlanRequest& request) const;

  /// @param request  that it can serve; its hand has a number of fingers, start and goal are grasps
  ///                 that the planner takes, or kRandom where it has grasps of its own.
  /// @throws NoGrasp, TimeUp  for Solve.
  [[nodiscard]] virtual PlanResult Plan(const PlanRequest& request) const = 0;

  /// Builds its graph and counts what is in it (graph_summary.h).
  /// @param request  for a graph, that it serves; start and goal count for nothing.
  /// @throws InputError  the request's tasks need another graph.
  /// @throws TimeUp      the deadline came.
  /// @throws std::logic_error  it has no graph.
  [[nodiscard]] virtual GraphSummary SummarizeGraph(const PlanRequest& request) const;

 protected:
  explicit Planner(PlannerTraits traits) : traits_(std::move(traits)) {}

 private:
  PlannerTraits traits_;
};

/// Why a planner cannot serve a request: the object's dimension, the number of fingers of the hand,
/// a hand that it needs, or an option or a graph that it does not have; empty where it can.
/// Contacts of given grasps are not looked at: they are checked one by one, with a message for each
/// (Solve).
[[nodiscard]] std::string WhyNotServed(const Planner& planner, const PlanRequest& request);

}  // namespace regrasp::planning
