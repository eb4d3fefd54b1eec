#include "report/pictures/hand_picture.h"

#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/object/rotation.h"
#include "planner/plan/plan.h"

namespace regrasp::report {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using plan::HandState;

/// Rotation of the fastest joint or of the object, or translation of the object, per frame of a
/// motion.
constexpr double kTurnPerPicture = Radians(3);
constexpr double kWayPerPicture = 1e-3;  // metres
constexpr int kMaxEntryFrames = 40;      // frames per path

void Add(const render::ShadedMesh& more, render::ShadedMesh& mesh) {
  mesh.triangles.insert(mesh.triangles.end(), more.triangles.begin(), more.triangles.end());
  mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
}

render::ShadedMesh MeshOf(const kinematics::LinkVisual& link) {
  render::ShadedMesh mesh;
  for (std::size_t i = 0; i < link.triangles.size(); ++i) {
    mesh.Add(link.triangles[i], link.normals[i]);
  }
  for (const auto& [from, to, radius] : link.capsules) {
    Add(render::MakeCapsule(from, to, radius), mesh);
  }
  return mesh;
}

void Move(const Isometry3d& motion, plan::FingerState& finger) {
  for (Vector3d* p : {&finger.tip_W, &finger.contact_W}) *p = motion * *p;
  for (Vector3d* v : {&finger.normal_W, &finger.force_W}) *v = motion.linear() * *v;
  for (Vector3d& p : finger.path_W) p = motion * p;
}

Eigen::AngleAxisd TurnFrom(const HandState& a, const HandState& b) {
  return object::RotationInBody(a.pose.linear(), b.pose.linear());
}

/// Return the length of the motion between two states, in frames.
double MotionBetween(const HandState& a, const HandState& b) {
  double turn = TurnFrom(a, b).angle();
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    for (std::size_t k = 0; k < a.joints[i].size(); ++k) {
      turn = std::max(turn, std::abs(b.joints[i][k] - a.joints[i][k]));
    }
  }
  const double way = (b.pose.translation() - a.pose.translation()).norm();
  return std::max(turn / kTurnPerPicture, way / kWayPerPicture);
}

/// State on a path, and the share of the path's steps before it.
struct Passing {
  HandState state;
  double share;
};

/// Return evenly spaced states along a path, without its two ends.
std::vector<Passing> Spread(const plan::HandPath& path) {
  std::vector<double> along = {0};
  for (std::size_t i = 1; i < path.size(); ++i) {
    along.push_back(along.back() + MotionBetween(path[i - 1], path[i]));
  }
  const int count = std::min(kMaxEntryFrames, static_cast<int>(std::ceil(along.back())));
  std::vector<Passing> states;
  for (int picture = 1; picture < count; ++picture) {
    const double at = along.back() * picture / count;
    const auto next = std::ranges::upper_bound(along, at) - along.begin();
    const double share = (at - along[next - 1]) / (along[next] - along[next - 1]);
    states.push_back(
        {plan::StateBetween(path[next - 1], path[next], share),
         (static_cast<double>(next - 1) + share) / static_cast<double>(path.size() - 1)});
  }
  return states;
}

}  // namespace

HandPicture::HandPicture(const kinematics::HandFile& hand, const plan::Plan& plan,
                         const Vector3d& centroid_m)
    : plan_(plan), hand_(hand.hand), links_(kinematics::VisualsOf(hand)), states_(StatesOf(plan)) {
  // An arm would make the rest small.
  std::erase_if(links_, [](const kinematics::LinkVisual& link) { return link.above_palm; });
  render::HandView view;
  for (kinematics::LinkVisual& link : links_) {
    const bool is_fingertip =
        link.finger.valid() && link.after == std::ssize(hand_.fingers[link.finger].joints);
    view.push_back({{link.finger, link.after}, is_fingertip, MeshOf(link)});
    // After this point the links are used for poses only.
    link.triangles = {};
    link.normals = {};
  }
  // The contact geometry is the fingertip sphere. It is drawn slightly smaller, so that visual
  // geometry of the same size remains visible.
  constexpr double kInside = 0.985;
  for (FingerIndex finger{0}; finger < std::ssize(hand_.fingers); ++finger) {
    const kinematics::Fingertip& tip = hand_.fingers[finger].tip;
    kinematics::LinkVisual ball;
    ball.finger = finger;
    ball.after = static_cast<int>(hand_.fingers[finger].joints.size());
    ball.capsules = {{tip.centre, tip.centre, kInside * tip.radius}};
    view.push_back({{finger, ball.after}, true, MeshOf(ball)});
    links_.push_back(std::move(ball));
  }
  view_ = std::make_shared<const render::HandView>(std::move(view));
  // The initial pose of the object is that of frames without a hand.
  X_WP_.setIdentity();
  X_WP_.linear() = object::AligningRotation(hand_.up, Vector3d::UnitZ()).toRotationMatrix();
  X_WP_.translation() = centroid_m - X_WP_.linear() * (states_.front().pose * centroid_m);
}

double HandPicture::Distance(const HandState& a, const HandState& b) { return MotionBetween(a, b); }

bool HandPicture::Fits(const HandState& state) const {
  return std::ranges::equal(state.joints, hand_.fingers, {}, &std::vector<double>::size,
                            [](const kinematics::Finger& finger) { return finger.joints.size(); });
}

