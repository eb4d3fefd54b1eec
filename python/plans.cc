#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/certificate/align_certificate.h"
#include "planner/criteria/reach.h"
#include "planner/gait/gait_planner.h"
#include "planner/gait/goal_list.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/goal_set_io.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/plan_io.h"
#include "planner/planning/in_hand_task.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "planner/roadmap/roadmap_parameters.h"
#include "python/binding.h"
#include "sim/actuation/simulate_execution.h"
#include "sim/hand_grasps/fingertip_grasp.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

constexpr char kRandom[] = "random";
constexpr char kRandomAny[] = "random-any";

struct PlanArguments {
  /// Text of a grasp file, "random" or "random-any"; with a hand it may be empty, for any grasp.
  std::string start, goal;
  double friction_angle = 0;
  std::string planner = "auto";
  planning::Objective objective = planning::Objective::kSteps;
  std::uint64_t seed = 0;
  double min_quality = 0;
  double finger_radius = 0;
  double torsion = 0;  ///< torsional friction length of soft fingers, object units
  std::optional<int> contacts, clusters;
  std::optional<double> time_limit_s;
  int jobs = 1;  ///< number of concurrent searches, ≥ 1
};

/// Task of a hand; poses are a position and a quaternion w, x, y, z.
struct HandArguments {
  Eigen::Vector3d turn_axis = Eigen::Vector3d::UnitZ();
  double turn_angle = 0;  ///< radians
  std::optional<std::array<double, 7>> start_pose, goal_pose;
  /// Unit vectors against gravity in the palm frame, to try in this order; empty: the hand's own.
  std::vector<Eigen::Vector3d> ups;
  std::optional<double> mass_kg;     ///< mass of the object; nullopt: the density of water
  bool gravity_support = false;      ///< whether grasps may hold the object by its weight
  bool rolls = false;                ///< whether fingertips roll
  std::optional<std::string> goals;  ///< text of a file of goals
  std::string goals_name;            ///< name of this text in messages
  double clearance = 1e-3;
  planning::RobustnessLevel robustness = planning::RobustnessLevel::kRequired;
  bool is_standard = false;  ///< whether plans must execute under PlanningRobustness::kStandard
  std::string start_hand_grasp, goal_hand_grasp;  ///< lines of hand grasps; empty: none
};

std::optional<Eigen::Isometry3d> PoseOf(const std::optional<std::array<double, 7>>& numbers) {
  if (!numbers) return std::nullopt;
  const auto& v = *numbers;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(v[3], v[4], v[5], v[6]).normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return pose;
}

std::optional<plan::GoalSet> GoalOf(const HandArguments& given) {
  if (const auto pose = PoseOf(given.goal_pose)) return plan::GoalSet(*pose);
  return std::nullopt;
}

std::vector<plan::NamedGoal> GoalsOf(const HandArguments& given, const PythonHand& hand) {
  if (!given.goals) return {};
  return plan::ParseGoalList(*given.goals, given.goals_name,
                             given.ups.empty() ? hand.file.hand.up : given.ups.front());
}

planning::InHandTask TaskOf(const PythonObject& object, const PythonHand& hand,
                            const HandArguments& given) {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*object.file.object);
  return {.hand = &hand.file.hand,
          .scale = object.scale,
          .robustness = given.robustness,
          .margin = given.clearance,
          .turn = {given.turn_axis, given.turn_angle},
          .start_pose = PoseOf(given.start_pose),
          .goal = GoalOf(given),
          .goals = GoalsOf(given, hand),
          .ups = given.ups,
          .gravity_support =
              given.gravity_support ? std::optional(plan::GravitySupport()) : std::nullopt,
          .mass_kg = given.mass_kg,
          .rolls = given.rolls,
          .simulate = sim::ExecutionSimulator(
              hand.file, solid,
              sim::PlanningConditions(given.is_standard ? sim::PlanningRobustness::kStandard
                                                        : sim::PlanningRobustness::kNominal)),
          .rate = sim::ExecutionRater(hand.file, solid),
          .measure_force = sim::GraspForceMeter(hand.file, solid)};
}

