#include "planner/kinematics/derive_couplings.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "planner/base/error.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/joint_relations.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {

namespace {

std::string NameOf(const mjModel& model, int type, int id, const std::string& kind) {
  const char* name = mj_id2name(&model, type, id);
  return name != nullptr && *name != '\0' ? name : kind + " " + std::to_string(id);
}

}  // namespace

std::string BodyName(const mjModel& model, int body) {
  return NameOf(model, mjOBJ_BODY, body, "body");
}

std::string JointName(const mjModel& model, int joint) {
  return NameOf(model, mjOBJ_JOINT, joint, "joint");
}

std::string ActuatorName(const mjModel& model, int actuator) {
  return NameOf(model, mjOBJ_ACTUATOR, actuator, "actuator");
}

Eigen::Vector3d VectorAt(const mjtNum* numbers, int index) {
  return Eigen::Map<const Eigen::Vector3d>(numbers + std::ptrdiff_t{3} * index);
}

Eigen::Isometry3d PoseAt(const mjtNum* positions, const mjtNum* matrices, int index) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = VectorAt(positions, index);
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  pose.linear() = Eigen::Map<const RowMajor>(matrices + std::ptrdiff_t{9} * index);
  return pose;
}

bool Collides(const mjModel& model, int geom) {
  return model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0;
}

int LinkOf(const mjModel& model, int body) {
  while (model.body_jntnum[body] == 0 && model.body_parentid[body] > 0) {
    body = model.body_parentid[body];
  }
  return body;
}

std::vector<int> JointsBetween(const mjModel& model, int above, int body) {
  std::vector<int> joints;
  for (; body != above && body > 0; body = model.body_parentid[body]) {
    for (int i = model.body_jntnum[body] - 1; i >= 0; --i) {
      joints.push_back(model.body_jntadr[body] + i);
    }
  }
  std::ranges::reverse(joints);
  return joints;
}

namespace {

constexpr double kSameRelation = 1e-9;

/// Affine dependence of a joint: angle = ratio · angle of `root` + offset, radians.
struct Follower {
  int root;
  double ratio = 1;
  double offset = 0;
};

/// Groups of joints that move together, each expressed by one of its joints.
class JointGroups {
 public:
  JointGroups(const mjModel& model, std::string file) : model_(model), file_(std::move(file)) {}

  void Add(const JointRelation& relation) {
    const Follower a = FollowerOf(relation.joint);
    const Follower b = FollowerOf(relation.leader);
    const double ratio = relation.ratio * b.ratio;
    const double offset = relation.ratio * b.offset + relation.offset;
    if (a.root != b.root) {
      Merge(a.root, {b.root, ratio / a.ratio, (offset - a.offset) / a.ratio});
      return;
    }
    const bool agrees = std::abs(a.ratio - ratio) <= kSameRelation * std::abs(a.ratio) &&
                        std::abs(a.offset - offset) <= kSameRelation;
    if (agrees || relation.shares_actuator) return;
    throw InputError(file_ + ": " + relation.source + ": couples joints " +
                     JointName(model_, relation.joint) + " and " +
                     JointName(model_, relation.leader) +
                     ", expected one relation between them, found another one before");
  }

  /// Return the joints of each group by root.
  [[nodiscard]] std::map<int, std::vector<int>> Members() const {
    std::map<int, std::vector<int>> members;
    for (const auto& [joint, follower] : followers_) members[follower.root].push_back(joint);
    return members;
  }
  [[nodiscard]] const Follower& At(int joint) const { return followers_.at(joint); }

 private:
  Follower FollowerOf(int joint) {
    return followers_.try_emplace(joint, Follower{joint}).first->second;
  }
  void Merge(int root, const Follower& into) {
    for (auto& [joint, follower] : followers_) {
      if (follower.root != root) continue;
      follower = {into.root, follower.ratio * into.ratio,
                  follower.ratio * into.offset + follower.offset};
    }
  }

