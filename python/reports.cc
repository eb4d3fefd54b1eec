#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/plan/plan_io.h"
#include "python/binding.h"
#include "render/picture/animation.h"
#include "render/picture/image.h"
#include "report/failure.h"
#include "report/page/report_page.h"
#include "report/pictures/hand_recorder.h"
#include "report/pictures/replay_viewer.h"
#include "report/pictures/report_pictures.h"
#include "report/report.h"
#include "report/report_json.h"
#include "sim/validation/validation.h"

namespace regrasp::python {

namespace py = pybind11;

namespace {

/// Time between two recorded states of a replay by point fingers, seconds.
constexpr double kSampleInterval_s = 0.01;

/// Report held by Python, with the inputs of its images.
struct PythonReport {
  report::Report report;
  plan::Plan plan;
  std::shared_ptr<const kinematics::HandFile> hand;  ///< null: no hand was checked
  std::vector<report::HandSample> samples;           ///< states of a replay by the hand
  std::vector<plan::Snapshot> snapshots;             ///< states of a replay by point fingers
};

constexpr std::array kEngines = {sim::EngineChoice::kMujoco, sim::EngineChoice::kOde,
                                 sim::EngineChoice::kBoth};

PythonReport Validate(const PythonObject& object, const std::string& text, const std::string& name,
                      const validation::ValidationOptions& options, const PythonHand* hand,
                      Interrupt& interrupt) {
  plan::Plan plan = plan::ParsePlan(text, name);
  CheckFits(plan, object, name);
  std::shared_ptr<const kinematics::HandFile> kept;
  if (hand != nullptr)
    kept = std::make_shared<const kinematics::HandFile>(kinematics::HandOfPlan(hand->file, plan));
  validation::ValidationObserver observer;
  report::HandRecorder recorder;
  std::vector<plan::Snapshot> snapshots;
  observer.replay.sample_interval_s = kSampleInterval_s;
  observer.replay.on_sample = [&](const plan::Snapshot& snapshot) {
    snapshots.push_back(snapshot);
  };
  observer.replay.on_time_step = [&](const sim::HandWorld& world) { recorder.Add(world); };
  const auto progress = interrupt.progress();
  observer.replay.on_progress = [&](int done, int total) {
    progress("replay: " + std::to_string(done) + " of " + std::to_string(total) + " steps");
    recorder.EndEntry();
    if (interrupt.raised()) throw TimeUp();
  };
  report::Report report = validation::Validate({.object = *object.file.object,
                                                .plan = plan,
                                                .hand = kept.get(),
                                                .options = options,
                                                .plan_name = name},
                                               observer)
                              .report;
  report.object_file = object.file.file;
  report.object_sha256 = object.file.sha256;
  report.plan_file = name;
  report.plan_sha256 = Sha256(text);
  return {std::move(report), std::move(plan), std::move(kept), recorder.samples(),
          std::move(snapshots)};
}

PythonReport ValidatePlan(const PythonObject& object, const std::string& text,
                          const std::string& name, const validation::ValidationOptions& options,
                          const PythonHand* hand, py::object progress) {
  Interrupt interrupt({}, std::move(progress));
  PythonReport result;
  {
    const py::gil_scoped_release unlocked;
    try {
      result = Validate(object, text, name, options, hand, interrupt);
    } catch (const TimeUp&) {
      if (!interrupt.raised()) throw;
    }
  }
  interrupt.ThrowIfRaised();
  return result;
}

/// Return "step 0 (hold) fails: not-force-closure; why: …; help: …"; nullopt if the plan passes.
std::optional<std::string> FailureOf(const PythonReport& of) {
  const auto failed = report::DescribeFailure(of.report);
  if (!failed) return std::nullopt;
  return failed->line();
}

py::array_t<std::uint8_t> ArrayOf(const render::Image& image) {
  return py::array_t<std::uint8_t>({image.height, image.width, 3}, image.rgb.data());
}

/// Return the hand of a report in images; nullopt without a hand.
std::optional<report::HandPicture> HandOf(const PythonReport& of, const PythonObject& object) {
  if (!of.hand) return std::nullopt;
  return std::optional<report::HandPicture>(
      std::in_place, *of.hand, of.plan,
      of.plan.scale * object.file.object->mass_properties().centroid);
}

/// Return the HTML report with the interactive replay, or a page with the replay only.
std::string FormatPage(const PythonReport& of, const PythonObject& object, bool only_replay) {
  const py::gil_scoped_release unlocked;
  const std::optional<report::HandPicture> hand = HandOf(of, object);
  const std::string viewer = render::FormatViewerScene(report::MakeViewerScene(
      *object.file.object, of.plan, {.frame = {}, .hand = hand ? &*hand : nullptr}, of.samples,
      of.report));
  return only_replay
             ? report::FormatViewerHtml(of.report, of.plan, viewer)
             : report::FormatReportHtml(of.report, of.plan, {}, {}, viewer,
                                        hand ? hand->FingerNames() : std::vector<std::string>());
}

/// Return the frames and the overview image.
py::tuple Draw(const PythonReport& of, const PythonObject& object, int width, int height) {
  report::DrawingOptions options;
  options.frame.width = width;
  options.frame.height = height;
  options.workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::vector<render::Image> frames;
  render::Image sheet;
  {
    const py::gil_scoped_release unlocked;
    const std::optional<report::HandPicture> hand = HandOf(of, object);
    if (hand) options.hand = &*hand;
    sheet =
        report::DrawFrames(*object.file.object, of.plan, options, of.report,
                           [&](const report::DrawnFrame& frame) { frames.push_back(frame.image); });
  }
  py::list arrays;
  for (const render::Image& frame : frames) arrays.append(ArrayOf(frame));
  return py::make_tuple(arrays, ArrayOf(sheet));
}

/// Return the animation of the replay as the bytes of a file.
/// @param file  name whose suffix names the format.
py::bytes Animate(const PythonReport& of, const PythonObject& object, const std::string& file,
                  int width, int height) {
  const auto format = render::FindAnimationFormat(file);
  if (!format) throw InputError("path: " + file + ": expected the suffix .mp4, .gif or .webp");
  report::DrawingOptions options;
  options.frame.width = width;
  options.frame.height = height;
  options.frame.crop = false;
  options.workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string bytes;
  {
    const py::gil_scoped_release unlocked;
    const std::optional<report::HandPicture> hand = HandOf(of, object);
    if (hand) options.hand = &*hand;
    bytes = report::DrawAnimation(*object.file.object, of.plan, options, of.samples, {*format},
                                  of.report)
                .bytes.front();
  }
  return bytes;
}

/// Write a pose as position and quaternion w, x, y, z.
void SetPose(const Eigen::Isometry3d& pose, double* row) {
  const Eigen::Vector3d& p = pose.translation();
  const Eigen::Quaterniond q(pose.linear());
  const std::array values = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
  std::ranges::copy(values, row);
}

constexpr int kPoseSize = 7;

/// Return times, poses, entries and joint angles of a replay by a hand.
py::tuple HandMotion(const PythonReport& of) {
  const auto count = static_cast<py::ssize_t>(of.samples.size());
  py::ssize_t joints = 0;
  for (const std::vector<double>& finger : of.samples.front().state.joints) {
    joints += std::ssize(finger);
  }
  py::array_t<double> times(count), poses({count, py::ssize_t{kPoseSize}}), angles({count, joints});
  py::array_t<std::int64_t> entries(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const report::HandSample& sample = of.samples[i];
    times.mutable_at(i) = sample.time_s;
    entries.mutable_at(i) = int{sample.entry};
    SetPose(sample.state.pose, poses.mutable_data(i, 0));
    py::ssize_t k = 0;
    for (const std::vector<double>& finger : sample.state.joints) {
      for (const double angle : finger) angles.mutable_at(i, k++) = angle;
    }
  }
  std::vector<std::string> names;
  for (const kinematics::Finger& finger : of.hand->hand.fingers) {
    for (const kinematics::Joint& joint : finger.joints) names.push_back(joint.name);
  }
  return py::make_tuple(times, poses, entries, angles, names);
}

/// Return times, poses and fingertip positions of a replay by point fingers.
/// Fingers that a state does not have are NaN.
py::tuple PointMotion(const PythonReport& of) {
  const auto count = static_cast<py::ssize_t>(of.snapshots.size());
  int fingers = 0;
  for (const plan::Snapshot& snapshot : of.snapshots) {
    for (const plan::FingerState& state : snapshot.fingers) {
      fingers = std::max(fingers, state.finger + 1);
    }
  }
  constexpr py::ssize_t kAxes = 3;
  py::array_t<double> times(count), poses({count, py::ssize_t{kPoseSize}}),
      tips({count, static_cast<py::ssize_t>(fingers), kAxes});
  std::fill_n(tips.mutable_data(), tips.size(), std::numeric_limits<double>::quiet_NaN());
  for (py::ssize_t i = 0; i < count; ++i) {
    const plan::Snapshot& snapshot = of.snapshots[i];
    times.mutable_at(i) = snapshot.time_s;
    SetPose(snapshot.X_WO, poses.mutable_data(i, 0));
    for (const plan::FingerState& state : snapshot.fingers) {
      for (int k = 0; k < kAxes; ++k) tips.mutable_at(i, int{state.finger}, k) = state.tip_W[k];
    }
  }
  return py::make_tuple(times, poses, tips);
}

/// Return the recorded motion; None if nothing was replayed.
py::object Motion(const PythonReport& of) {
  if (!of.samples.empty()) return HandMotion(of);
  if (!of.snapshots.empty()) return PointMotion(of);
  return py::none();
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
  using validation::ValidationOptions;
  py::class_<ValidationOptions> options(module, "ValidationOptions");
  // Add a property for a member of one of the structs that the options consist of.
  const auto add = [&options](const char* name, auto part, auto member) {
    using Value = std::remove_cvref_t<decltype(std::declval<ValidationOptions&>().*part.*member)>;
    options.def_property(
        name, [=](const ValidationOptions& of) { return of.*part.*member; },
        [=](ValidationOptions& of, const Value& value) { of.*part.*member = value; });
  };
  options.def(py::init<>())
      .def_readwrite("half_angle", &ValidationOptions::friction_angle)
      .def_readwrite("torsion", &ValidationOptions::torsion)
      .def_readwrite("replay_by_hand", &ValidationOptions::replay_by_hand)
      .def("set_engine",
           [](ValidationOptions& of, const std::string& name) {
             for (const sim::EngineChoice engine : kEngines) {
               if (name == report::EngineName(engine)) of.replay.engine = engine;
             }
           })
      .def("use_tip_geometry",
           [](ValidationOptions& of) { of.hand.tip = sim::TipShape::kGeometry; })
      .def("set_pose_feedback",
           [](ValidationOptions& of, bool on) {
             of.hand.sensing.feedback = on ? sim::PoseFeedback::kPose : sim::PoseFeedback::kNone;
           })
      .def("set_hand_tolerance", [](ValidationOptions& of, double length_mm, double angle_deg) {
        of.hand.tolerance.length_m = 1e-3 * length_mm;
        of.hand.tolerance.angle_rad = Radians(angle_deg);
      });
  add("mass_kg", &ValidationOptions::replay, &sim::ReplayOptions::mass_kg);
  add("grasp_force_N", &ValidationOptions::replay, &sim::ReplayOptions::grasp_force_N);
  add("disturbance", &ValidationOptions::replay, &sim::ReplayOptions::disturbance_ratio);
  add("tolerance", &ValidationOptions::replay, &sim::ReplayOptions::tolerance);
  add("resisted_wrench", &ValidationOptions::replay, &sim::ReplayOptions::resisted_wrench);
  py::class_<PythonReport>(module, "Report")
      .def_property_readonly(
          "json", [](const PythonReport& of) { return report::FormatReportJson(of.report); })
      .def_property_readonly(
          "table", [](const PythonReport& of) { return report::FormatReportTable(of.report); })
      .def_property_readonly("failure", FailureOf)
      .def("draw", Draw)
      .def("animate", Animate)
      .def("motion", Motion)
      .def("format_page", FormatPage);
  py::list engines;
  for (const sim::EngineChoice engine : kEngines) engines.append(report::EngineName(engine));
  module.attr("engines") = engines;
  module.attr("least_frame_side") = render::kMinFrameSide;
  module.attr("most_frame_side") = render::kMaxFrameSide;
  module.def("validate_plan", ValidatePlan);
  module.def("encode_png", EncodePng);
}

}  // namespace regrasp::python
