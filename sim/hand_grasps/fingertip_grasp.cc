#include "sim/hand_grasps/fingertip_grasp.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/collision/shape_contact.h"
#include "planner/collision/surface_tree.h"
#include "planner/gait/hand_scene.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;
using kinematics::Finger;
using kinematics::JointConfiguration;

constexpr std::size_t kFewestContacts = 3;
/// Largest angle between the direction to a fingertip's centre and the face's normal. It is larger
/// at edges, at which contacts have no normal. Triangles of smooth surfaces are within it.
constexpr double kMostEdgeAngle = Radians(20);
constexpr double kFarthestTip_m = 1;
/// Largest difference of a joint that a plan cannot move from its reference, radians or metres.
constexpr double kFixedTolerance = 1e-3;
/// Rounding of numbers in files.
constexpr double kRounding = 1e-6;

/// Return whether a joint moves the palm itself, so that the palm's pose includes its position.
bool IsAbovePalm(const mjModel& model, int joint, int palm) {
  int body = palm;
  while (body > 0 && body != model.jnt_bodyid[joint]) body = model.body_parentid[body];
  return body > 0;
}

/// Conversion of one grasp.
class FingertipReader {
 public:
  FingertipReader(const HandGrasp& grasp, const FingertipSetup& setup, const std::string& name)
      : grasp_(grasp),
        setup_(setup),
        name_(name),
        surface_(setup.solid, setup.scale),
        balls_(setup.solid, setup.scale),
        scene_(setup.hand.hand, surface_, setup.clearance) {}

  [[nodiscard]] plan::HandEnd Read() {
    CheckObject();
    CheckJointNames();
    end_.state.pose = grasp_.grasp.palm.inverse();
    for (const Finger& finger : fingers()) configurations_.push_back(ConfigurationOf(finger));
    for (FingerIndex finger{0}; finger < scene_.finger_count(); ++finger) AddContact(finger);
    CheckContactCount();
    CheckDistances();
    for (FingerIndex finger{0}; finger < scene_.finger_count(); ++finger) {
      end_.state.joints.push_back(
          kinematics::JointAngles(scene_.finger(finger), configurations_[finger]));
    }
    return end_;
  }

 private:
  [[nodiscard]] const std::vector<Finger>& fingers() const { return scene_.hand().fingers; }

  [[noreturn]] void Fail(const std::string& text) const { throw InputError(name_ + ": " + text); }

  void CheckObject() const {
    const std::string file = std::filesystem::path(grasp_.object_file).filename().string();
    if (file != setup_.object_file) {
      Fail("/object/file: the grasp is for another object, expected " + setup_.object_file +
           ", found " + file);
    }
    if (std::abs(grasp_.scale - setup_.scale) > kRounding * setup_.scale) {
      Fail("/object/scale: must be that of the plan, expected " + FormatShort(setup_.scale) +
           ", found " + FormatShort(grasp_.scale));
    }
  }

  void CheckJointNames() const {
    const mjModel& model = *setup_.hand.compiled->model;
    std::set<std::string> of_fingers;
    for (const Finger& finger : fingers()) {
      for (const kinematics::Joint& joint : finger.joints) of_fingers.insert(joint.name);
    }
    const int palm = mj_name2id(&model, mjOBJ_BODY, setup_.hand.description.palm.c_str());
    for (const auto& [joint, position] : grasp_.grasp.joints) {
      if (of_fingers.contains(joint)) continue;
      const int id = mj_name2id(&model, mjOBJ_JOINT, joint.c_str());
      if (id < 0) {
        Fail("/joints/" + joint + ": unknown joint, the grasp is for another hand than " +
             scene_.hand().name);
      }
      const double reference = model.qpos0[model.jnt_qposadr[id]];
      if (IsAbovePalm(model, id, palm) || std::abs(position - reference) <= kFixedTolerance)
        continue;
      Fail("/joints/" + joint + ": not a joint of a finger of the hand file, expected " +
           FormatShort(reference) + ", found " + FormatShort(position));
    }
  }

  [[nodiscard]] JointConfiguration ConfigurationOf(const Finger& finger) const {
    JointConfiguration configuration(finger.drives);
    for (int drive = 0; drive < finger.drives; ++drive) {
      const kinematics::Joint& joint = kinematics::LeadingJoint(finger, drive);
      const auto found = grasp_.grasp.joints.find(joint.name);
      if (found == grasp_.grasp.joints.end()) Fail("/joints: joint " + joint.name + " not found");
      configuration[drive] = kinematics::DriveAngle(joint, found->second);
      const double lower = finger.lower[drive];
      const double upper = finger.upper[drive];
      if (configuration[drive] >= lower - kRounding && configuration[drive] <= upper + kRounding) {
        configuration[drive] = std::clamp(configuration[drive], lower, upper);
        continue;
      }
      Fail("/joints/" + joint.name + ": outside its range, expected " + FormatShort(lower) +
           " to " + FormatShort(upper) + " rad, found " + FormatShort(configuration[drive]));
    }
    return configuration;
  }

