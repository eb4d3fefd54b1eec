#include "report/pictures/replay_viewer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "planner/base/number.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/hand_view.h"
#include "render/frames/viewpoint.h"
#include "render/picture/caption.h"
#include "report/pictures/object_progress.h"

namespace regrasp::report {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using render::ViewerScene;

/// Distance between the surfaces of successive links, in object diameters. Links that share a
/// sphere at a joint would flicker without it.
constexpr double kLinkGap = 1.5e-3;
/// Largest number of entries that the choice of the first camera considers.
constexpr std::size_t kMostConsidered = 12;

std::string NameOf(const HandPicture* hand, FingerIndex finger) {
  if (hand != nullptr && finger < std::ssize(hand->hand().fingers)) {
    return hand->hand().fingers[finger].name;
  }
  return "finger " + std::to_string(finger);
}

/// Return the title of an entry, with the names of fingers: "Switch: place ff, release th".
std::string TitleOf(const plan::Plan& plan, plan::EntryIndex entry, const HandPicture* hand) {
  const auto list = [&](const auto& fingers, const auto& finger_of) {
    std::string text;
    for (const auto& each : fingers) {
      text += (text.empty() ? "" : ", ") + NameOf(hand, finger_of(each));
    }
    return text;
  };
  const auto of_contact = [](const plan::FingerContact& held) { return held.finger; };
  if (entry == 0) return "Initial grasp: " + list(plan.initial, of_contact);
  const plan::Step& step = plan::StepOf(plan, entry);
  if (const auto* change = std::get_if<plan::Switch>(&step)) {
    const auto itself = [](FingerIndex finger) { return finger; };
    std::string text;
    if (!change->place.empty()) text = "place " + list(change->place, of_contact);
    if (!change->release.empty()) {
      text += (text.empty() ? "" : ", ") + ("release " + list(change->release, itself));
    }
    return "Switch: " + text;
  }
  if (hand == nullptr) {
    std::string title = render::EntryTitle(plan, entry);
    if (!title.empty() && title[0] >= 'a' && title[0] <= 'z') title[0] += 'A' - 'a';
    return title;
  }
  return std::holds_alternative<plan::Move>(step) ? "Move: all fingers move the object"
                                                  : "Slide: fingers move along the surface";
}

/// Set the angle that the object has rotated at each sample.
void AddTurns(const HandPicture& hand, ViewerScene& scene) {
  ObjectProgress progress(hand.PlannedPoses());
  scene.goal_turn = progress.goal_angle();
  if (!scene.goal_turn) return;
  for (std::size_t i = 0; i < scene.samples.size(); ++i) {
    if (i > 0) progress.Follow(scene.samples[i].X_WO);
    scene.turned.push_back(progress.angle());
  }
}

void AddHand(const HandPicture& hand, ViewerScene& scene) {
  scene.X_WP = hand.X_WP();
  std::vector<int> first_joints;
  for (const kinematics::Finger& finger : hand.hand().fingers) {
    first_joints.push_back(static_cast<int>(scene.joints.size()));
    for (std::size_t k = 0; k < finger.joints.size(); ++k) {
      const kinematics::Joint& joint = finger.joints[k];
      const int parent = k == 0 ? -1 : static_cast<int>(scene.joints.size()) - 1;
      scene.joints.push_back({parent, joint.offset, joint.axis, joint.rest});
    }
  }
  for (const render::HandLinkView& view : *hand.view()) {
    const bool of_palm = !view.link.finger.valid() || view.link.joints == 0;
    const int joint = of_palm ? -1 : first_joints[view.link.finger] + view.link.joints - 1;
    scene.links.push_back({joint, view.link.finger, view.is_fingertip, view.mesh});
    render::Grow(kLinkGap * scene.diameter_m * view.link.joints, scene.links.back().mesh);
  }
}

void AddBody(const render::BodyShape& body, const render::NormalizedFrame& frame,
             ViewerScene& scene) {
  const auto in_metres = [&](const Vector3d& p) -> Vector3d {
    return frame.diameter_m * p + frame.centroid_m;
  };
  scene.object = body.surface;
  for (auto& corners : scene.object.triangles) {
    for (Vector3d& p : corners) p = in_metres(p);
  }
  for (const auto& [a, b] : body.edges) scene.edges.push_back({in_metres(a), in_metres(b)});
}

/// Return the direction of the first camera, which is that of the frames.
Vector3d DirectionToEye(const render::BodyShape& body, const render::NormalizedFrame& frame,
                        const std::vector<ShownEntry>& entries, const DrawingOptions& options,
                        bool planar) {
  if (options.frame.view.direction) return options.frame.view.direction->ToCamera();
  std::optional<render::HandFigure> figure;
  if (options.hand != nullptr) figure.emplace(*options.hand->view(), frame);
  std::vector<std::vector<render::FingerGlyph>> glyphs;
  std::vector<render::FramePlacement> placements;
  double largest_force = 0;
  const std::size_t stride = 1 + (entries.size() - 1) / kMostConsidered;
  for (std::size_t i = 0; i < entries.size(); i += stride) {
    const plan::Snapshot& snapshot = entries[i].snapshot;
    glyphs.push_back(render::MakeFingerGlyphs(snapshot, frame, body.rays));
    for (const plan::FingerState& state : snapshot.fingers) {
      largest_force = std::max(largest_force, state.force_W.norm());
    }
    if (figure) {
      placements.push_back({frame.BodyPose(snapshot.X_WO).inverse(), figure->Rays(snapshot)});
    }
  }
  return render::ChooseViewpoints(body, planar, glyphs, largest_force, placements).common;
}

render::ViewerFailure FailureOf(const render::FaultMarks& marks, const HandPicture* hand,
                                const ViewerScene& scene) {
  render::ViewerFailure failure;
  failure.heading = marks.heading;
  for (std::size_t i = 0; i < scene.fingers.size(); ++i) {
    if (std::ranges::find(marks.fingers, scene.fingers[i].finger) != marks.fingers.end()) {
      failure.fingers.push_back(static_cast<int>(i));
    }
  }
  for (std::size_t i = 0; i < scene.links.size(); ++i) {
    const plan::HandLink& link = (*hand->view())[i].link;
    if (std::ranges::find(marks.links, link) != marks.links.end()) {
      failure.links.push_back(static_cast<int>(i));
    }
  }
  for (const auto& [from, to, text] : marks.dimensions) {
    failure.marks.push_back({from, to, false, text});
  }
  const double length = 0.2 * scene.diameter_m;
  for (const auto& [at, along, expected, text] : marks.normals) {
    failure.marks.push_back({at, at + length * along.normalized(), expected, text});
  }
  for (const auto& [contact, normal, text] : marks.places) {
    failure.marks.push_back({contact - length * normal, contact, true, text});
  }
  for (const auto& [at, text] : marks.spots) failure.marks.push_back({at, at, false, text});
  if (marks.disturbance && marks.disturbance->force_N.norm() > 0) {
    const Vector3d direction = marks.disturbance->force_N.normalized();
    failure.marks.push_back({marks.centroid, marks.centroid + 0.5 * scene.diameter_m * direction,
                             false, marks.disturbance->name});
  }
  failure.X_WO_before = marks.X_WO_before;
  failure.ghost_text = marks.ghost_text;
  return failure;
}

void AddSteps(const plan::Plan& plan, const std::vector<ShownEntry>& entries,
              const std::vector<double>& ends, const HandPicture* hand, ViewerScene& scene) {
  double start = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const ReportStep& step = *entries[i].step;
    render::ViewerStep& shown = scene.steps.emplace_back();
    shown.number = step.check.index;
    shown.start_s = start;
    shown.end_s = start = ends[i];
    shown.title = TitleOf(plan, step.check.index, hand);
    shown.verdict = VerdictName(step.verdict());
    if (step.verdict() == Verdict::kFail) {
      shown.reason = std::string(plan::ReasonName(step.reason())) + ": " + step.detail();
    }
    if (step.check.required) shown.margin = plan.friction_angle - step.check.required->upper;
  }
}

}  // namespace

