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

/// Number of grasps of one type in a graph.
struct TypeSummary {
  std::string name;
  std::int64_t candidates = 0;
  std::int64_t combinations = 0;
  std::int64_t vertices = 0;
  std::int64_t components = 0;  ///< components of the graph with this type only
};

/// Random queries on a roadmap, and their times.
struct QuerySummary {
  int count = 0;
  int connected = 0;
  double shortest_seconds = 0;
  double longest_seconds = 0;
  double mean_seconds = 0;
};

/// Share of a graph that sampling finds. It counts quadruples of faces, because sampling does not
/// distinguish the components of one quadruple.
struct SamplingShare {
  std::int64_t quadruples = 0;        ///< number of quadruples in the direct graph
  std::int64_t found_quadruples = 0;  ///< number of these that sampling finds
  std::int64_t links = 0;             ///< number of links between quadruples in the direct graph
  std::int64_t found_links = 0;       ///< number of these that sampling finds
};

/// The size of a planner's graph, with the additional values of the request.
struct GraphSummary {
  std::string planner;
  std::int64_t faces = 0;  ///< number of edges of a polygon, or of contact points of a roadmap
  std::string face_name;   ///< name of the elements that `faces` counts: "edges"
  std::vector<TypeSummary> types;
  /// Number of edges per type, for example "parallel-parallel"
  std::vector<std::pair<std::string, std::int64_t>> edges;
  std::int64_t vertices = 0;
  std::int64_t components = 0;
  double vertex_seconds = 0;
  double edge_seconds = 0;
  /// Number of numerically undecidable cases; nullopt if there can be none
  std::optional<std::int64_t> unclear;
  std::optional<SamplingShare> sampling_share;
  int clusters = 0;  ///< number of clusters of the contact points of a roadmap
  std::optional<QuerySummary> queries;
};

/// The result of a planner.
struct PlanResult {
  enum class Status {
    kFound,
    kNoSequence,  ///< no sequence connects the two grasps in this planner's graph
    kNoGrasp,     ///< no random start or goal was found, or a given one is in no set
  };
  Status status = Status::kFound;
  std::string message;  ///< for a negative result: description of the search
  /// Failure reason of the best candidate, if plans were found but none executes in simulation.
  std::optional<plan::Reason> trial;
  std::vector<std::string> warnings;  ///< grasps that do not meet the criteria
  std::vector<std::string> notes;     ///< improvements of the sequence, as text
  /// The plan without the object's file, digest and scale. Set if the status is kFound.
  std::optional<plan::Plan> plan;
  double margin = 0;  ///< smallest friction margin of all static grasps, radians
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

/// Capabilities of a planner for objects of one dimension.
struct PlannerScope {
  int fingers = 0;                ///< number of fingers of the hand
  grasp::ContactLimits contacts;  ///< permitted numbers of contacts of a grasp
  /// numbers of contacts of grasps that are drawn uniformly on the surface
  grasp::ContactLimits contacts_drawn;
};

/// Properties of a planner that are independent of a request.
struct PlannerTraits {
  std::string name = {};  ///< name for `--planner`
  std::string what = {};  ///< short description for `--help`
  /// nullopt: planar objects are not supported
  std::optional<PlannerScope> in_plane = std::nullopt;
  std::optional<PlannerScope> in_space = std::nullopt;  ///< nullopt: solids are not supported
  /// Options of some planners that this planner has, as users write them: "--optimize margin".
  std::vector<std::string> options = {};
  /// Whether it plans on a graph of its own: SummarizeGraph builds it, and
  /// GraspChoice::Kind::kRandom means grasps of it. Otherwise kRandom means the same as kRandomAny.
  bool has_graph = true;
  /// Whether it plans for hands only: it requires kHandOption and chooses grasps itself (kAny).
  bool needs_hand = false;
};

/// A planning method. To plan, call Solve (solve.h), which does the common part of all planners. A
/// planner supplies its traits and the search.
class Planner {
 public:
  virtual ~Planner() = default;

  [[nodiscard]] const PlannerTraits& traits() const { return traits_; }
  [[nodiscard]] const std::string& name() const { return traits_.name; }

  /// @param dimension  dimension of the object, 2 or 3.
  [[nodiscard]] const std::optional<PlannerScope>& ScopeIn(int dimension) const {
    return dimension == 2 ? traits_.in_plane : traits_.in_space;
  }

  /// Estimate the memory of the largest structure for a request that the planner serves; nullopt:
  /// negligible.
  [[nodiscard]] virtual std::optional<MemoryNeed> EstimateMemory(const PlanRequest& request) const;

  /// Plan for a request.
  /// @param request  request that the planner serves. The number of fingers is set. Start and goal
  ///     are grasps that the planner accepts, or kRandom if it has a graph.
  /// @throws NoGrasp, TimeUp  as results for Solve.
  [[nodiscard]] virtual PlanResult Plan(const PlanRequest& request) const = 0;

  /// Build the planner's graph and count its elements (graph_summary.h).
  /// @param request  request for a graph that the planner serves; start and goal are ignored.
  /// @throws InputError  if the request's parameters require another graph.
  /// @throws TimeUp      if the deadline passed.
  /// @throws std::logic_error  if the planner has no graph.
  [[nodiscard]] virtual GraphSummary SummarizeGraph(const PlanRequest& request) const;

 protected:
  explicit Planner(PlannerTraits traits) : traits_(std::move(traits)) {}

 private:
  PlannerTraits traits_;
};

/// Return the reason that a planner cannot serve a request; empty if it can.
/// The reason is the object's dimension, the number of fingers, a missing hand, or an unsupported
/// option or graph. Contacts of given grasps are not checked here: Solve checks them one by one,
/// with a message for each.
[[nodiscard]] std::string WhyNotServed(const Planner& planner, const PlanRequest& request);

}  // namespace regrasp::planning
