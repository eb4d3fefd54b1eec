#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/object/polyhedron.h"
#include "planner/plan/locate.h"
#include "planner/plan/plan_io.h"
#include "python/binding.h"
#include "python/interrupt.h"
#include "render/picture/image.h"
#include "report/failure.h"
#include "report/pictures/report_pictures.h"
#include "report/report.h"
#include "report/report_json.h"
#include "sim/actuation/hand_replay.h"
#include "sim/actuation/tip_geometry.h"
#include "sim/hand/check_hand.h"
#include "sim/scene/scaling.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

/// Report held by Python, with the data for its images.
struct PythonReport {
  report::Report report;
  plan::Plan plan;
  std::shared_ptr<const kinematics::HandFile> hand;  ///< null if no hand was checked
};

constexpr std::array kEngines = {sim::EngineChoice::kMujoco, sim::EngineChoice::kOde,
                                 sim::EngineChoice::kBoth};

struct ValidateArguments {
  std::optional<double> half_angle, torsion, mass_kg, squeeze_N;
  double shake = sim::ReplayOptions().shake;
  double tolerance = sim::ReplayOptions().tolerance;
  sim::EngineChoice engine = sim::ReplayOptions().engine;
  bool stress = false;
  bool replay_by_hand = false;
  bool feedback = true;
  bool own_tips = false;
  sim::HandTolerance hand_tolerance;
  double clearance = sim::HandCheckOptions().clearance_m;
};

/// Return a replayer on the hand's own model.
report::Replayer HandReplayer(const kinematics::HandFile& hand, const object::Polyhedron& solid,
                              const plan::Plan& plan, const sim::ReplayOptions& replay,
                              const ValidateArguments& given, const sim::ReplayObserver& observer) {
  sim::HandReplayOptions by_hand;
  by_hand.tolerance = given.hand_tolerance;
  by_hand.feedback = given.feedback;
  by_hand.tip = given.own_tips ? sim::TipShape::kGeometry : sim::TipShape::kBall;
  static_cast<void>(sim::TipShapesOf(hand, by_hand.tip));  // fails before any other work
  by_hand.mass_kg = sim::BodyOf(solid, plan.scale, replay).mass_kg;
  by_hand.shake = replay.shake;
  by_hand.squeeze_N = replay.squeeze_N;
  sim::HandReplayObserver watch;
  watch.on_progress = observer.on_progress;
  return [=, &hand, &solid](const plan::Plan& located, double half_angle, int entries) {
    sim::HandReplayOptions now = by_hand;
    now.half_angle = half_angle;
    return sim::ReplayHand(hand, solid, located, now, watch, entries);
  };
}

PythonReport Validate(const PythonObject& object, const std::string& text, const std::string& name,
                      const ValidateArguments& given, const PythonHand* hand,
                      Interrupt& interrupt) {
  plan::Plan plan = plan::ParsePlan(text, name);
  CheckFits(plan, object, name);
  plan::CheckOptions check;
  check.half_angle = given.half_angle;
  check.torsion = given.torsion;
  sim::ReplayOptions replay;
  replay.half_angle = given.half_angle;
  replay.mass_kg = given.mass_kg;
  replay.squeeze_N = given.squeeze_N;
  replay.shake = given.shake;
  replay.tolerance = given.tolerance;
  replay.engine = given.engine;
  replay.stress = given.stress;
  sim::ReplayObserver observer;
  const auto progress = interrupt.progress();
  observer.on_progress = [&](int done, int total) {
    progress("replay: " + std::to_string(done) + " of " + std::to_string(total) + " steps");
    if (interrupt.raised()) throw TimeUp();
  };
  report::Replayer replayer;
  std::shared_ptr<const kinematics::HandFile> kept;
  if (hand != nullptr) {
    const auto& solid = dynamic_cast<const object::Polyhedron&>(*object.file.object);
    kept = std::make_shared<const kinematics::HandFile>(hand->file);
    check.hand_faults =
        sim::CheckHand(*kept, solid, plan::LocatePlan(solid, plan), {given.clearance});
    if (given.replay_by_hand) {
      replayer = HandReplayer(*kept, solid, plan, replay, given, observer);
    }
  }
  report::Report report =
      report::Validate(*object.file.object, plan, check, replay, observer, replayer);
  report.object_file = object.file.file;
  report.object_sha256 = object.file.sha256;
  report.plan_file = name;
  report.plan_sha256 = Sha256(text);
  return {std::move(report), std::move(plan), std::move(kept)};
}

PythonReport ValidatePlan(const PythonObject& object, const std::string& text,
                          const std::string& name, const ValidateArguments& given,
                          const PythonHand* hand, py::object progress) {
  Interrupt interrupt({}, std::move(progress));
  PythonReport result;
  {
    const py::gil_scoped_release unlocked;
    try {
      result = Validate(object, text, name, given, hand, interrupt);
    } catch (const TimeUp&) {
      if (!interrupt.raised()) throw;
    }
  }
  interrupt.ThrowIfRaised();
  return result;
}