  const mjModel& model_;
  std::string file_;
  std::map<int, Follower> followers_;  ///< dependence by joint
};

/// Return the joints that actuators move. A tendon counts for its first joint only.
std::set<int> DrivenJoints(const mjModel& model) {
  std::set<int> driven;
  for (int i = 0; i < model.nu; ++i) {
    const int type = model.actuator_trntype[i];
    const int target = model.actuator_trnid[2 * i];
    if (type == mjTRN_JOINT || type == mjTRN_JOINTINPARENT) driven.insert(target);
    if (type != mjTRN_TENDON) continue;
    const int first = model.tendon_adr[target];
    if (model.wrap_type[first] == mjWRAP_JOINT) driven.insert(model.wrap_objid[first]);
  }
  return driven;
}

std::string SharedActuatorsNote(const mjModel& model, const std::vector<JointRelation>& relations) {
  std::string shared;
  for (const JointRelation& relation : relations) {
    if (!relation.shares_actuator) continue;
    shared += (shared.empty() ? "" : ", ") + JointName(model, relation.leader) + " and " +
              JointName(model, relation.joint);
  }
  return shared.empty() ? ""
                        : "joints that share an actuator by a tendon, which imposes only the sum "
                          "of their angles; coupled in the ratio of its coefficients: " +
                              shared;
}

}  // namespace

std::vector<HandDescription::Coupling> DeriveCouplings(const CompiledModel& compiled,
                                                       const std::vector<std::vector<int>>& fingers,
                                                       std::vector<std::string>& notes) {
  const mjModel& model = *compiled.model;
  const std::vector<JointRelation> relations = ReadJointRelations(compiled, fingers);
  const std::string note = SharedActuatorsNote(model, relations);
  if (!note.empty()) notes.push_back(note);
  JointGroups groups(model, compiled.text.files.front().string());
  std::set<int> following;
  for (const bool assumed : {false, true}) {
    for (const JointRelation& relation : relations) {
      if (relation.shares_actuator != assumed) continue;
      groups.Add(relation);
      following.insert(relation.joint);
    }
  }
  const std::set<int> driven = DrivenJoints(model);
  std::map<int, HandDescription::Coupling> couplings;
  for (const auto& [root, joints] : groups.Members()) {
    const int leader = *std::ranges::max_element(joints, {}, [&](int joint) {
      return 2 * (driven.contains(joint) ? 1 : 0) + (following.contains(joint) ? 0 : 1);
    });
    const Follower& of_leader = groups.At(leader);
    for (const int joint : joints) {
      if (joint == leader) continue;
      const Follower& of_joint = groups.At(joint);
      const double ratio = of_joint.ratio / of_leader.ratio;
      couplings[joint] = {JointName(model, joint), JointName(model, leader), ratio,
                          of_joint.offset - ratio * of_leader.offset};
    }
  }
  std::vector<HandDescription::Coupling> found;
  for (auto& [joint, coupling] : couplings) found.push_back(std::move(coupling));
  return found;
}

