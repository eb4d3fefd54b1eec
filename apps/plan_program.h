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

/// A start or a goal on the command line.
struct PlanEnd {
  std::string option;  ///< "--start"
  std::string value;   ///< a grasp file, "random" or "random-any"; empty: not given
  std::string text;    ///< the grasp itself, instead of its file
  std::string name;    ///< of `text`, as messages call it

  [[nodiscard]] bool given() const { return !value.empty() || !text.empty(); }
  [[nodiscard]] bool is_random() const;
};

/// Points of the object's file that contacts must be at, if required.
using GivenPoints = std::optional<std::vector<Eigen::Vector3d>>;

/// Result of planning and of the checker.
struct FinishedPlan {
  planning::PlanResult result;
  plan::PlanCheck check;  ///< if there is a plan
};

/// Options of `plan`.
struct PlanProgram {
  PlannerOptions common;
  PlanEnd start{"--start", "", "", ""};
  PlanEnd goal{"--goal", "", "", ""};
  std::string output;
  double min_quality = criteria::GraspCriteria().min_quality;
  double finger_radius = 0;  ///< 0: points
  planning::Objective objective = planning::Objective::kSteps;
  bool explain = false;
  HandOptions hand;
  /// File of --hand after ReadHand.
  std::shared_ptr<const kinematics::HandFile> hand_file;
  std::string batch;  ///< file of queries, which override the options
  std::string shard;
  int jobs;
  bool fresh = false;  ///< discard the results of an earlier run
  /// Given options that change results, each with its values.
  std::vector<std::pair<std::string, std::vector<std::string>>> given;
  /// Called once when the search for a hand's plan begins, after the input has been checked.
  std::function<void()> on_search = [] {};

  PlanProgram();
  /// Adds all options to the command line; they are set when it is parsed.
  void AddTo(CLI::App& app);
  /// Check the parsed options.
  /// @throws InputError  if they are inconsistent.
  void Finish(const CLI::App& app);

  /// @throws InputError  if an end is missing or cannot be used with a hand.
  void CheckEnds() const;
  /// Read the hand's file, if there is one.
  /// @throws InputError  if it is not valid.
  void ReadHand();
  /// Plan once, and complete a found plan for writing.
  /// @throws InputError  if object and options are inconsistent.
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
