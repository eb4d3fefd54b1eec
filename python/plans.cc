#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/memory.h"
#include "planner/certificate/finish_plan.h"
#include "planner/criteria/reach.h"
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
  planning::PlanResult result = planning::Solve(planner, request);
  if (!result.plan) return result;
  const plan::PlanCheck check = certificate::FinishPlan(
      object.file, {.half_angle = given.half_angle, .scale = object.scale}, *result.plan);
  if (!check.passed()) result.warnings.emplace_back("the checker fails this plan");
  return result;
}

/// The plan's text or None, why there is none, warnings, notes.
py::tuple FindPlan(const PythonObject& object, const PlanArguments& given, py::object progress) {
  Interrupt interrupt(given.time_limit_s, std::move(progress));
  planning::PlanResult result;
  std::optional<std::string> text;
  {
    const py::gil_scoped_release unlocked;
    try {
      result = Find(object, given, interrupt);
    } catch (const TimeUp&) {
      if (!interrupt.raised()) throw;
    }
    if (result.plan) text = plan::FormatPlan(*result.plan);
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
  module.def("find_plan", FindPlan);
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
