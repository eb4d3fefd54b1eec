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

#include "apps/hand_grasp_end.h"
#include "apps/hand_options.h"
#include "apps/planner_options.h"
#include "planner/criteria/grasp_criteria.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/check.h"
#include "planner/planning/in_hand_task.h"
#include "planner/planning/planner.h"

namespace regrasp::apps {

/// Name of the program, printed before its messages.
inline constexpr char kPlanName[] = "plan";

/// Start or goal on the command line.
struct PlanEnd {
  std::string option;  ///< name of the option: "--start"
  std::string value;   ///< FILE, FILE:NAME, "random" or "random-any"; empty: not given
  std::string text;    ///< text of the grasp, instead of a file
  std::string name;    ///< name of `text` in messages
  /// Hand grasp of the file or text. Set by PlanProgram::ReadHandGrasps.
  std::optional<NamedHandGrasp> hand_grasp = {};

  [[nodiscard]] bool given() const { return !value.empty() || !text.empty(); }
  [[nodiscard]] bool is_random() const;
};

/// Points of the object's file that contacts must be at, if required.
using GivenPoints = std::optional<std::vector<Eigen::Vector3d>>;

/// Result of planning and of the checker.
struct FinishedPlan {
  planning::PlanResult result;
  plan::PlanCheck check;  ///< result of the checker, if there is a plan
};

/// Options of `plan`.
struct PlanProgram {
  PlannerOptions common;
  PlanEnd start{"--start", "", "", ""};
  PlanEnd goal{"--goal", "", "", ""};
  std::vector<std::string> outputs;  ///< all files of --output
  std::string output;  ///< plan file, "-" for standard output; empty: none. Set by Finish
  std::string page;    ///< HTML page of the plan; empty: none. Set by Finish
  double min_quality = criteria::GraspCriteria().min_quality;
  double finger_radius = 0;  ///< radius of the fingertips; 0: points
  planning::Objective objective = planning::Objective::kSteps;
  bool explain = false;
  HandOptions hand;
  /// File of --hand after ReadHand.
  std::shared_ptr<const kinematics::HandFile> hand_file;
  /// Plan of --continue after ReadHand; null: none.
  std::shared_ptr<const plan::Plan> continued;
  bool continues_rolled = false;  ///< whether fingertips roll in `continued`
  std::string batch;              ///< file of queries, which override the options
  std::string shard;
  int jobs;
  bool fresh = false;  ///< whether to discard the results of an earlier run
  /// Options of the command line that change results, each with its values.
  std::vector<std::pair<std::string, std::vector<std::string>>> given;
  /// Names of all options that change plans, given or not. Set by Finish with --batch.
  std::vector<std::string> options_of_plans;
  /// Function that is called once, when the search for a hand's plan begins.
  /// The input has been checked by then.
  std::function<void()> on_search = [] {};

  PlanProgram();
  /// Add all options to the command line; parsing sets them.
  void AddTo(CLI::App& app);
  /// Check the parsed options.
  /// @throws InputError  if they are inconsistent.
  void Finish(const CLI::App& app);

  /// Read start and goal if they are hand grasps.
  /// @throws InputError  if one of them is not valid.
  void ReadHandGrasps();
  /// Check that start and goal are given, as far as they are required.
  /// @throws InputError  if one is missing or cannot be used with a hand.
  void CheckEnds() const;
  /// Read the hand's file, if there is one.
  /// @throws InputError  if it is not valid.
  void ReadHand();
  /// Return the mass of the object in simulation, kg: that of --mass, otherwise that of the plan of
  /// --continue. nullopt: that of the density of water.
  [[nodiscard]] std::optional<double> MassInSimulation() const;
  /// Plan once, and complete a found plan for writing.
  /// @throws InputError  if object and options are inconsistent.
  [[nodiscard]] FinishedPlan Plan(const object::ObjectFile& object, const GivenPoints& given) const;

 private:
  void AddEnds(CLI::App& app);
  void AddSearch(CLI::App& app);
  void AddBatch(CLI::App& app);
  /// Read the plan of --continue, and check that it is for the hand.
  void ReadContinuedPlan();
  [[nodiscard]] planning::GraspChoice Choose(const PlanEnd& end,
                                             const object::Object& object) const;
  /// Check that the hand executes the plan of --continue up to its end, by the hand check.
  /// @throws InputError  with the first fault.
  void CheckContinued(const object::Polyhedron& solid) const;
  /// Return the state of a hand grasp.
  [[nodiscard]] plan::HandEnd StateOf(const NamedHandGrasp& given, const object::ObjectFile& object,
                                      double clearance) const;
  /// Return the task of the options, with the poses of hand grasps and of --continue. Sets the
  /// contacts of ends that are hand grasps as text.
  [[nodiscard]] planning::InHandTask TaskFor(const object::ObjectFile& object, PlanEnd& from,
                                             PlanEnd& to) const;
  [[nodiscard]] planning::PlanRequest RequestFor(const object::Object& object) const;
  [[nodiscard]] planning::PlanResult Find(const object::ObjectFile& object,
                                          const GivenPoints& given) const;
};

}  // namespace regrasp::apps
