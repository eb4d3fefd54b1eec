#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <any>
#include <concepts>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/criteria/grasp_criteria.h"
#include "planner/grasp/contact.h"
#include "planner/hand/hand.h"
#include "planner/object/object.h"

namespace regrasp::planning {

/// Friction angle φ of the cones of concurrent grasps; θ is the friction angle of the request.
enum class Spanning {
  kAdaptive,  ///< φ = min(θ, φ*), φ* the supremum of angles for which the normals φ-positively span
  kUniform,  ///< φ = θ if the normals θ-positively span; otherwise there is no set
};

/// A start or goal grasp, or how to choose it.
struct GraspChoice {
  enum class Kind {
    kGiven,      ///< `grasp`
    kRandom,     ///< drawn from the planner's graph; a goal is in the component of the start
    kRandomAny,  ///< drawn uniformly on the surface; a plan may not exist
    kAny,        ///< any grasp that suits the plan; for planners of hands only
  };
  Kind kind = Kind::kGiven;
  grasp::Grasp grasp;
  std::string name;  ///< name in messages: the file, or "--start random"
};

/// The property of a sequence that is optimized once a sequence is found.
enum class Objective {
  kSteps,    ///< the fewest steps found, then the largest margin of the weakest grasp
  kMargin,   ///< the largest margin, at the cost of a few more steps
  kTravel,   ///< the fewest steps found, then the shortest travel of all fingers together
  kRegions,  ///< the largest independent contact regions of the two grasps of every switch
};

/// Callback with a description of the current work.
using Progress = std::function<void(std::string_view)>;

/// A struct with the parameters of one planner, or of a few planners that share them.
///
/// Its defaults request nothing. `Options()` returns the options whose values differ from the
/// defaults, as users write them: "--planner clusters". examples/planner has a struct to copy.
template <class T>
concept ParametersOfPlanner =
    std::same_as<decltype(std::declval<const T&>().Options()), std::vector<std::string>> &&
    std::copyable<T> && std::default_initializable<T>;

/// The parameters of a request that only some planners have: at most one value per type.
///
/// A planner reads the type that it knows. Other planners refuse a request whose OptionNames they
/// do not list in their traits (WhyNotServed).
class PlannerParameters {
 public:
  PlannerParameters() = default;
  /// Parameters of one type, for example `{.parameters = ExchangeParameters{.most_orders = 6}}`.
  template <ParametersOfPlanner T>
  PlannerParameters(T parameters) {  // NOLINT(google-explicit-constructor)
    Edit<T>() = std::move(parameters);
  }

  /// Return the parameters of a type to change them; the defaults before the first call.
  template <ParametersOfPlanner T>
  [[nodiscard]] T& Edit() {
    for (Entry& entry : entries_) {
      if (T* parameters = std::any_cast<T>(&entry.value)) return *parameters;
    }
    entries_.push_back(
        {T(), [](const std::any& value) { return std::any_cast<const T&>(value).Options(); }});
    return *std::any_cast<T>(&entries_.back().value);
  }

  /// Return the parameters of a type; the defaults if Edit was never called for it.
  template <ParametersOfPlanner T>
  [[nodiscard]] T Get() const {
    for (const Entry& entry : entries_) {
      if (const T* parameters = std::any_cast<T>(&entry.value)) return *parameters;
    }
    return T();
  }

  /// Return the options that differ from their defaults, each once, in the order of the Edit calls.
  [[nodiscard]] std::vector<std::string> OptionNames() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries_) {
      for (std::string& name : entry.options(entry.value)) {
        if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
      }
    }
    return names;
  }

 private:
  struct Entry {
    std::any value;
    std::vector<std::string> (*options)(const std::any&);
  };

  std::vector<Entry> entries_;
};

// Options of the planners `general` and `gait`, as users write them.
inline constexpr char kBudgetOption[] = "--planner budget";
inline constexpr char kExplainOption[] = "--explain";

/// Parameters of the planners `general` and `gait`.
struct SearchParameters {
  /// Search budget: for `general` a number of force-closure tests, about two microseconds each
  /// (default 1 000 000); for `gait` a number of expanded stances, a few milliseconds each (default
  /// 8000).
  std::optional<std::int64_t> budget = {};
  /// Whether to search for the smallest friction with a plan if there is none, and for `gait` also
  /// for another size of the object or a tilt of the palm. Takes at most the time limit again.
  bool explain = false;

  [[nodiscard]] std::vector<std::string> Options() const {
    std::vector<std::string> options;
    if (budget) options.emplace_back(kBudgetOption);
    if (explain) options.emplace_back(kExplainOption);
    return options;
  }
};

/// A request for a plan, or for the size of a planner's graph.
struct PlanRequest {
  const object::Object* object = nullptr;  ///< outlives the request
  std::string object_name = {};            ///< name of the object in messages: its file
  GraspChoice start = {};
  GraspChoice goal = {};
  hand::Hand hand = {};
  criteria::GraspCriteria criteria = {};
  /// Points of the object's file on which all contacts must be (object/read_object.h). Null: the
  /// whole surface. Outlives the request; only some planners have this option.
  const std::vector<Eigen::Vector3d>* given_points = nullptr;
  Objective objective = Objective::kSteps;  ///< objective; some planners support only kSteps
  std::uint64_t seed = 0;                   ///< seed of all random draws
  Progress progress = [](std::string_view) {};

  /// End of reading and planning. With a deadline the plan depends on the machine.
  Deadline deadline = {};
  /// Number of parallel searches at most, ≥ 1. Without a deadline the plan does not depend on it.
  int jobs = 1;
  /// Size limit of a planner's graph, bytes. If the estimate is larger, there is no plan.
  double memory = std::numeric_limits<double>::infinity();

  /// Parameters of single planners, for example roadmap::RoadmapParameters.
  PlannerParameters parameters = {};
  /// Whether only the size of a planner's graph is requested (Planner::SummarizeGraph), not a plan.
  bool for_graph = false;
};

}  // namespace regrasp::planning
