#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/certificate/finish_plan.h"
#include "planner/criteria/reach.h"
#include "planner/gait/plan_in_hand.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/grasp_io.h"
#include "planner/plan/plan_io.h"
#include "planner/planning/solve.h"
#include "planner/registry/registry.h"
#include "planner/roadmap/build_roadmap.h"
#include "python/binding.h"
#include "python/interrupt.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

constexpr char kRandom[] = "random";
constexpr char kRandomAny[] = "random-any";

struct PlanArguments {
  std::string start, goal;  ///< the text of a grasp file, or "random" or "random-any"
  double half_angle = 0;
  std::string planner;
  planning::Objective objective = planning::Objective::kSteps;
  std::uint64_t seed = 0;
  double min_quality = 0;
  double finger_radius = 0;
  std::optional<int> contacts, clusters;
  std::optional<double> time_limit_s;
};

/// What is asked of a hand; poses are a position and a quaternion w, x, y, z.
struct HandPlanArguments {
  std::string start, goal;  ///< the text of a grasp file, or empty
  double half_angle = 0;
  Eigen::Vector3d turn_axis = Eigen::Vector3d::UnitZ();
  double turn_angle = 0;  ///< radians
  std::optional<std::array<double, 7>> start_pose, goal_pose;
  double clearance = 1e-3;
  gait::Reserve reserve = gait::Reserve::kPreferred;
  std::uint64_t seed = 0;
  double min_quality = 0;
  std::optional<double> time_limit_s;
};

std::optional<Eigen::Isometry3d> PoseOf(const std::optional<std::array<double, 7>>& numbers) {
  if (!numbers) return std::nullopt;
  const auto& v = *numbers;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(v[3], v[4], v[5], v[6]).normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(v[0], v[1], v[2]);
  return pose;
}

planning::PlanResult FindInHand(const PythonObject& object, const PythonHand& hand,
                                const HandPlanArguments& given, Interrupt& interrupt) {
  const auto& solid = dynamic_cast<const object::Polyhedron&>(*object.file.object);
  gait::GaitRequest request;
  request.hand = &hand.file.hand;
  request.solid = &solid;
  request.scale = object.scale;
  request.criteria.half_angle = given.half_angle;
  request.criteria.min_quality = given.min_quality;
  request.reserve = given.reserve;
  request.margin = given.clearance;
  if (given.turn_angle != 0) request.turn = {given.turn_axis, given.turn_angle};
  request.start_pose = PoseOf(given.start_pose);
  request.goal_pose = PoseOf(given.goal_pose);
  // A grasp for another one, and no word of the pose: the object stays where it is.
  if (given.turn_angle == 0 && !request.goal_pose) request.goal_pose = request.start_pose;
  for (const auto& [name, text, grasp] : {std::tuple("start", &given.start, &request.start_grasp),
                                          {"goal", &given.goal, &request.goal_grasp}}) {
    if (text->empty()) continue;
    *grasp = plan::ParseGrasp(*text, name, solid);
    gait::CheckHandGrasp(*grasp, *request.hand, name);
  }
  request.seed = given.seed;
  request.deadline = interrupt.deadline();
  request.progress = interrupt.progress();
  return gait::PlanInHand(request);
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
                          Interrupt& interrupt) {
  const object::Object& body = *object.file.object;
  criteria::CheckFingerRadius(body, given.finger_radius, "finger_radius");
  planning::PlanRequest request;
  request.object = &body;
  request.object_name = object.file.file;
  request.criteria.half_angle = given.half_angle;
  request.criteria.min_quality = given.min_quality;
  request.hand.fingertip_radius = given.finger_radius;
  request.objective = given.objective;
  request.seed = given.seed;
  request.contact_points = given.contacts;
  request.clusters = given.clusters;
  request.deadline = interrupt.deadline();
  request.progress = interrupt.progress();
  const planning::Planner& planner = registry::PlannerFor(given.planner, request);
  if (const auto need = planner.EstimateMemory(request)) {
    const std::string why = MemoryComplaint(*need, UsableMemory());
    if (!why.empty()) throw InputError(object.file.file + ": " + why);
  }
  const bool any = given.planner == "auto";
  request.start = Choose("start", given.start, any, body);
  request.goal = Choose("goal", given.goal, any, body);
  return planning::Solve(planner, request);
}

