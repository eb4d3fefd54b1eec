#pragma once

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/hand_options.h"
#include "apps/planner_options.h"
#include "planner/criteria/grasp_criteria.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/planning/planner.h"

namespace regrasp::apps {

/// The program's name, before its messages.
inline constexpr char kPlanName[] = "plan";

/// A start or a goal, as it is asked for.
struct PlanEnd {
  std::string option;  ///< "--start"
  std::string value;   ///< a grasp file, "random" or "random-any"; empty: not given
  std::string text;    ///< the grasp itself, instead of its file
  std::string name;    ///< of `text`, as messages call it

  [[nodiscard]] bool given() const { return !value.empty() || !text.empty(); }
  [[nodiscard]] bool is_random() const;
};

/// The points of the object's file that contacts are to be at, where that is asked.
using GivenPoints = std::optional<std::vector<Eigen::Vector3d>>;

/// What was planned, and what the checker says of it.
struct FinishedPlan {
  planning::PlanResult result;
  plan::PlanCheck check;  ///< where there is a plan
};

/// What the command line of `plan` asks for.
struct PlanProgram {
  PlannerOptions common;
  PlanEnd start{"--start", "", "", ""};
  PlanEnd goal{"--goal", "", "", ""};
  std::string output;
  double min_quality = criteria::GraspCriteria().min_quality;
  double finger_radius = 0;  ///< 0: points
  planning::Objective objective = planning::Objective::kSteps;
  bool no_lazy = false;
  std::optional<std::int64_t> effort;
  bool explain = false;
  HandOptions hand;
  /// Of --hand, where ReadHand was called.
  std::shared_ptr<const kinematics::HandFile> hand_file;
  std::string batch;  ///< a file of queries, each of which says more or other than this
  std::string shard;
  int jobs;
  bool fresh = false;  ///< of a batch: does again what an earlier run did
  /// Given options that change results, each with its values.
  std::vector<std::pair<std::string, std::vector<std::string>>> given;
  /// Called once when the search for a hand's plan begins, after the input has been checked.
  std::function<void()> on_search = [] {};

  PlanProgram();
  /// Adds all options to the command line; they are set when it is parsed.
  void AddTo(CLI::App& app);
  /// After parsing: finds out what is given and whether it goes together.
  /// @throws InputError  it does not.
  void Finish(const CLI::App& app);

  /// @throws InputError  the ends are too few, or do not go with a hand.
  void CheckEnds() const;
  /// Reads the hand's file, where there is one.
  /// @throws InputError  it is no good.
  void ReadHand();
  /// Plans once, and makes of what is found a plan that stands alone.
  /// @throws InputError  the object and the options do not go together.
  [[nodiscard]] FinishedPlan Plan(const object::ObjectFile& object, const GivenPoints& given) const;

 private:
  void AddEnds(CLI::App& app);
  void AddSearch(CLI::App& app);
  void AddBatch(CLI::App& app);
  [[nodiscard]] planning::GraspChoice Choose(const PlanEnd& end,
                                             const object::Object& object) const;
  [[nodiscard]] planning::PlanRequest RequestFor(const object::Object& object) const;
  [[nodiscard]] planning::PlanResult Find(const object::ObjectFile& object,
                                          const GivenPoints& given) const;
};

}  // namespace regrasp::apps
