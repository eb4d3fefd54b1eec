#include "apps/validate_task.h"

#include <filesystem>
#include <memory>
#include <system_error>

#include "apps/frame_files.h"
#include "apps/grasps_run.h"
#include "apps/output_files.h"
#include "apps/plan_object.h"
#include "apps/program.h"
#include "apps/progress.h"
#include "apps/repair_module.h"
#include "apps/run_digest.h"
#include "apps/states_run.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/criteria/reach.h"
#include "planner/object/given_points.h"
#include "planner/object/reading.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/plan_io.h"
#include "report/report.h"
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

/// A plan says itself how its object was repaired, and which of its shells it is.
void CheckRepair(const ValidateOptions& options, const plan::Plan& plan) {
  if (options.repair.shells() && options.repair.shells() != plan.shells) {
    throw InputError("--shells: " + options.plan_path + ": /object/shells says " +
                     (plan.shells ? "otherwise" : "nothing: the plan's object is one solid"));
  }
  if (!options.repair.wanted()) return;
  if (!plan.repair) {
    throw InputError("--repair: " + options.plan_path +
                     " was made for an object as its file has it");
  }
  const object::RepairOptions given = options.repair.Get();
  if (given != object::RepairOptions() && given != plan.repair->options) {
    throw InputError("--repair: " + options.plan_path +
                     ": /object/repair says how its object was repaired, and it was otherwise");
  }
}

void ReadGivenPoints(const std::string& object_path, const object::Reading& reading,
                     ValidateTask& task) {
  if (!task.plan.at_given_points) return;
  if (task.plan.repair && !task.object->repair) {
    throw InputError(object_path + ": the contacts of the plan are at points of " +
                     task.plan.object_file +
                     "; give that file (--object), not what a repair made "
                     "of it");
  }
  task.given_points = object::ReadGivenPoints(object_path, reading);
}

/// The plan that a text is, as options and task go together.
plan::Plan ParsePlanOf(const ValidateOptions& options, const std::string& text) {
  plan::Plan plan = plan::ParsePlan(text, options.plan_path);
  CheckRepair(options, plan);
  return plan;
}

/// How the object of a plan is read.
object::Reading ReadingOf(const plan::Plan& plan, object::Reading reading) {
  // Nothing is judged by these, but the clusters that are shown are made on places without them.
  if (plan.roadmap && plan.roadmap->roughness) {
    reading.patch = {plan.patch_radius, *plan.roadmap->roughness};
  }
  reading.allow_invented = plan.roadmap && plan.roadmap->allow_invented;
  return reading;
}

/// The same in a text: plans with the same text have the same object, if they have the same file.
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
  key.push_back(plan.roadmap && plan.roadmap->allow_invented);
  return key.dump();
}

/// @param path  of the object that the task has.
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

/// What is known of hard points alone is refused before any work is done.
void CheckSoftFingers(const ValidateOptions& options, const plan::Plan& plan) {
  if (options.contact.torsion().value_or(plan.torsion) == 0 || !options.replay_by_hand) return;
  throw InputError(
      "--replay hand: a hand's fingertips are hard points, and these contacts are soft fingers");
}

void CheckBody(const ValidateOptions& options, const ValidateTask& task) {
  CheckTorsionFits(options, *task.object->object);
  CheckSoftFingers(options, task.plan);
  if (options.replay.thickness && task.plan.dimension == 3) {
    throw InputError("--thickness: " + options.object_path + " is a solid, not a planar object");
  }
  const object::Object& object = *task.object->object;
  if (options.replay.finger_radius) {
    criteria::CheckFingerRadius(object, *options.replay.finger_radius, "--finger-radius");
  } else if (task.plan.finger_radius) {
    criteria::CheckFingerRadius(object, *task.plan.finger_radius,
                                options.plan_path + ": /finger_radius");
  }
}

}  // namespace

void CheckTorsionFits(const ValidateOptions& options, const object::Object& object) {
  if (options.contact.torsion().value_or(0) == 0 || object.dimension() == 3) return;
  throw InputError("--torsion: " + options.object_path +
                   " is planar, and no contact has a torque about its normal there");
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
                      {"--hand", options.hand}},
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
  if (!task.hand) return warnings;
  for (const std::string& warning : task.hand->warnings) {
    warnings.push_back(options.hand + ": " + warning);
  }
  return warnings;
}

ValidateTask ReadTask(const ValidateOptions& options) {
  ProgressLine progress(options.quiet);
  const object::Reading reading = {progress.reporter(), {}};
  ValidateTask task;
  if (options.for_grasp()) {
    task.object = std::make_shared<const object::ObjectFile>(ReadGraspObject(options, progress));
    task.file_text = ReadFile(options.grasp_path);
    task.grasp = plan::ParseGrasp(task.file_text, options.grasp_path, *task.object->object);
    const double torsion = options.contact.torsion().value_or(0);
    for (grasp::Contact& contact : task.grasp) contact.torsion = torsion;
    task.plan =
        report::MakeHoldPlan(*task.object->object, task.grasp,
                             options.friction.required_half_angle(), options.scale.value_or(1));
  } else {
    ReadPlanTask(options, reading, task);
  }
  if (!options.start.empty()) task.start_text = ReadFile(options.start);
  if (!options.goal.empty()) task.goal_text = ReadFile(options.goal);
  if (!options.hand.empty()) task.hand = kinematics::ReadHandFile(options.hand);
  CheckBody(options, task);
  return task;
}

ValidateTask MakePlanTask(const ValidateOptions& options, const std::string& text,
                          PlanObjects& objects) {
  ValidateTask task;
  task.file_text = text;
  task.plan = ParsePlanOf(options, text);
  const plan::Plan& plan = task.plan;
  const object::Reading reading = ReadingOf(plan, {});
  const std::string path =
      objects.finder.Find(plan.object_file, plan.object_sha256, options.plan_path);
  task.object = objects.shelf.Get(path + " " + ReadingKey(plan),
                                  [&] { return ReadObjectOf(plan, path, reading); });
  FinishPlanTask(options, path, reading, task);
  CheckBody(options, task);
  return task;
}

}  // namespace regrasp::apps