namespace {

/// Largest number of names in a message; the rest is counted.
constexpr std::size_t kListedJoints = 6;

/// Return the largest force of an actuator; 0 if it has no limit.
/// The control range of a servo limits angles, not forces.
double LargestForce(const mjModel& model, int actuator) {
  const auto largest = [&](const mjtNum* ranges) {
    return std::max(std::abs(ranges[2 * actuator]), std::abs(ranges[2 * actuator + 1]));
  };
  if (model.actuator_forcelimited[actuator] != 0) return largest(model.actuator_forcerange);
  const mjtNum* bias = model.actuator_biasprm + std::ptrdiff_t{mjNBIAS} * actuator;
  const bool servo = model.actuator_biastype[actuator] == mjBIAS_AFFINE && bias[1] < 0;
  if (servo || model.actuator_ctrllimited[actuator] == 0) return 0;
  const double gain = std::abs(model.actuator_gainprm[std::ptrdiff_t{mjNGAIN} * actuator]);
  return gain * largest(model.actuator_ctrlrange);
}

std::vector<JointActuator> ActuatorsOfUrdf(const CompiledModel& compiled) {
  std::vector<JointActuator> actuators;
  for (int joint = 0; joint < compiled.model->njnt; ++joint) {
    const std::string name = JointName(*compiled.model, joint);
    const auto effort = compiled.text.efforts.find(name);
    const double torque = effort == compiled.text.efforts.end() ? 0 : effort->second;
    actuators.push_back({name, "a motor of its effort", torque});
  }
  return actuators;
}

std::string ListOf(const std::vector<std::string>& names) {
  std::string text = names.size() == 1 ? "joint " : "joints ";
  for (std::size_t i = 0; i < std::min(names.size(), kListedJoints); ++i) {
    text += (i > 0 ? ", " : "") + names[i];
  }
  if (names.size() > kListedJoints) {
    text += " and " + std::to_string(names.size() - kListedJoints) + " more";
  }
  return text;
}

}  // namespace

std::vector<JointActuator> ActuatorsOf(const CompiledModel& compiled) {
  if (compiled.text.root.name == "robot") return ActuatorsOfUrdf(compiled);
  const mjModel& model = *compiled.model;
  std::vector<JointActuator> actuators;
  for (int i = 0; i < model.nu; ++i) {
    const std::string name = ActuatorName(model, i);
    const int target = model.actuator_trnid[2 * i];
    const int type = model.actuator_trntype[i];
    const double gear = std::abs(model.actuator_gear[std::ptrdiff_t{6} * i]);
    const double torque = gear * LargestForce(model, i);
    if (type == mjTRN_JOINT || type == mjTRN_JOINTINPARENT) {
      actuators.push_back({JointName(model, target), name, torque});
    } else if (type == mjTRN_TENDON) {
      const int first = model.tendon_adr[target];
      for (int k = 0; k < model.tendon_num[target]; ++k) {
        if (model.wrap_type[first + k] != mjWRAP_JOINT) continue;
        actuators.push_back({JointName(model, model.wrap_objid[first + k]), name,
                             std::abs(model.wrap_prm[first + k]) * torque});
      }
    }
  }
  return actuators;
}

std::vector<std::string> ActuationWarnings(const HandModel& hand, const CompiledModel& compiled) {
  const std::vector<JointActuator> actuators = ActuatorsOf(compiled);
  if (actuators.empty()) return {"the model has no actuators: plans are not simulated"};
  std::vector<std::string> unmoved;
  std::vector<std::string> unlimited;
  for (const Finger& finger : hand.fingers) {
    for (int drive = 0; drive < finger.drives; ++drive) {
      const JointActuator* strongest = nullptr;
      for (const JointActuator& actuator : actuators) {
        const auto joint = std::ranges::find(finger.joints, actuator.joint, &Joint::name);
        if (joint == finger.joints.end() || joint->drive != drive) continue;
        // In a URDF model the independent joint has the actuator.
        if (compiled.text.root.name == "robot" && joint->follows) continue;
        const bool stronger =
            strongest == nullptr || actuator.largest_torque == 0 ||
            (strongest->largest_torque > 0 && actuator.largest_torque > strongest->largest_torque);
        if (stronger) strongest = &actuator;
      }
      const std::string& name = LeadingJoint(finger, drive).name;
      if (strongest == nullptr) unmoved.push_back(name);
      if (strongest != nullptr && strongest->largest_torque == 0) unlimited.push_back(name);
    }
  }
  std::vector<std::string> warnings;
  if (!unmoved.empty()) {
    warnings.push_back(ListOf(unmoved) + (unmoved.size() == 1 ? " has" : " have") +
                       " no actuator: plans are not simulated");
  }
  if (!unlimited.empty()) {
    warnings.push_back("force limit of " + ListOf(unlimited) + " unknown, treated as unlimited");
  }
  return warnings;
}

}  // namespace regrasp::kinematics
