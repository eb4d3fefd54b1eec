#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_criteria.h"
#include "planner/grasp/contact.h"
#include "planner/hand/hand.h"
#include "planner/object/object.h"

namespace regrasp::planning {

/// Half-angle φ of the cones of concurrent grasps, θ being the friction's.
enum class Spanning {
  kAdaptive,  ///< φ = min(θ, φ*), φ* the supremum of angles for which the normals φ-positively span
  kUniform,  ///< φ = θ where the normals θ-positively span, no set where they don't
};

struct InHandTask;

/// How a plan's start or goal is chosen.
struct GraspChoice {
  enum class Kind {
    kGiven,      ///< `grasp`
    kRandom,     ///< drawn from the planner's own graph; a goal out of the start's component
    kRandomAny,  ///< drawn evenly over the surface, reachable or not
    kAny,        ///< of plans for a hand: whichever suits it
  };
  Kind kind = Kind::kGiven;
  grasp::Grasp grasp;
  std::string name;  ///< how messages call it: the file, or "--start random"
};

/// What a sequence is made best in, once one is found.
enum class Objective {
  kSteps,    ///< the fewest steps found, then the largest margin of the weakest grasp
  kMargin,   ///< the largest margin, with a few steps more where they help
  kTravel,   ///< the fewest steps found, then the least travel of all fingers together
  kRegions,  ///< every switch where its two grasps bear the largest errors of placement
};

/// Told what is being done.
using Progress = std::function<void(std::string_view)>;

/// What a graph is asked for besides its size.
struct GraphTasks {
  int focus_points = 0;  ///< random ones that cells are looked for by, instead of directly; 0: none
  int queries = 0;       ///< random ones that a roadmap of clusters answers
};

/// What is asked of a planner.
///
/// What stands under "Of some planners" not every planner has (Planner::options); where it is left
/// as it is here, none is asked for it.
struct PlanRequest {
  const object::Object* object = nullptr;  ///< outlives the request
  std::string object_name = {};            ///< how messages call it: its file
  GraspChoice start = {};
  GraspChoice goal = {};
  hand::Hand hand = {};
  criteria::GraspCriteria criteria = {};
  std::uint64_t seed = 0;  ///< of everything that is drawn at random
  Progress progress = [](std::string_view) {};

  // What limits the work.
  /// When reading and planning make an end; the plan then depends on the machine.
  Deadline deadline = {};
  /// Searches that a planner may make at a time, ≥ 1; without a deadline the plan is the same.
  int jobs = 1;
  /// Bytes that a planner's graph may take; where it would take more there is no plan.
  double memory = std::numeric_limits<double>::infinity();

  // Of some planners.
  Objective objective = Objective::kSteps;
  Spanning spanning = Spanning::kAdaptive;
  /// Contact points of a roadmap, and clusters that they are sorted into; nullopt: by the object.
  std::optional<int> contact_points = std::nullopt;
  std::optional<int> clusters = std::nullopt;
  /// If not null, contacts are at these points only (object/given_points.h); outlives the request.
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
  /// Of a roadmap of clusters: whether the grasps of all contact points are searched where the
  /// representatives do not join start and goal.
  bool last_resort = true;
  /// After what a search gives up, counted by the planner: `general` makes so many force-closure
  /// tests, of about two microseconds (nullopt: a million), `gait` goes on from so many grasps, of
  /// some milliseconds (nullopt: 8000).
  std::optional<std::int64_t> effort = std::nullopt;
  /// Where there is no sequence: looks for the smallest friction at which one is found, for a hand
  /// also for another size of the object or tilt of the palm, for as long again as the deadline is.
  bool explain = false;
  /// A hand that moves the object (gait/gait_planner.h), instead of fingers that come from nowhere.
  std::shared_ptr<InHandTask> in_hand = nullptr;

  /// Set where a planner's graph is asked for (Planner::SummarizeGraph) and no plan.
  std::optional<GraphTasks> graph = std::nullopt;
};

}  // namespace regrasp::planning
