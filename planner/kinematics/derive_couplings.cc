#include "planner/kinematics/derive_couplings.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "planner/base/number.h"
#include "planner/kinematics/model_names.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {
namespace {

/// angle of `joint` = ratio · angle of `other`, whichever of them leads.
struct Relation {
  int joint;
  int other;
  double ratio;
};

class CouplingFinder {
 public:
  CouplingFinder(const CompiledModel& compiled, const std::vector<std::vector<int>>& fingers,
                 std::vector<std::string>& notes)
      : model_(*compiled.model), text_(compiled.text), notes_(notes) {
    for (int finger = 0; finger < static_cast<int>(fingers.size()); ++finger) {
      for (const int joint : fingers[finger]) finger_of_[joint] = finger;
    }
    for (int i = 0; i < model_.nu; ++i) {
      const int type = model_.actuator_trntype[i];
      const int target = model_.actuator_trnid[2 * i];
      if (type == mjTRN_JOINT || type == mjTRN_JOINTINPARENT) driven_.insert(target);
      if (type == mjTRN_TENDON) AddTendon(target);
    }
    if (!shared_.empty()) {
      notes_.push_back(
          "joints that share an actuator by a tendon, which gives the sum of their "
          "angles alone; taken in the ratio of its coefficients: " +
          shared_);
    }
    AddEqualities();
    AddMimics();
  }

  std::vector<HandDescription::Coupling> Find() {
    // What is led by an actuator first, then what follows from it.
    std::map<int, Relation> leader_of;
    const auto leads = [&](int joint) { return driven_.contains(joint); };
    for (Relation relation : relations_) {
      if (leads(relation.joint) && !leads(relation.other)) {
        relation = {relation.other, relation.joint, 1 / relation.ratio};
      }
      if (leader_of.contains(relation.joint)) {
        notes_.push_back("joint " + JointName(model_, relation.joint) +
                         " is coupled twice; only the first is taken");
        continue;
      }
      leader_of.emplace(relation.joint, relation);
    }
    std::vector<HandDescription::Coupling> couplings;
    for (const auto& [joint, first] : leader_of) {
      Relation relation = first;
      // Not longer than all of them, in case they lead in a circle.
      for (std::size_t i = 0; i < leader_of.size(); ++i) {
        const auto above = leader_of.find(relation.other);
        if (above == leader_of.end() || above->second.other == joint) break;
        relation = {joint, above->second.other, relation.ratio * above->second.ratio};
      }
      couplings.push_back(
          {JointName(model_, joint), JointName(model_, relation.other), relation.ratio});
    }
    return couplings;
  }

 private:
  void Add(const Relation& relation, const std::string& from) {
    const auto joint = finger_of_.find(relation.joint);
    const auto other = finger_of_.find(relation.other);
    if (joint == finger_of_.end() || other == finger_of_.end()) return;
    const std::string names =
        JointName(model_, relation.joint) + " and " + JointName(model_, relation.other);
    if (joint->second != other->second) {
      notes_.push_back(from + " couples joints " + names +
                       " of two fingers: not taken, fingers move each by itself");
      return;
    }
    if (relation.ratio == 0 || !std::isfinite(relation.ratio)) return;
    relations_.push_back(relation);
  }

  void AddTendon(int tendon);
  void AddEqualities();
  void AddMimics();

  const mjModel& model_;
  const ModelText& text_;
  std::vector<std::string>& notes_;
  std::map<int, int> finger_of_;
  std::set<int> driven_;
  std::vector<Relation> relations_;
  std::string shared_;  ///< pairs of joints
};

/// Only the sum of the angles is given by a tendon; in equal shares it pulls in the ratio of its
/// arms.
void CouplingFinder::AddTendon(int tendon) {
  const int first = model_.tendon_adr[tendon];
  const int count = model_.tendon_num[tendon];
  if (model_.wrap_type[first] != mjWRAP_JOINT) {
    const char* name = mj_id2name(&model_, mjOBJ_TENDON, tendon);
    notes_.push_back("tendon " + std::string(name != nullptr ? name : std::to_string(tendon)) +
                     " runs over sites and is pulled by one actuator: the joints that it turns "
                     "are taken as if each could move by itself");
    return;
  }
  const int leader = model_.wrap_objid[first];
  for (int i = 1; i < count; ++i) {
    const int joint = model_.wrap_objid[first + i];
    Add({joint, leader, model_.wrap_prm[first + i] / model_.wrap_prm[first]}, "a tendon");
    if (!shared_.empty()) shared_ += ", ";
    shared_ += JointName(model_, leader) + " and " + JointName(model_, joint);
  }
  driven_.insert(leader);
}

void CouplingFinder::AddEqualities() {
  for (int i = 0; i < model_.neq; ++i) {
    if (model_.eq_type[i] != mjEQ_JOINT || model_.eq_active[i] == 0) continue;
    const int joint = model_.eq_obj1id[i];
    const int other = model_.eq_obj2id[i];
    const mjtNum* polynomial = model_.eq_data + std::ptrdiff_t{mjNEQDATA} * i;
    const bool is_ratio = other >= 0 && polynomial[0] == 0 && polynomial[2] == 0 &&
                          polynomial[3] == 0 && polynomial[4] == 0;
    if (!is_ratio) {
      notes_.push_back("an equality of joint " + JointName(model_, joint) +
                       " is no ratio: not taken");
      continue;
    }
    // Constraints are between angles beyond those at rest.
    const double rest = model_.qpos0[model_.jnt_qposadr[joint]];
    const double other_rest = model_.qpos0[model_.jnt_qposadr[other]];
    if (std::abs(rest - polynomial[1] * other_rest) > 1e-9) {
      notes_.push_back("joint " + JointName(model_, joint) + " follows " +
                       JointName(model_, other) + " from another angle at rest than 0: doubtful");
    }
    Add({joint, other, polynomial[1]}, "an equality");
  }
}

void CouplingFinder::AddMimics() {
  for (const Mimic& mimic : text_.mimics) {
    const int joint = mj_name2id(&model_, mjOBJ_JOINT, mimic.joint.c_str());
    const int other = mj_name2id(&model_, mjOBJ_JOINT, mimic.follows.c_str());
    if (joint < 0 || other < 0) continue;
    if (mimic.offset != 0) {
      notes_.push_back("joint " + mimic.joint + " follows " + mimic.follows +
                       " with an offset of " + FormatShort(mimic.offset) +
                       " rad, which couplings do not have: not taken");
      continue;
    }
    Add({joint, other, mimic.multiplier}, "a mimic");
  }
}

}  // namespace

std::vector<HandDescription::Coupling> DeriveCouplings(const CompiledModel& compiled,
                                                       const std::vector<std::vector<int>>& fingers,
                                                       std::vector<std::string>& notes) {
  return CouplingFinder(compiled, fingers, notes).Find();
}

}  // namespace regrasp::kinematics
