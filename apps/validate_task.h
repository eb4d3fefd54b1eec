#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/object_shelf.h"
#include "apps/progress.h"
#include "apps/validate_options.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"

namespace regrasp::apps {

/// What the files on the command line ask for.
struct ValidateTask {
  SharedObject object;
  std::string file_text;  ///< of the plan or of the grasp
  plan::Plan plan;        ///< of a grasp: without steps
  grasp::Grasp grasp;     ///< empty for a plan
  /// That the object's file gives, where the plan's contacts are at them.
  std::vector<Eigen::Vector3d> given_points;
  std::string start_text, goal_text;  ///< of --start and --goal; empty where they are not given
  std::optional<kinematics::HandFile> hand;  ///< of --hand
};

/// Return the warnings of the hand's file; empty without --hand.
[[nodiscard]] std::vector<std::string> HandWarnings(const ValidateOptions& options,
                                                    const ValidateTask& task);

/// @throws InputError  an output is another file of the command line, or can't be written.
void CheckOutputs(const ValidateOptions& options);

/// @throws InputError  --contact soft, and the object is planar.
void CheckTorsionFits(const ValidateOptions& options, const object::Object& object);

/// The object of --grasp, --grasps or --export-states, repaired where that is asked.
/// @throws InputError  it is none.
[[nodiscard]] object::ObjectFile ReadGraspObject(const ValidateOptions& options,
                                                 ProgressLine& progress);

/// Reads the object, the plan or the grasp, and what else is named.
/// @throws InputError  a file is no good, or does not go with another one or with an option.
[[nodiscard]] ValidateTask ReadTask(const ValidateOptions& options);

/// Where the objects of many plans come from.
struct PlanObjects {
  ObjectFinder finder;
  ObjectShelf shelf;
};

/// The task of one of many plans, which has no file of its own. Start, goal and hand are left to
/// the caller.
/// @param options  `plan_path` is how messages call the plan.
/// @throws InputError  as ReadTask.
[[nodiscard]] ValidateTask MakePlanTask(const ValidateOptions& options, const std::string& text,
                                        PlanObjects& objects);

}  // namespace regrasp::apps