ViewerScene MakeViewerScene(const object::Object& object, const plan::Plan& plan,
                            const DrawingOptions& options, const std::vector<HandSample>& samples,
                            const Report& report) {
  const HandPicture* hand = options.hand;
  const std::vector<ShownEntry> entries = ShowEntries(object, plan, hand, report, samples);
  ViewerScene scene;
  scene.object_name = report.object_file;
  scene.diameter_m = report.scale * object.diameter();
  scene.centroid = report.scale * object.mass_properties().centroid;
  scene.planar = object.dimension() == 2;
  scene.friction_angle = report.friction_angle;
  scene.hard_fingers = report.torsion == 0;
  if (report.finger_radius && *report.finger_radius > 0) {
    scene.finger_radius_m = report.scale * *report.finger_radius;
  }
  render::BodyOptions body_options = options.frame.body;
  if (scene.planar && report.settings) {
    body_options.thickness = report.settings->thickness_m / report.settings->diameter_m;
  }
  const render::BodyShape body = render::MakeBodyShape(object, body_options);
  const render::NormalizedFrame frame = {scene.diameter_m, scene.centroid};
  AddBody(body, frame, scene);
  const std::vector<FingerIndex> fingers = FingersOf(entries);
  for (const FingerIndex finger : fingers) scene.fingers.push_back({finger, NameOf(hand, finger)});
  ReplayTimeline timeline = MakeTimeline(object, report, entries, fingers, hand, samples);
  scene.samples = std::move(timeline.samples);
  scene.simulated_time = timeline.simulated_time;
  if (hand != nullptr) {
    AddHand(*hand, scene);
    AddTurns(*hand, scene);
  }
  AddSteps(plan, entries, timeline.ends, hand, scene);
  scene.to_eye = DirectionToEye(body, frame, entries, options, scene.planar);
  if (entries.back().marks) scene.failure = FailureOf(*entries.back().marks, hand, scene);
  return scene;
}

}  // namespace regrasp::report