/// Return the failure as text: "hold: not force closure; why: …; what would mend it: …"; nullopt if
/// the plan passes.
std::optional<std::string> FailureOf(const PythonReport& of) {
  const auto failed = report::DescribeFailure(of.report);
  if (!failed) return std::nullopt;
  return failed->line();
}

py::array_t<std::uint8_t> ArrayOf(const render::Image& image) {
  return py::array_t<std::uint8_t>({image.height, image.width, 3}, image.rgb.data());
}

/// Return the images of the steps, and the overview image.
py::tuple Draw(const PythonReport& of, const PythonObject& object, int width, int height) {
  report::DrawingOptions options;
  options.frame.width = width;
  options.frame.height = height;
  options.workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<render::Image> frames;
  render::Image sheet;
  {
    const py::gil_scoped_release unlocked;
    std::optional<report::HandPicture> hand;
    if (of.hand) {
      hand.emplace(*of.hand, of.plan,
                   of.plan.scale * object.file.object->mass_properties().centroid);
      options.hand = &*hand;
    }
    sheet =
        report::DrawFrames(*object.file.object, of.plan, options, of.report,
                           [&](const report::DrawnFrame& frame) { frames.push_back(frame.image); });
  }
  py::list arrays;
  for (const render::Image& frame : frames) arrays.append(ArrayOf(frame));
  return py::make_tuple(arrays, ArrayOf(sheet));
}

py::bytes EncodePng(const py::array_t<std::uint8_t, py::array::c_style>& pixels) {
  render::Image image;
  image.height = static_cast<int>(pixels.shape(0));
  image.width = static_cast<int>(pixels.shape(1));
  image.rgb.assign(pixels.data(), pixels.data() + pixels.size());
  return render::EncodePng(image);
}

}  // namespace

void CheckFits(const plan::Plan& plan, const PythonObject& object, const std::string& name) {
  const bool repaired =
      plan.repair && !object.file.repair && plan.repair->sha256 == object.file.sha256;
  if (!repaired &&
      (plan.object_sha256 != object.file.sha256 || plan.repair != object.file.repair)) {
    constexpr std::size_t kShown = 12;
    throw InputError(name + ": /object/sha256: the plan is for another object file, expected " +
                     plan.object_file + " (SHA-256 " + plan.object_sha256.substr(0, kShown) +
                     "…), found " + object.file.file + " (SHA-256 " +
                     object.file.sha256.substr(0, kShown) + "…)");
  }
  if (plan.scale != object.scale) {
    throw InputError(name + ": /object/scale: must be the scale of " + object.file.file +
                     ", expected " + FormatDouble(object.scale) + " m per unit, found " +
                     FormatDouble(plan.scale) +
                     "; help: read the object with scale=" + FormatDouble(plan.scale));
  }
  if (plan.at_given_points) {
    throw InputError(name + ": its contacts are at points of " + plan.object_file +
                     "; the program validate checks that");
  }
}

void BindReports(py::module_& module) {
  py::class_<ValidateArguments>(module, "ValidateArguments")
      .def(py::init<>())
      .def_readwrite("half_angle", &ValidateArguments::half_angle)
      .def_readwrite("torsion", &ValidateArguments::torsion)
      .def_readwrite("mass_kg", &ValidateArguments::mass_kg)
      .def_readwrite("squeeze_N", &ValidateArguments::squeeze_N)
      .def_readwrite("shake", &ValidateArguments::shake)
      .def_readwrite("tolerance", &ValidateArguments::tolerance)
      .def("set_engine",
           [](ValidateArguments& of, const std::string& name) {
             for (const sim::EngineChoice engine : kEngines) {
               if (name == report::EngineName(engine)) of.engine = engine;
             }
           })
      .def_readwrite("stress", &ValidateArguments::stress)
      .def_readwrite("replay_by_hand", &ValidateArguments::replay_by_hand)
      .def_readwrite("feedback", &ValidateArguments::feedback)
      .def_readwrite("own_tips", &ValidateArguments::own_tips)
      .def("set_hand_tolerance",
           [](ValidateArguments& of, double length_mm, double angle_deg) {
             of.hand_tolerance.length_m = 1e-3 * length_mm;
             of.hand_tolerance.angle_rad = Radians(angle_deg);
           })
      .def_readwrite("clearance", &ValidateArguments::clearance);
  py::class_<PythonReport>(module, "Report")
      .def_property_readonly(
          "json", [](const PythonReport& of) { return report::FormatReportJson(of.report); })
      .def_property_readonly(
          "table", [](const PythonReport& of) { return report::FormatReportTable(of.report); })
      .def_property_readonly("failure", FailureOf)
      .def("draw", Draw);
  py::list engines;
  for (const sim::EngineChoice engine : kEngines) engines.append(report::EngineName(engine));
  module.attr("engines") = engines;
  module.attr("least_frame_side") = render::kMinFrameSide;
  module.attr("most_frame_side") = render::kMaxFrameSide;
  module.def("validate_plan", ValidatePlan);
  module.def("encode_png", EncodePng);
}

}  // namespace regrasp::python