/// The plan's text or None, why there is none, warnings, notes.
py::tuple FindPlan(const PythonObject& object, double half_angle,
                   std::optional<double> time_limit_s, py::object progress,
                   const std::function<planning::PlanResult(Interrupt&)>& find) {
  Interrupt interrupt(time_limit_s, std::move(progress));
  planning::PlanResult result;
  std::optional<std::string> text;
  {
    const py::gil_scoped_release unlocked;
    try {
      result = find(interrupt);
    } catch (const TimeUp&) {
      if (!interrupt.raised()) throw;
    }
    if (result.plan) {
      const plan::PlanCheck check = certificate::FinishPlan(
          object.file, {.half_angle = half_angle, .scale = object.scale}, *result.plan);
      if (!check.passed()) result.warnings.emplace_back("the checker fails this plan");
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
      .def_readwrite("half_angle", &PlanArguments::half_angle)
      .def_readwrite("planner", &PlanArguments::planner)
      .def_readwrite("objective", &PlanArguments::objective)
      .def_readwrite("seed", &PlanArguments::seed)
      .def_readwrite("min_quality", &PlanArguments::min_quality)
      .def_readwrite("finger_radius", &PlanArguments::finger_radius)
      .def_readwrite("contacts", &PlanArguments::contacts)
      .def_readwrite("clusters", &PlanArguments::clusters)
      .def_readwrite("time_limit_s", &PlanArguments::time_limit_s);
  module.def(
      "find_plan", [](const PythonObject& object, const PlanArguments& given, py::object progress) {
        return FindPlan(object, given.half_angle, given.time_limit_s, std::move(progress),
                        [&](Interrupt& interrupt) { return Find(object, given, interrupt); });
      });
  py::enum_<gait::Reserve>(module, "Reserve")
      .value("preferred", gait::Reserve::kPreferred)
      .value("required", gait::Reserve::kRequired)
      .value("none", gait::Reserve::kNone);
  py::class_<HandPlanArguments>(module, "HandPlanArguments")
      .def(py::init<>())
      .def_readwrite("start", &HandPlanArguments::start)
      .def_readwrite("goal", &HandPlanArguments::goal)
      .def_readwrite("half_angle", &HandPlanArguments::half_angle)
      .def_readwrite("turn_axis", &HandPlanArguments::turn_axis)
      .def_readwrite("turn_angle", &HandPlanArguments::turn_angle)
      .def_readwrite("start_pose", &HandPlanArguments::start_pose)
      .def_readwrite("goal_pose", &HandPlanArguments::goal_pose)
      .def_readwrite("clearance", &HandPlanArguments::clearance)
      .def_readwrite("reserve", &HandPlanArguments::reserve)
      .def_readwrite("seed", &HandPlanArguments::seed)
      .def_readwrite("min_quality", &HandPlanArguments::min_quality)
      .def_readwrite("time_limit_s", &HandPlanArguments::time_limit_s);
  module.def("find_plan_in_hand", [](const PythonObject& object, const PythonHand& hand,
                                     const HandPlanArguments& given, py::object progress) {
    return FindPlan(
        object, given.half_angle, given.time_limit_s, std::move(progress),
        [&](Interrupt& interrupt) { return FindInHand(object, hand, given, interrupt); });
  });
  module.def("planner_names", [] {
    std::vector<std::string> names;
    for (const planning::Planner* planner : registry::AllPlanners()) {
      names.push_back(planner->name());
    }
    return names;
  });
  module.def("check_plan_text", [](const std::string& text, const std::string& name) {
    static_cast<void>(plan::ParsePlan(text, name));
  });
}

}  // namespace regrasp::python
