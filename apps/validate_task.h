#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/batch/object_cache.h"
#include "apps/progress.h"
#include "apps/validate_options.h"
#include "planner/kinematics/hand_file.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "sim/validation/validation.h"

namespace regrasp::apps {

/// Inputs that all plans of a command line share.
struct SharedInputs {
  std::string start_text, goal_text;         ///< texts of --start and --goal; empty: not given
  std::optional<kinematics::HandFile> hand;  ///< hand of --hand
};

/// A plan or a grasp with the files that it is validated against.
struct ValidateTask {
  SharedObject object;
  std::string file_text;  ///< text of the plan or of the grasp
  plan::Plan plan;        ///< the plan; for a grasp, the plan that holds it
  /// Points that the object's file gives, if the plan's contacts are at them.
  std::vector<Eigen::Vector3d> given_points;
  SharedInputs shared;
  grasp::Grasp start, goal;  ///< grasps of --start and --goal
};

/// Return the warnings of the hand's file; empty without --hand.
[[nodiscard]] std::vector<std::string> HandWarnings(const ValidateOptions& options,
                                                    const ValidateTask& task);

/// Return the options of a validation that the command line gives.
[[nodiscard]] validation::ValidationOptions ValidationOptionsOf(const ValidateOptions& options);

/// Return the request to validate a task, which must outlive it.
[[nodiscard]] validation::ValidationRequest RequestOf(const ValidateOptions& options,
                                                      const ValidateTask& task);

/// Validate a task. The report has the name and the digest of the object's file.
/// @throws InputError  if plan, object and options are inconsistent.
[[nodiscard]] validation::ValidationResult ValidateFiles(
    const ValidateOptions& options, const ValidateTask& task,
    const validation::ValidationObserver& observer = {});

/// Check that outputs can be written and are not inputs.
/// @throws InputError  if an output is another file of the command line, or cannot be written.
void CheckOutputs(const ValidateOptions& options);

/// Check that a planar object has no torsional friction.
/// @throws InputError  if --torsion is given for a planar object.
void CheckTorsionFits(const ValidateOptions& options, const object::Object& object);

/// Read the object of --grasp, --grasps or --export-states.
/// The object is repaired if requested.
/// @throws InputError  if the file is not an object.
[[nodiscard]] object::ObjectFile ReadGraspObject(const ValidateOptions& options,
                                                 ProgressLine& progress);

/// Read --start, --goal and --hand.
[[nodiscard]] SharedInputs ReadSharedInputs(const ValidateOptions& options);

/// Read all files of the command line.
/// These are the object, the plan or the grasp, and SharedInputs.
/// @throws InputError  if a file is invalid, or does not fit another file or an option.
[[nodiscard]] ValidateTask ReadTask(const ValidateOptions& options);

/// Sources of the objects of many plans.
struct PlanObjects {
  ObjectFinder finder;
  ObjectCache object_cache;
};

/// Make the task of one of many plans, which has no separate file.
/// @param options  options whose `plan_path` is the name of the plan in messages.
/// @throws InputError  as ReadTask.
[[nodiscard]] ValidateTask MakePlanTask(const ValidateOptions& options, const std::string& text,
                                        const SharedInputs& shared, PlanObjects& objects);

}  // namespace regrasp::apps