  /// Return the contact of a fingertip near the surface, in metres.
  [[nodiscard]] grasp::Contact ContactAt(const Finger& finger,
                                         const collision::NearPoint& near) const {
    const double tolerance = object::kPointTolerance * setup_.solid.diameter();
    grasp::Contact contact;
    contact.p = near.point / setup_.scale;
    double best = std::cos(kMostEdgeAngle);
    for (const FaceIndex face : setup_.solid.FacesNear(contact.p, tolerance)) {
      const double along = -setup_.solid.inward_normal(face).dot(near.outward);
      if (along <= best) continue;
      best = along;
      contact.face = face;
      contact.n = setup_.solid.inward_normal(face);
    }
    if (!contact.face.valid()) {
      Fail("finger " + finger.name + " touches an edge, expected a contact on a face");
    }
    return contact;
  }

  /// Add the contact of a fingertip that touches the surface, and move the fingertip onto it.
  void AddContact(FingerIndex index) {
    const Finger& finger = scene_.finger(index);
    const Vector3d centre =
        end_.state.pose.inverse() * kinematics::TipAt(finger, configurations_[index]).centre;
    const auto near = balls_.Find(centre, kFarthestTip_m);
    const double gap = near.empty() ? kFarthestTip_m : near.front().distance - finger.tip.radius;
    gaps_.push_back(gap);
    if (gap > kFingertipTolerance) return;
    if (gap < -kFingertipTolerance) {
      Fail("finger " + finger.name + " is too deep in the object, expected at most " +
           FormatLength(kFingertipTolerance) + ", found " + FormatLength(-gap));
    }
    const grasp::Contact contact = ContactAt(finger, near.front());
    const kinematics::InverseKinematics inverse(finger);
    const auto moved = inverse.SolveNear(
        gait::TargetAt(finger, {setup_.scale * contact.p, contact.n}, end_.state.pose),
        configurations_[index]);
    if (!moved) {
      Fail("finger " + finger.name +
           " cannot be moved onto the surface within its joint ranges, its distance is " +
           FormatLength(gap));
    }
    configurations_[index] = *moved;
    end_.grasp.push_back({index, contact});
  }

  void CheckContactCount() const {
    if (end_.grasp.size() >= kFewestContacts) return;
    std::vector<double> gaps = gaps_;
    std::ranges::sort(gaps);
    Fail("expected at least " + std::to_string(kFewestContacts) + " fingertips within " +
         FormatLength(kFingertipTolerance) + " of the surface, found " +
         std::to_string(end_.grasp.size()) +
         (gaps.size() > end_.grasp.size()
              ? "; the next fingertip is at " + FormatLength(gaps[end_.grasp.size()])
              : ""));
  }

  /// Check that links, palm and object are as far apart as the planner requires.
  void CheckDistances() const {
    const std::string required =
        ", requires " + FormatLength(scene_.margin() + gait::kConfigurationMargin);
    if (!scene_.KeepsOffPalm(end_.state.pose)) {
      Fail("the palm is too near to the object" + required + "; only fingertips can touch it");
    }
    std::vector<gait::PlacedFinger> placed;
    for (FingerIndex finger{0}; finger < scene_.finger_count(); ++finger) {
      placed.push_back(scene_.Place(finger, configurations_[finger]));
      CheckLinks(placed.back(), required);
      if (!scene_.KeepsOffHand(placed.back())) {
        Fail("finger " + scene_.finger(finger).name + " is too near to the palm or to itself" +
             required);
      }
      for (std::size_t other = 0; other + 1 < placed.size(); ++other) {
        if (scene_.KeepApart(placed[other], placed.back())) continue;
        Fail("fingers " + fingers()[other].name + " and " + scene_.finger(finger).name +
             " are too near to each other" + required);
      }
    }
  }

  void CheckLinks(const gait::PlacedFinger& placed, const std::string& required) const {
    const bool touches = plan::FindFinger(end_.grasp, placed.finger) != nullptr;
    const gait::TipContact tip = touches ? gait::TipContact::kTouching : gait::TipContact::kFree;
    if (scene_.KeepsOffObject(placed, end_.state.pose, tip)) return;
    const std::vector<kinematics::LinkShape>& links = scene_.finger(placed.finger).shapes;
    std::string nearest = links.back().link;
    double least = kFarthestTip_m;
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (touches && links[i].role != kinematics::LinkShape::Role::kLink) continue;
      const collision::PosedShape link = Moved(end_.state.pose.inverse(), placed.shapes[i]);
      const double distance = surface_.DistanceFrom(ShapeOf(link), kFarthestTip_m);
      if (distance >= least) continue;
      least = distance;
      nearest = links[i].link;
    }
    Fail("link " + nearest + " is too near to the object" + required +
         "; only fingertips can touch it");
  }

  const HandGrasp& grasp_;
  const FingertipSetup& setup_;
  const std::string& name_;
  collision::SurfaceTree surface_;
  collision::BallContact balls_;
  gait::HandScene scene_;
  plan::HandEnd end_;
  std::vector<JointConfiguration> configurations_;  ///< [finger]
  std::vector<double> gaps_;  ///< signed distance of each fingertip sphere, metres
};

}  // namespace

plan::HandEnd FingertipGraspOf(const HandGrasp& grasp, const FingertipSetup& setup,
                               const std::string& name) {
  return FingertipReader(grasp, setup, name).Read();
}

void KeepContacts(const plan::HandEnd& start, double scale, plan::HandEnd& goal) {
  for (plan::FingerContact& held : goal.grasp) {
    const plan::FingerContact* before = plan::FindFinger(start.grasp, held.finger);
    if (before != nullptr &&
        plan::AreSameContact(before->contact, held.contact, kSameContactTolerance / scale)) {
      held.contact = before->contact;
    }
  }
}

}  // namespace regrasp::sim
