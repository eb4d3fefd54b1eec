#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/plan/plan.h"
#include "planner/plan/reason.h"
#include "planner/planning/plan_request.h"

namespace regrasp {
struct MemoryNeed;
}

namespace regrasp::planning {

/// How many grasps of one type a graph has.
struct TypeSummary {
  std::string name;
  std::int64_t candidates = 0;
  std::int64_t combinations = 0;
  std::int64_t vertices = 0;
  std::int64_t components = 0;  ///< of the graph, were there only this type
};

/// Random queries over a roadmap, and the times they took.
struct QuerySummary {
  int count = 0;
  int connected = 0;
  double shortest_seconds = 0;
  double longest_seconds = 0;
  double mean_seconds = 0;
};

/// How much of a graph sampling found. Quadruples of faces, as sampling does not tell components of
/// one quadruple apart.
struct SamplingShare {
  std::int64_t quadruples = 0;        ///< of the direct graph
  std::int64_t found_quadruples = 0;  ///< of these
  std::int64_t links = 0;             ///< between quadruples of the direct graph
  std::int64_t found_links = 0;       ///< of these
};

/// The size of a planner's graph, and what was asked for besides.
struct GraphSummary {
  std::string planner;
  std::int64_t faces = 0;  ///< edges of a polygon, contact points of a roadmap
  std::string face_name;   ///< what `faces` counts: "edges"
  std::vector<TypeSummary> types;
  std::vector<std::pair<std::string, std::int64_t>> edges;  ///< by types, as "parallel-parallel"
  std::int64_t vertices = 0;
  std::int64_t components = 0;
  double vertex_seconds = 0;
  double edge_seconds = 0;
  std::optional<std::int64_t> unclear;  ///< decisions too close to call, where there can be such
  std::optional<SamplingShare> sampling_share;
  int clusters = 0;  ///< of the contact points of a roadmap
  std::optional<QuerySummary> queries;
};

/// What every planner answers.
struct PlanResult {
  enum class Status {
    kFound,
    kNoSequence,  ///< no sequence joins the two grasps in this planner's graph
    kNoGrasp,     ///< a random start or goal could not be drawn, or a given one is in no set
  };
  Status status = Status::kFound;
  std::string message;  ///< for a negative answer: what was searched
  /// Where plans were found that a hand carries none of out, why not: of the one that came
  /// farthest.
  std::optional<plan::Reason> trial;
  std::vector<std::string> warnings;  ///< of grasps that don't meet the criteria
  std::vector<std::string> notes;     ///< what was gained by making the sequence better, for people
  /// The plan, all but the object's file, digest and scale. Set where the status is kFound.
  std::optional<plan::Plan> plan;
  double margin = 0;  ///< smallest of half_angle − required half-angle over all grasps at rest
};

// Options that only some planners have, as users write them. Further options are declared with the
// parameters of their planner.
inline constexpr char kMarginOption[] = "--optimize margin";
inline constexpr char kTravelOption[] = "--optimize travel";
inline constexpr char kRegionsOption[] = "--optimize regions";
inline constexpr char kGivenPointsOption[] = "--planner points=given";
inline constexpr char kSoftFingersOption[] = "--torsion";
inline constexpr char kHandOption[] = "--hand";

/// Return the options of a request that only some planners have, as users write them.
[[nodiscard]] std::vector<std::string> OptionsOf(const PlanRequest& request);

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
  /// Options of some planners that this planner has, as users write them: "--optimize margin".
  std::vector<std::string> options = {};
  /// Whether it plans on a graph of its own: SummarizeGraph builds it, and
  /// GraspChoice::Kind::kRandom means grasps of it. Otherwise kRandom means the same as kRandomAny.
  bool has_graph = true;
  /// Whether it plans for hands only: it requires kHandOption and chooses grasps itself (kAny).
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
