#include "apps/hand_picture.h"

#include "planner/kinematics/hand_file.h"

namespace regrasp::apps {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// How hand and object stand at the end of each entry; as before where a step does not say.
std::vector<plan::HandState> StatesOf(const plan::Plan& plan) {
  std::vector<plan::HandState> states = {plan.hand->initial};
  for (const plan::Step& step : plan.steps) {
    states.push_back(states.back());
    const auto take = [&](const plan::HandPath& path) {
      if (!path.empty()) states.back() = path.back();
    };
    if (const auto* move = std::get_if<plan::Move>(&step)) take(move->path);
    const auto* change = std::get_if<plan::Switch>(&step);
    if (change == nullptr || !change->motion) continue;
    take(change->motion->place);
    take(change->motion->release);
  }
  return states;
}

void Add(const render::FacetMesh& more, render::FacetMesh& mesh) {
  mesh.triangles.insert(mesh.triangles.end(), more.triangles.begin(), more.triangles.end());
  mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
}

render::FacetMesh MeshOf(const kinematics::LinkVisual& link) {
  render::FacetMesh mesh;
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

}  // namespace

HandPicture::HandPicture(const std::filesystem::path& hand_file, const plan::Plan& plan,
                         const Vector3d& centroid_m)
    : hand_(kinematics::ReadHand(hand_file)),
      links_(kinematics::ReadHandVisuals(hand_file, hand_)),
      states_(StatesOf(plan)) {
  // An arm would make the rest small.
  std::erase_if(links_, [](const kinematics::LinkVisual& link) { return link.above_palm; });
  for (const kinematics::LinkVisual& link : links_) view_.push_back(MeshOf(link));
  // The object begins where frames without a hand have it.
  X_WP_.setIdentity();
  X_WP_.linear() =
      Eigen::Quaterniond::FromTwoVectors(hand_.up, Vector3d::UnitZ()).toRotationMatrix();
  X_WP_.translation() = centroid_m - X_WP_.linear() * (states_.front().pose * centroid_m);
}

void HandPicture::Place(plan::EntryIndex entry, plan::Snapshot& snapshot,
                        plan::Fault& fault) const {
  const plan::HandState& state = states_[entry];
  const Isometry3d motion = X_WP_ * state.pose;
  snapshot.X_WO = motion * snapshot.X_WO;
  for (plan::FingerState& finger : snapshot.fingers) Move(motion, finger);
  if (fault.X_WO_before) fault.X_WO_before = motion * *fault.X_WO_before;
  snapshot.links_W.clear();
  for (const kinematics::LinkVisual& link : links_) {
    snapshot.links_W.push_back(X_WP_ * kinematics::LinkPose(link, hand_, state.joints));
  }
}

}  // namespace regrasp::apps