/// Return the state of hand and object at the end of each entry. A step without a state of this
/// hand does not change the state.
std::vector<HandState> HandPicture::StatesOf(const plan::Plan& plan) const {
  HandState rest{plan.hand->initial.pose, {}};
  for (const kinematics::Finger& finger : hand_.fingers) {
    rest.joints.emplace_back();
    for (const kinematics::Joint& joint : finger.joints) rest.joints.back().push_back(joint.rest);
  }
  std::vector<HandState> states = {Fits(plan.hand->initial) ? plan.hand->initial : rest};
  for (const plan::Step& step : plan.steps) {
    states.push_back(states.back());
    for (const plan::HandPath* path : plan::PathsOf(step)) {
      if (!path->empty() && Fits(path->back())) states.back() = path->back();
    }
  }
  return states;
}

void HandPicture::Stand(const HandState& state, plan::Snapshot& snapshot) const {
  const Isometry3d motion = X_WP_ * state.pose;
  snapshot.X_WO = motion * snapshot.X_WO;
  for (plan::FingerState& finger : snapshot.fingers) Move(motion, finger);
  PlaceLinks(state.joints, snapshot);
}

void HandPicture::PlaceLinks(const std::vector<std::vector<double>>& joints,
                             plan::Snapshot& snapshot) const {
  snapshot.X_WP = X_WP_;
  snapshot.links_W.clear();
  for (const kinematics::LinkVisual& link : links_) {
    snapshot.links_W.push_back(X_WP_ * kinematics::LinkPose(link, hand_, joints));
  }
}

std::vector<std::string> HandPicture::FingerNames() const {
  std::vector<std::string> names;
  for (const kinematics::Finger& finger : hand_.fingers) names.push_back(finger.name);
  return names;
}

std::vector<Isometry3d> HandPicture::PlannedPoses() const {
  std::vector<Isometry3d> poses;
  for (plan::EntryIndex entry{0}; entry < std::ssize(states_); ++entry) {
    for (const HandState& state : StatesAlong(entry)) poses.push_back(X_WP_ * state.pose);
  }
  return poses;
}

void HandPicture::MarkRolling(const plan::Move& move, plan::Snapshot& snapshot) const {
  for (plan::FingerState& finger : snapshot.fingers) {
    finger.path_W.clear();
    for (const plan::FingerGrasp& grasp : move.contacts) {
      const plan::FingerContact* held = plan::FindFinger(grasp, finger.finger);
      if (held != nullptr) finger.path_W.push_back(plan_.scale * held->contact.p);
    }
    if (!finger.path_W.empty()) finger.role = plan::FingerRole::kMoved;
  }
}

void HandPicture::MarkActions(plan::EntryIndex entry, plan::Snapshot& snapshot) const {
  if (entry == 0) return;
  if (const auto* move = std::get_if<plan::Move>(&plan::StepOf(plan_, entry))) {
    MarkRolling(*move, snapshot);
    return;
  }
  const auto* change = std::get_if<plan::Switch>(&plan::StepOf(plan_, entry));
  if (change == nullptr) return;
  for (plan::FingerState& finger : snapshot.fingers) {
    if (plan::FindFinger(change->place, finger.finger) != nullptr) {
      finger.role = plan::FingerRole::kPlaced;
    }
  }
  plan::FingerGrasp before = plan_.initial;
  for (plan::EntryIndex k{1}; k < entry; ++k) {
    before = plan::GraspAfter(before, plan::StepOf(plan_, k));
  }
  for (const FingerIndex released : change->release) {
    const plan::FingerContact* held = plan::FindFinger(before, released);
    if (held == nullptr) continue;
    std::erase_if(snapshot.fingers,
                  [&](const plan::FingerState& finger) { return finger.finger == released; });
    plan::FingerState& finger = snapshot.fingers.emplace_back();
    finger.finger = released;
    finger.role = plan::FingerRole::kReleased;
    finger.contact_W = plan_.scale * held->contact.p;
    finger.normal_W = held->contact.n;
    finger.tip_W = finger.contact_W - snapshot.fingertip_radius_m * finger.normal_W;
  }
}

void HandPicture::Pose(std::span<const double> joints, plan::Snapshot& snapshot) const {
  std::vector<std::vector<double>> by_finger;
  for (const kinematics::Finger& finger : hand_.fingers) {
    const auto own = joints.first(finger.joints.size());
    by_finger.emplace_back(own.begin(), own.end());
    joints = joints.subspan(own.size());
  }
  PlaceLinks(by_finger, snapshot);
}

std::vector<HandState> HandPicture::StatesAlong(plan::EntryIndex entry) const {
  std::vector<HandState> states = {states_[entry == 0 ? 0 : int{entry} - 1]};
  if (entry == 0) return states;
  for (const plan::HandPath* path : plan::PathsOf(plan::StepOf(plan_, entry))) {
    if (path->empty()) continue;
    if (!std::ranges::all_of(*path, [this](const HandState& state) { return Fits(state); })) {
      continue;
    }
    for (const auto& [state, share] : Spread(*path)) states.push_back(state);
    states.push_back(path->back());
  }
  return states;
}

void HandPicture::Place(plan::EntryIndex entry, plan::Snapshot& snapshot, plan::Fault& fault,
                        const HandState* actual) const {
  const HandState& state = fault.hand && Fits(fault.hand->state) ? fault.hand->state
                           : actual != nullptr                   ? *actual
                                                                 : states_[entry];
  if (fault.X_WO_before) fault.X_WO_before = X_WP_ * state.pose * *fault.X_WO_before;
  if (fault.hand && fault.hand->pose) fault.X_WO_before = X_WP_ * *fault.hand->pose;
  Stand(state, snapshot);
  const bool moves = entry > 0 && std::holds_alternative<plan::Move>(plan::StepOf(plan_, entry));
  if (moves) {
    snapshot.X_WO_before = X_WP_ * states_[plan::EntryIndex(entry - 1)].pose;
  }
}

}  // namespace regrasp::report