/// Let a task start and end at hand grasps, if there are any.
void UseHandGrasps(const PythonObject& object, const PythonHand& hand, const HandArguments& asked,
                   planning::InHandTask& task, PlanArguments& given) {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*object.file.object);
  const auto state_of = [&](const std::string& text, const char* name) {
    return sim::FingertipGraspOf(sim::ParseHandGrasp(text, name),
                                 {hand.file, solid, object.file.file, object.scale, task.margin},
                                 name);
  };
  const auto contacts_of = [&](const plan::HandEnd& end) {
    return plan::FormatGrasp(plan::ContactsOf(end.grasp), solid.dimension());
  };
  std::optional<plan::HandEnd> begin;
  if (!asked.start_hand_grasp.empty()) {
    begin = state_of(asked.start_hand_grasp, "start");
    given.start = contacts_of(*begin);
    gait::StartFrom(*begin, task);
  }
  if (asked.goal_hand_grasp.empty()) return;
  plan::HandEnd end = state_of(asked.goal_hand_grasp, "goal");
  if (begin) sim::KeepContacts(*begin, object.scale, end);
  given.goal = contacts_of(end);
  gait::EndAt(end, {}, task);
}

planning::GraspChoice Choose(const char* name, const std::string& value, bool any,
                             const object::Object& object) {
  using Kind = planning::GraspChoice::Kind;
  if (value == kRandom || value == kRandomAny) {
    return {any || value == kRandomAny ? Kind::kRandomAny : Kind::kRandom,
            {},
            std::string(name) + " " + value};
  }
  return {Kind::kGiven, plan::ParseGrasp(value, name, object), name};
}

planning::PlanResult Find(const PythonObject& object, const PlanArguments& given,
                          const std::optional<planning::InHandTask>& task, Interrupt& interrupt) {
  const object::Object& body = *object.file.object;
  criteria::CheckFingerRadius(body, given.finger_radius, "finger_radius");
  criteria::CheckTorsion(body, given.torsion, "torsion");
  planning::PlanRequest request;
  request.object = &body;
  request.object_name = object.file.file;
  request.criteria.friction_angle = given.friction_angle;
  request.criteria.min_quality = given.min_quality;
  request.hand.fingertip_radius = given.finger_radius;
  request.hand.torsion = given.torsion;
  request.objective = given.objective;
  request.seed = given.seed;
  auto& roadmap = request.parameters.Edit<roadmap::RoadmapParameters>();
  roadmap.contact_points = given.contacts;
  roadmap.clusters = given.clusters;
  request.jobs = given.jobs;
  request.deadline = interrupt.deadline();
  request.progress = interrupt.progress();
  if (task) gait::AskInHand(*task, request);
  const planning::Planner& planner = registry::PlannerFor(given.planner, request);
  if (const auto need = planner.EstimateMemory(request)) {
    const std::string why = MemoryComplaint(*need, UsableMemory());
    if (!why.empty()) throw InputError(object.file.file + ": " + why);
  }
  const bool any = given.planner == "auto";
  if (!given.start.empty()) request.start = Choose("start", given.start, any, body);
  if (!given.goal.empty()) request.goal = Choose("goal", given.goal, any, body);
  return planning::Solve(planner, request);
}

/// Return the plan's text or None, the reason if there is none, warnings, and notes.
py::tuple FindPlan(const PythonObject& object, const PlanArguments& given, py::object progress,
                   const std::optional<planning::InHandTask>& task) {
  Interrupt interrupt(given.time_limit_s, std::move(progress));
  planning::PlanResult result;
  std::optional<std::string> text;
  {
    const py::gil_scoped_release unlocked;
    try {
      const auto find = [&] { return Find(object, given, task, interrupt); };
      result = given.jobs > 1 ? interrupt.Run(find) : find();
    } catch (const TimeUp&) {
      if (!interrupt.raised()) throw;
    }
    if (result.plan) {
      const plan::PlanCheck check = certificate::FinishPlan(
          object.file,
          {.friction_angle = given.friction_angle, .scale = object.scale, .shells = object.shells},
          *result.plan);
      for (std::string& warning : certificate::PlanWarnings(*object.file.object, check)) {
        result.warnings.push_back(std::move(warning));
      }
      text = plan::FormatPlan(*result.plan);
    }
  }
  interrupt.ThrowIfRaised();
  return py::make_tuple(text, result.message, result.warnings, result.notes);
}

}  // namespace

