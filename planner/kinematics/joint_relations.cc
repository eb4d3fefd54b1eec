#include "planner/kinematics/joint_relations.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {
namespace {

/// Linear equation of joint angles: Σ coefficient · angle = constant, radians.
struct JointEquation {
  std::map<int, double> coefficients;  ///< coefficients, by joint of the model
  double constant = 0;
  std::string source;
};

class RelationReader {
 public:
  RelationReader(const CompiledModel& compiled, const std::vector<std::vector<int>>& fingers)
      : model_(*compiled.model), text_(compiled.text) {
    for (int finger = 0; finger < static_cast<int>(fingers.size()); ++finger) {
      for (const int joint : fingers[finger]) finger_of_[joint] = finger;
    }
  }

  std::vector<JointRelation> Read() {
    for (int i = 0; i < model_.neq; ++i) {
      if (model_.eq_active[i] != 0) ReadEquality(i);
    }
    for (const Mimic& mimic : text_.mimics) ReadMimic(mimic);
    for (int i = 0; i < model_.nu; ++i) {
      if (model_.actuator_trntype[i] == mjTRN_TENDON) ReadDrivenTendon(i);
    }
    for (int tendon = 0; tendon < model_.ntendon; ++tendon) {
      if (model_.tendon_limited[tendon] != 0) RefuseLimit(tendon);
    }
    return std::move(relations_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(text_.files.front().string() + ": " + what);
  }
  [[nodiscard]] bool IsOfFinger(int joint) const { return finger_of_.contains(joint); }
  [[nodiscard]] std::string Names(const std::set<int>& joints) const {
    std::string names = joints.size() == 1 ? "joint " : "joints ";
    bool first = true;
    for (const int joint : joints) {
      names += (first ? "" : ", ") + JointName(model_, joint);
      first = false;
    }
    return names;
  }
  [[nodiscard]] std::string TendonText(int tendon) const {
    const char* name = mj_id2name(&model_, mjOBJ_TENDON, tendon);
    return "tendon " + (name != nullptr && *name != '\0' ? name : std::to_string(tendon));
  }
  [[nodiscard]] bool IsFixed(int tendon) const {
    return model_.wrap_type[model_.tendon_adr[tendon]] == mjWRAP_JOINT;
  }

  void ReadEquality(int equality);
  void ReadJointEquality(int equality);
  void ReadTendonEquality(int equality);
  void ReadMimic(const Mimic& mimic);
  void ReadDrivenTendon(int actuator);
  void RefuseLoop(const std::string& source, int a, int b) const;
  void RefuseLimit(int tendon) const;
  void RefuseSpatial(const std::string& source, int tendon) const;
  void AddTendon(int tendon, double factor, JointEquation& equation) const;
  void AddRelation(const JointEquation& equation, int leader, bool shares_actuator = false);
  void ExpectOneFinger(int joint, int leader, const std::string& source) const;
  [[nodiscard]] std::set<int> FingerJointsBetween(int a, int b) const;
  [[nodiscard]] std::vector<int> BodiesOf(int tendon) const;

  const mjModel& model_;
  const ModelText& text_;
  std::map<int, int> finger_of_;  ///< finger by joint
  std::vector<JointRelation> relations_;
};

/// Return the finger joints that move one body relative to another.
std::set<int> RelationReader::FingerJointsBetween(int a, int b) const {
  std::set<int> joints;
  // A body with the larger index cannot be an ancestor of a body with a smaller index.
  while (a != b) {
    int& lower = a > b ? a : b;
    for (int i = 0; i < model_.body_jntnum[lower]; ++i) {
      const int joint = model_.body_jntadr[lower] + i;
      if (IsOfFinger(joint)) joints.insert(joint);
    }
    lower = model_.body_parentid[lower];
  }
  return joints;
}

std::vector<int> RelationReader::BodiesOf(int tendon) const {
  std::vector<int> bodies;
  for (int i = 0; i < model_.tendon_num[tendon]; ++i) {
    const int wrap = model_.tendon_adr[tendon] + i;
    const int id = model_.wrap_objid[wrap];
    const int type = model_.wrap_type[wrap];
    if (type == mjWRAP_SITE) bodies.push_back(model_.site_bodyid[id]);
    if (type == mjWRAP_SPHERE || type == mjWRAP_CYLINDER) bodies.push_back(model_.geom_bodyid[id]);
  }
  return bodies;
}

void RelationReader::RefuseLoop(const std::string& source, int a, int b) const {
  const std::set<int> joints = FingerJointsBetween(a, b);
  if (joints.empty()) return;
  Fail(Names(joints) +
       ": part of a closed loop, expected fingers that are open chains of joints, " + "found " +
       source);
}

void RelationReader::RefuseSpatial(const std::string& source, int tendon) const {
  const std::vector<int> bodies = BodiesOf(tendon);
  std::set<int> joints;
  for (std::size_t i = 1; i < bodies.size(); ++i)
    joints.merge(FingerJointsBetween(bodies[0], bodies[i]));
  if (joints.empty()) return;
  Fail(Names(joints) + ": moved by a spatial tendon, expected joints that actuators or fixed " +
       "tendons move, found " + source);
}

/// Reject a range of a sum of angles, which limits of single joints cannot represent.
void RelationReader::RefuseLimit(int tendon) const {
  const std::string source = "the range of " + TendonText(tendon);
  if (!IsFixed(tendon)) {
    RefuseSpatial(source, tendon);
    return;
  }
  std::set<int> joints;
  for (int i = 0; i < model_.tendon_num[tendon]; ++i) {
    const int joint = model_.wrap_objid[model_.tendon_adr[tendon] + i];
    if (IsOfFinger(joint)) joints.insert(joint);
  }
  if (joints.empty()) return;
  Fail(Names(joints) + ": limited by a tendon, expected joints with limits of their own, found " +
       source);
}

void RelationReader::ReadEquality(int equality) {
  const int first = model_.eq_obj1id[equality];
  const int second = model_.eq_obj2id[equality];
  switch (model_.eq_type[equality]) {
    case mjEQ_JOINT:
      ReadJointEquality(equality);
      return;
    case mjEQ_TENDON:
      ReadTendonEquality(equality);
      return;
    case mjEQ_CONNECT:
    case mjEQ_WELD: {
      const int other = std::max(second, 0);
      const bool connects = model_.eq_type[equality] == mjEQ_CONNECT;
      RefuseLoop(std::string(connects ? "<connect>" : "<weld>") + " of bodies " +
                     BodyName(model_, first) + " and " + BodyName(model_, other),
                 first, other);
      return;
    }
    default:
      RefuseLoop("<distance> of two geoms", model_.geom_bodyid[first],
                 second < 0 ? 0 : model_.geom_bodyid[second]);
  }
}

/// Return whether a polynomial of degree 4 has no term beyond the linear one.
bool IsLinear(const mjtNum* polynomial) {
  return polynomial[2] == 0 && polynomial[3] == 0 && polynomial[4] == 0;
}

std::string PolynomialText(const mjtNum* polynomial) {
  std::string text;
  for (int i = 0; i < 5; ++i) text += (i > 0 ? " " : "") + FormatShort(polynomial[i]);
  return "polycoef=\"" + text + "\"";
}

/// Read a constraint between joints. Its angles are relative to the reference configuration.
void RelationReader::ReadJointEquality(int equality) {
  const int joint = model_.eq_obj1id[equality];
  const int leader = model_.eq_obj2id[equality];
  if (!IsOfFinger(joint) && !IsOfFinger(leader)) return;
  const mjtNum* polynomial = model_.eq_data + std::ptrdiff_t{mjNEQDATA} * equality;
  const std::string name = "equality constraint of joint " + JointName(model_, joint);
  if (leader >= 0 && !IsLinear(polynomial)) {
    Fail(name + ": expected a linear relation, found " + PolynomialText(polynomial));
  }
  JointEquation equation{{{joint, 1}}, polynomial[0], name};
  equation.constant += model_.qpos0[model_.jnt_qposadr[joint]];
  if (leader >= 0 && polynomial[1] != 0) {
    equation.coefficients[leader] -= polynomial[1];
    equation.constant -= polynomial[1] * model_.qpos0[model_.jnt_qposadr[leader]];
  }
  AddRelation(equation, leader);
}

void RelationReader::AddTendon(int tendon, double factor, JointEquation& equation) const {
  for (int i = 0; i < model_.tendon_num[tendon]; ++i) {
    const int wrap = model_.tendon_adr[tendon] + i;
    const int joint = model_.wrap_objid[wrap];
    const double coefficient = factor * model_.wrap_prm[wrap];
    equation.coefficients[joint] += coefficient;
    equation.constant += coefficient * model_.qpos0[model_.jnt_qposadr[joint]];
  }
}

void RelationReader::ReadTendonEquality(int equality) {
  const int first = model_.eq_obj1id[equality];
  const int second = model_.eq_obj2id[equality];
  const mjtNum* polynomial = model_.eq_data + std::ptrdiff_t{mjNEQDATA} * equality;
  const std::string name = "equality constraint of " + TendonText(first);
  JointEquation equation{{}, polynomial[0], name};
  bool is_spatial = false;
  for (const auto& [tendon, factor] : {std::pair(first, 1.0), {second, -polynomial[1]}}) {
    if (tendon < 0) continue;
    if (IsFixed(tendon)) {
      AddTendon(tendon, factor, equation);
    } else {
      RefuseSpatial(name, tendon);
      is_spatial = true;
    }
  }
  const auto& terms = equation.coefficients;
  if (std::ranges::none_of(terms, [&](const auto& term) { return IsOfFinger(term.first); })) return;
  if (is_spatial) Fail(name + ": expected fixed tendons, found a spatial tendon");
  if (second >= 0 && !IsLinear(polynomial)) {
    Fail(name + ": expected a linear relation, found " + PolynomialText(polynomial));
  }
  AddRelation(equation, model_.wrap_objid[model_.tendon_adr[second >= 0 ? second : first]]);
}

void RelationReader::ReadMimic(const Mimic& mimic) {
  const auto find = [&](const std::string& name) {
    const int joint = mj_name2id(&model_, mjOBJ_JOINT, name.c_str());
    if (joint < 0) {
      Fail("<mimic> of joint " + mimic.joint + ": expected a joint that moves, found \"" + name +
           "\"");
    }
    return joint;
  };
  const int joint = find(mimic.joint);
  const int leader = find(mimic.follows);
  if (joint == leader) Fail("<mimic> of joint " + mimic.joint + ": expected another joint");
  JointEquation equation{{{joint, 1}}, mimic.offset, "<mimic> of joint " + mimic.joint};
  equation.coefficients[leader] -= mimic.multiplier;
  AddRelation(equation, leader);
}

/// Read a fixed tendon with an actuator.
/// The tendon imposes only the sum of the angles. Equal shares of it correspond to the ratio of the
/// tendon's coefficients.
void RelationReader::ReadDrivenTendon(int actuator) {
  const int tendon = model_.actuator_trnid[2 * actuator];
  const std::string name = TendonText(tendon) + " of actuator " + ActuatorName(model_, actuator);
  if (!IsFixed(tendon)) {
    RefuseSpatial(name, tendon);
    return;
  }
  JointEquation sum{{}, 0, name};
  AddTendon(tendon, 1, sum);
  std::erase_if(sum.coefficients, [](const auto& term) { return term.second == 0; });
  int leader = model_.wrap_objid[model_.tendon_adr[tendon]];
  if (!sum.coefficients.contains(leader)) {
    if (sum.coefficients.empty()) return;
    leader = sum.coefficients.begin()->first;
  }
  const double arm = sum.coefficients.at(leader);
  for (const auto& [joint, coefficient] : sum.coefficients) {
    if (joint == leader) continue;
    AddRelation({{{joint, 1}, {leader, -coefficient / arm}}, 0, name}, leader, true);
  }
}

void RelationReader::ExpectOneFinger(int joint, int leader, const std::string& source) const {
  const auto first = finger_of_.find(joint);
  const auto second = finger_of_.find(leader);
  const bool both = first != finger_of_.end() && second != finger_of_.end();
  if (both && first->second == second->second) return;
  Fail(source + ": couples joints " + JointName(model_, joint) + " and " +
       JointName(model_, leader) + ", expected two joints of one finger, found " +
       (both ? "joints of two fingers" : "a joint outside the fingers"));
}

/// Add the relation that an equation implies.
/// @param leader  independent joint, if the equation contains it.
void RelationReader::AddRelation(const JointEquation& equation, int leader, bool shares_actuator) {
  std::set<int> joints;
  for (const auto& [id, coefficient] : equation.coefficients) {
    if (coefficient != 0) joints.insert(id);
  }
  if (std::ranges::none_of(joints, [&](int id) { return IsOfFinger(id); })) return;
  if (joints.size() == 1) {
    Fail(equation.source + ": fixes " + Names(joints) + ", expected joints of fingers that move");
  }
  if (joints.size() > 2) {
    Fail(equation.source + ": couples " + Names(joints) + ", expected two joints");
  }
  if (!joints.contains(leader)) leader = *joints.begin();
  const int joint = *joints.begin() == leader ? *joints.rbegin() : *joints.begin();
  ExpectOneFinger(joint, leader, equation.source);
  const double own = equation.coefficients.at(joint);
  relations_.push_back({joint, leader, -equation.coefficients.at(leader) / own,
                        equation.constant / own, shares_actuator, equation.source});
}

}  // namespace

std::vector<JointRelation> ReadJointRelations(const CompiledModel& compiled,
                                              const std::vector<std::vector<int>>& fingers) {
  return RelationReader(compiled, fingers).Read();
}

}  // namespace regrasp::kinematics
