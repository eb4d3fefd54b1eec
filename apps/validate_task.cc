#include "apps/validate_task.h"

#include <filesystem>
#include <memory>
#include <system_error>

#include "apps/earlier_run.h"
#include "apps/frame_files.h"
#include "apps/output_files.h"
#include "apps/plan_object.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/repair_module.h"
#include "apps/validate_run.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/criteria/reach.h"
#include "planner/object/body_measures.h"
#include "planner/object/object.h"
#include "planner/object/read_object.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/plan_io.h"
#include "report/report_json.h"
#include "sim/actuation/hand_scene_export.h"

namespace regrasp::apps {
namespace {

OutputFiles OutputsOf(const ValidateOptions& options) {
  OutputFiles outputs;
  if (!options.verify.empty()) return outputs;
  if (options.for_grasps()) {
    outputs.folders.push_back({"--output", options.Folder(),
                               [](const std::string& name) { return name == kVerdictsName; }});
    return outputs;
  }
  if (options.for_states()) {
    if (!options.mjcf.empty()) {
      outputs.folders.push_back({"--export-mjcf", options.mjcf, sim::IsSceneFile});
    }
    outputs.folders.push_back({"--output", options.Folder(),
                               [](const std::string& name) { return name == kStatesName; }});
    return outputs;
  }
  outputs.Add("--junit", options.junit);
  if (options.json != kStandardStream) outputs.Add("--json", options.json);
  outputs.Add("--trajectory", options.trajectory);
  if (options.replay_by_hand && !options.mjcf.empty()) {
    outputs.folders.push_back({"--export-mjcf", options.mjcf, sim::IsSceneFile});
  } else {
    outputs.Add("--export-mjcf", options.mjcf);
  }
  outputs.Add("--video", options.video);
  outputs.folders.push_back({"--output", options.Folder(), IsValidationFile});
  return outputs;
}

/// Check that the options do not contradict the plan's repair of its object.
void CheckRepair(const ValidateOptions& options, const plan::Plan& plan) {
  if (options.repair.shells() && options.repair.shells() != plan.shells) {
    throw InputError("--shells: must match " + options.plan_path + ": /object/shells" +
                     (plan.shells ? "" : ", found a plan without it"));
  }
  if (!options.repair.wanted()) return;
  if (!plan.repair) {
    throw InputError("--repair: cannot be used with " + options.plan_path +
                     ", a plan for an unrepaired object");
  }
  const object::RepairOptions given = options.repair.Get();
  if (given != object::RepairOptions() && given != plan.repair->options) {
    throw InputError("--repair: must match " + options.plan_path + ": /object/repair");
  }
}

void ReadGivenPoints(const std::string& object_path, const object::Reading& reading,
                     ValidateTask& task) {
  if (!task.plan.at_given_points) return;
  if (task.plan.repair && !task.object->repair) {
    throw InputError(object_path + ": the contacts of the plan are at points of " +
                     task.plan.object_file +
                     "; help: pass that file with --object instead of the "
                     "repaired one");
  }
  task.given_points = object::ReadGivenPoints(object_path, reading);
}

/// Parse a plan, and check that the options fit it.
plan::Plan ParsePlanOf(const ValidateOptions& options, const std::string& text) {
  plan::Plan plan = plan::ParsePlan(text, options.plan_path);
  CheckRepair(options, plan);
  return plan;
}

/// Return the reading options for the object of a plan.
object::Reading ReadingOf(const plan::Plan& plan, object::Reading reading) {
  // No verdict depends on these options, but --show clusters computes clusters without rough
  // places.
  if (plan.roadmap && plan.roadmap->roughness) {
    reading.patch = {plan.patch_radius, *plan.roadmap->roughness};
  }
  reading.allow_filled = plan.roadmap && plan.roadmap->allow_filled;
  return reading;
}

/// Return a key of the reading options.
/// Plans with equal keys and files have equal objects.
std::string ReadingKey(const plan::Plan& plan) {
  Json key = Json::array();
  if (plan.repair) {
    const object::RepairOptions& repair = plan.repair->options;
    key = {plan.repair->sha256, repair.max_deviation, report::OrNull(repair.facets),
           report::OrNull(repair.part), report::OrNull(repair.thickness)};
  }
  key.push_back(plan.shells ? static_cast<int>(*plan.shells) : -1);
  if (plan.roadmap && plan.roadmap->roughness) {
    key.push_back(*plan.roadmap->roughness);
    key.push_back(report::OrNull(plan.patch_radius));
  }
  key.push_back(plan.roadmap && plan.roadmap->allow_filled);
  return key.dump();
}

/// Check that the plan fits the object, and read the points that its file gives.
/// @param path  path of the object's file.
void FinishPlanTask(const ValidateOptions& options, const std::string& path,
                    const object::Reading& reading, ValidateTask& task) {
  CheckPlanFits(task.plan, *task.object,
                {options.plan_path, path, options.allow_object_change, options.scale});
  ReadGivenPoints(path, reading, task);
}

void ReadPlanTask(const ValidateOptions& options, const object::Reading& plain,
                  ValidateTask& task) {
  std::error_code error;
  const bool named_by_plan = std::filesystem::is_directory(options.object_path, error);
  task.file_text =
      options.plan_path == kStandardStream ? ReadFile("/dev/stdin") : ReadFile(options.plan_path);
  task.plan = ParsePlanOf(options, task.file_text);
  const object::Reading reading = ReadingOf(task.plan, plain);
  const std::string object_path = ObjectPathOf(options, task.plan.object_file);
  if (named_by_plan) CheckOutputsDiffer({{"--object", object_path}}, OutputsOf(options));
  task.object =
      std::make_shared<const object::ObjectFile>(ReadObjectOf(task.plan, object_path, reading));
  FinishPlanTask(options, object_path, reading, task);
}

/// Refuse a replay by a hand with soft contacts before the long part of the work.
void CheckSoftFingers(const ValidateOptions& options, const plan::Plan& plan) {
  if (options.contact.torsion().value_or(plan.torsion) == 0 || !options.replay_by_hand) return;
  throw InputError("--replay hand: soft-finger contacts not supported, expected hard contacts");
}

/// Check that options and hand fit the object and the plan.
void CheckFits(const ValidateOptions& options, const ValidateTask& task) {
  CheckTorsionFits(options, *task.object->object);
  CheckSoftFingers(options, task.plan);
  if (options.replay.thickness && task.plan.dimension == 3) {
    throw InputError("--thickness: requires a planar object, found the solid " +
                     options.object_path);
  }
  const object::Object& object = *task.object->object;
  if (options.replay.finger_radius) {
    criteria::CheckFingerRadius(object, *options.replay.finger_radius, "--finger-radius");
  } else if (task.plan.finger_radius) {
    criteria::CheckFingerRadius(object, *task.plan.finger_radius,
                                options.plan_path + ": /finger_radius");
  }
}

/// Check the options against plan and object, and parse the required grasps.
void FinishTask(const ValidateOptions& options, ValidateTask& task) {
  CheckFits(options, task);
  if (task.shared.hand) task.shared.hand = kinematics::HandOfPlan(*task.shared.hand, task.plan);
  const object::Object& object = *task.object->object;
  const auto parse = [&](const std::string& text, const std::string& path, grasp::Grasp& grasp) {
    if (!path.empty()) grasp = plan::ParseGrasp(text, path, object);
  };
  parse(task.shared.start_text, options.start, task.start);
  parse(task.shared.goal_text, options.goal, task.goal);
}

}  // namespace

void CheckTorsionFits(const ValidateOptions& options, const object::Object& object) {
  if (options.contact.torsion().value_or(0) == 0) return;
  criteria::CheckTorsion(object, *options.contact.torsion(), "--torsion");
  if (object.dimension() == 3) return;
  throw InputError("--torsion: requires a solid, found the planar object " + options.object_path);
}

void CheckOutputs(const ValidateOptions& options) {
  const OutputFiles outputs = OutputsOf(options);
  const char* input = options.for_states()   ? "--object"
                      : options.for_grasps() ? "--grasps"
                      : options.for_grasp()  ? "--grasp"
                                             : "--plan";
  CheckOutputsDiffer({{"--object", options.object_path},
                      {input, options.InputPath()},
                      {"--start", options.start},
                      {"--goal", options.goal},
                      {"--hand", options.hand},
                      {"--conditions", options.ConditionsFile()}},
                     outputs);
  CheckOutputsWritable(outputs);
}

object::ObjectFile ReadGraspObject(const ValidateOptions& options, ProgressLine& progress) {
  object::Reading reading = {progress.reporter(), {}};
  reading.shells = options.repair.shells();
  reading.on_shells = [&](const std::string& text) {
    progress.Clear();
    if (!options.quiet) PrintMessage(kValidateName, options.object_path + ": " + text);
  };
  if (!options.repair.wanted()) return object::ReadObject(options.object_path, reading);
  return ReadRepaired(options.object_path, options.repair.Get(), reading);
}

std::vector<std::string> HandWarnings(const ValidateOptions& options, const ValidateTask& task) {
  std::vector<std::string> warnings;
  if (!task.shared.hand) return warnings;
  for (const std::string& warning : task.shared.hand->warnings) {
    warnings.push_back(options.hand + ": " + warning);
  }
  return warnings;
}

validation::ValidationOptions ValidationOptionsOf(const ValidateOptions& options) {
  validation::ValidationOptions given;
  given.friction_angle = options.friction.friction_angle();
  given.torsion = options.contact.torsion();
  given.allow_undecided = options.allow_undecided;
  given.certificates = options.certificates;
  given.replay = options.replay;
  given.replay_by_hand = options.replay_by_hand;
  given.hand.tolerance = options.tolerance;
  given.hand.sensing = options.sensing;
  given.hand.tip = options.tip;
  given.hand_check.clearance_m = options.clearance_m;
  given.trials = options.trials;
  given.conditions = options.condition_list;
  given.required_conditions = options.required_conditions;
  given.condition_jobs = options.for_lines() ? 1 : options.jobs;
  return given;
}

validation::ValidationRequest RequestOf(const ValidateOptions& options, const ValidateTask& task) {
  const object::Object& object = *task.object->object;
  const bool with_hand = !options.hand.empty();
  if (with_hand && (object.dimension() != 3 || options.for_grasp())) {
    throw InputError("--hand: requires a solid and a plan for a hand");
  }
  return {.object = object,
          .plan = task.plan,
          .is_grasp = options.for_grasp(),
          .hand = with_hand ? &*task.shared.hand : nullptr,
          .start = options.start.empty() ? nullptr : &task.start,
          .goal = options.goal.empty() ? nullptr : &task.goal,
          .given_points = task.plan.at_given_points ? &task.given_points : nullptr,
          .options = ValidationOptionsOf(options),
          .plan_name = options.plan_path};
}

validation::ValidationResult ValidateFiles(const ValidateOptions& options, const ValidateTask& task,
                                           const validation::ValidationObserver& observer) {
  validation::ValidationResult result = validation::Validate(RequestOf(options, task), observer);
  const object::ObjectFile& object = *task.object;
  result.report.measures += object::UnitText(object.unit);
  result.report.has_no_unit = object.unit.empty();
  result.report.object_file = object.file;
  result.report.object_sha256 = object.sha256;
  return result;
}

SharedInputs ReadSharedInputs(const ValidateOptions& options) {
  SharedInputs shared;
  if (!options.start.empty()) shared.start_text = ReadFile(options.start);
  if (!options.goal.empty()) shared.goal_text = ReadFile(options.goal);
  if (!options.hand.empty()) shared.hand = kinematics::ReadHandFile(options.hand);
  return shared;
}

ValidateTask ReadTask(const ValidateOptions& options) {
  ProgressLine progress(options.quiet);
  const object::Reading reading = {progress.reporter(), {}};
  ValidateTask task;
  if (options.for_grasp()) {
    task.object = std::make_shared<const object::ObjectFile>(ReadGraspObject(options, progress));
    task.file_text = ReadFile(options.grasp_path);
    const grasp::Grasp grasp =
        plan::ParseGrasp(task.file_text, options.grasp_path, *task.object->object);
    task.plan = validation::MakeHoldPlan(*task.object->object, grasp,
                                         options.friction.required_friction_angle(),
                                         options.scale.value_or(1));
    plan::SetTorsion(options.contact.torsion().value_or(0), task.plan);
  } else {
    ReadPlanTask(options, reading, task);
  }
  task.shared = ReadSharedInputs(options);
  FinishTask(options, task);
  return task;
}

ValidateTask MakePlanTask(const ValidateOptions& options, const std::string& text,
                          const SharedInputs& shared, PlanObjects& objects) {
  ValidateTask task;
  task.file_text = text;
  task.shared = shared;
  task.plan = ParsePlanOf(options, text);
  const plan::Plan& plan = task.plan;
  const object::Reading reading = ReadingOf(plan, {});
  const std::string path =
      objects.finder.Find(plan.object_file, plan.object_sha256, options.plan_path);
  task.object = objects.object_cache.Get(path + " " + ReadingKey(plan),
                                         [&] { return ReadObjectOf(plan, path, reading); });
  FinishPlanTask(options, path, reading, task);
  FinishTask(options, task);
  return task;
}

}  // namespace regrasp::apps