void BindPlans(py::module_& module) {
  py::enum_<planning::Objective>(module, "Objective")
      .value("steps", planning::Objective::kSteps)
      .value("margin", planning::Objective::kMargin)
      .value("travel", planning::Objective::kTravel)
      .value("regions", planning::Objective::kRegions);
  module.attr("fewest_clusters") = roadmap::kFewestClusters;
  module.attr("most_clusters") = roadmap::kMostClusters;
  module.attr("most_contacts") = roadmap::kMaxClusteredContacts;
  py::class_<PlanArguments>(module, "PlanArguments")
      .def(py::init<>())
      .def_readwrite("start", &PlanArguments::start)
      .def_readwrite("goal", &PlanArguments::goal)
      .def_readwrite("half_angle", &PlanArguments::friction_angle)
      .def_readwrite("planner", &PlanArguments::planner)
      .def_readwrite("objective", &PlanArguments::objective)
      .def_readwrite("seed", &PlanArguments::seed)
      .def_readwrite("min_quality", &PlanArguments::min_quality)
      .def_readwrite("finger_radius", &PlanArguments::finger_radius)
      .def_readwrite("torsion", &PlanArguments::torsion)
      .def_readwrite("contacts", &PlanArguments::contacts)
      .def_readwrite("clusters", &PlanArguments::clusters)
      .def_readwrite("time_limit_s", &PlanArguments::time_limit_s)
      .def_readwrite("jobs", &PlanArguments::jobs);
  module.def("find_plan",
             [](const PythonObject& object, const PlanArguments& given, py::object progress) {
               return FindPlan(object, given, std::move(progress), std::nullopt);
             });
  py::enum_<planning::RobustnessLevel>(module, "RobustnessLevel")
      .value("preferred", planning::RobustnessLevel::kPreferred)
      .value("required", planning::RobustnessLevel::kRequired)
      .value("none", planning::RobustnessLevel::kNone);
  py::class_<HandArguments>(module, "HandArguments")
      .def(py::init<>())
      .def_readwrite("turn_axis", &HandArguments::turn_axis)
      .def_readwrite("turn_angle", &HandArguments::turn_angle)
      .def_readwrite("start_pose", &HandArguments::start_pose)
      .def_readwrite("goal_pose", &HandArguments::goal_pose)
      .def_readwrite("ups", &HandArguments::ups)
      .def_readwrite("gravity_support", &HandArguments::gravity_support)
      .def_readwrite("mass_kg", &HandArguments::mass_kg)
      .def_readwrite("rolls", &HandArguments::rolls)
      .def_readwrite("goals", &HandArguments::goals)
      .def_readwrite("goals_name", &HandArguments::goals_name)
      .def_readwrite("clearance", &HandArguments::clearance)
      .def_readwrite("robustness", &HandArguments::robustness)
      .def_readwrite("is_standard", &HandArguments::is_standard)
      .def_readwrite("start_hand_grasp", &HandArguments::start_hand_grasp)
      .def_readwrite("goal_hand_grasp", &HandArguments::goal_hand_grasp);
  module.def("up_directions",
             [](const PythonHand& hand) { return kinematics::UpDirections(hand.file.hand); });
  module.def("find_plan_in_hand",
             [](const PythonObject& object, PlanArguments given, const PythonHand& hand,
                const HandArguments& asked, py::object progress) {
               planning::InHandTask task = TaskOf(object, hand, asked);
               UseHandGrasps(object, hand, asked, task, given);
               return FindPlan(object, given, std::move(progress), task);
             });
  // Planners for fingers without a hand.
  module.def("planner_names", [] {
    std::vector<std::string> names;
    for (const planning::Planner* planner : registry::AllPlanners()) {
      if (!planner->traits().needs_hand) names.push_back(planner->name());
    }
    return names;
  });
  module.def("check_plan_text", [](const std::string& text, const std::string& name) {
    static_cast<void>(plan::ParsePlan(text, name));
  });
}

}  // namespace regrasp::python
