#include "sim/hand_grasps/whole_hand.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/json.h"
#include "planner/base/number.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/fit_tip.h"
#include "planner/kinematics/hand_model.h"
#include "planner/plan/json_reader.h"
#include "sim/actuation/hand_scene_export.h"

namespace regrasp::sim {
namespace {

using kinematics::XmlElement;

constexpr char kHandFormat[] = "regrasp-hand";
/// Mass and inertia of the body that contains the hand, kg and kg m². They are small against those
/// of a hand.
constexpr char kFrameMass[] = "0.01";
constexpr char kFrameInertia[] = "1e-05 1e-05 1e-05";

/// Return the names of the joints that an actuator can move.
std::vector<std::string> ScalarJoints(const mjModel& model) {
  std::vector<std::string> names;
  for (int joint = 0; joint < model.njnt; ++joint) {
    const int type = model.jnt_type[joint];
    if (type == mjJNT_HINGE || type == mjJNT_SLIDE) {
      names.push_back(kinematics::JointName(model, joint));
    }
  }
  return names;
}

/// Return a URDF model as MJCF with couplings and actuators, which MuJoCo ignores.
kinematics::ModelText UrdfWithActuators(const kinematics::CompiledModel& compiled) {
  const kinematics::ModelText& urdf = compiled.text;
  kinematics::ModelText text = kinematics::MjcfOf(compiled);
  std::set<std::string> following;
  std::vector<XmlElement> couplings;
  std::vector<XmlElement> motors;
  for (const kinematics::Mimic& mimic : urdf.mimics) {
    following.insert(mimic.joint);
    couplings.push_back(kinematics::MakeElement(
        "joint", {{"joint1", mimic.joint},
                  {"joint2", mimic.follows},
                  {"polycoef",
                   FormatDouble(mimic.offset) + " " + FormatDouble(mimic.multiplier) + " 0 0 0"}}));
  }
  for (const std::string& joint : ScalarJoints(*compiled.model)) {
    if (following.contains(joint)) continue;
    XmlElement& motor = motors.emplace_back(kinematics::MakeElement("motor", {{"joint", joint}}));
    const auto found = urdf.efforts.find(joint);
    if (found == urdf.efforts.end()) continue;
    motor.Set("forcelimited", "true");
    motor.Set("forcerange", FormatDouble(-found->second) + " " + FormatDouble(found->second));
  }
  text.root.children.push_back(kinematics::MakeElement("actuator", {}, std::move(motors)));
  if (!couplings.empty()) {
    text.root.children.push_back(kinematics::MakeElement("equality", {}, std::move(couplings)));
  }
  return text;
}

/// Return the joints that the model itself constrains to other joints.
std::set<std::string> ConstrainedJoints(const kinematics::CompiledModel& compiled) {
  const mjModel& model = *compiled.model;
  std::set<std::string> joints;
  for (const kinematics::Mimic& mimic : compiled.text.mimics) joints.insert(mimic.joint);
  for (int i = 0; i < model.neq; ++i) {
    if (model.eq_type[i] != mjEQ_JOINT || model.eq_active[i] == 0) continue;
    for (const int joint : {model.eq_obj1id[i], model.eq_obj2id[i]}) {
      if (joint >= 0) joints.insert(kinematics::JointName(model, joint));
    }
  }
  return joints;
}

/// Return whether an actuator moves the sum of two joints by a fixed tendon.
bool ShareActuator(const mjModel& model, int joint, int other) {
  for (int a = 0; a < model.nu; ++a) {
    if (model.actuator_trntype[a] != mjTRN_TENDON) continue;
    const int tendon = model.actuator_trnid[2 * a];
    const int* wraps = model.wrap_objid + model.tendon_adr[tendon];
    const auto moves = [&](int id) {
      return std::find(wraps, wraps + model.tendon_num[tendon], id) !=
             wraps + model.tendon_num[tendon];
    };
    if (model.wrap_type[model.tendon_adr[tendon]] == mjWRAP_JOINT && moves(joint) && moves(other)) {
      return true;
    }
  }
  return false;
}

/// Return a joint that an actuator can move. @throws InputError  if the model does not have it.
int FindJoint(const plan::JsonReader& json, const mjModel& model) {
  const std::string name = json.String();
  for (int joint = 0; joint < model.njnt; ++joint) {
    const int type = model.jnt_type[joint];
    if ((type == mjJNT_HINGE || type == mjJNT_SLIDE) &&
        kinematics::JointName(model, joint) == name) {
      return joint;
    }
  }
  json.Fail("joint \"" + name + "\" not found in the model");
}

/// Remove the actuators of a joint. They would act against the coupling of the joint.
void RemoveActuators(const std::string& joint, XmlElement& root) {
  for (XmlElement& section : root.children) {
    if (section.name != "actuator") continue;
    std::erase_if(section.children, [&](const XmlElement& actuator) {
      const std::string* moved = actuator.Find("joint");
      if (moved == nullptr) moved = actuator.Find("jointinparent");
      return moved != nullptr && *moved == joint;
    });
  }
}

/// Impose the couplings of the hand file that the model does not impose. Joints of a fixed tendon
/// with an actuator are not coupled: only their sum is imposed, as in the model.
void ImposeCouplings(const plan::JsonReader& json, const kinematics::CompiledModel& compiled,
                     XmlElement& root) {
  if (!json.Has("couplings")) return;
  const mjModel& model = *compiled.model;
  const std::set<std::string> constrained = ConstrainedJoints(compiled);
  std::vector<XmlElement> couplings;
  for (const plan::JsonReader& coupling : json.Member("couplings").Elements()) {
    const int joint = FindJoint(coupling.Member("joint"), model);
    const int leader = FindJoint(coupling.Member("follows"), model);
    if (joint == leader) coupling.Member("follows").Fail("must differ from joint");
    const std::string name = kinematics::JointName(model, joint);
    const double ratio = coupling.Member("ratio").Number();
    const double offset = coupling.Has("offset") ? coupling.Member("offset").Number() : 0;
    if (constrained.contains(name) || ShareActuator(model, joint, leader)) continue;
    // MuJoCo relates positions relative to the reference configuration.
    const double constant = offset + ratio * model.qpos0[model.jnt_qposadr[leader]] -
                            model.qpos0[model.jnt_qposadr[joint]];
    couplings.push_back(kinematics::MakeElement(
        "joint", {{"joint1", name},
                  {"joint2", kinematics::JointName(model, leader)},
                  {"polycoef", FormatDouble(constant) + " " + FormatDouble(ratio) + " 0 0 0"}}));
    RemoveActuators(name, root);
  }
  if (couplings.empty()) return;
  root.children.push_back(kinematics::MakeElement("equality", {}, std::move(couplings)));
}

bool IsFreeJoint(const XmlElement& element) {
  const std::string* type = element.Find("type");
  return element.name == "freejoint" ||
         (element.name == "joint" && type != nullptr && *type == "free");
}

/// Return whether an element of the world moves with the hand. Lights, cameras and floors do not.
bool IsOfHand(const XmlElement& element) {
  if (element.name == "light" || element.name == "camera") return false;
  const std::string* type = element.Find("type");
  return element.name != "geom" || type == nullptr || (*type != "plane" && *type != "hfield");
}

/// Remove free joints, and name the bodies that have no name.
void PrepareBodies(XmlElement& element, int& bodies) {
  std::erase_if(element.children, IsFreeJoint);
  for (XmlElement& child : element.children) {
    if (child.name != "body") continue;
    const int number = ++bodies;
    if (child.Find("name") == nullptr) child.Set("name", "body " + std::to_string(number));
    PrepareBodies(child, bodies);
  }
}

/// Put everything in the world into one free body, and weld the palm to the mount.
void WrapHand(const std::string& palm, XmlElement& root) {
  XmlElement frame = kinematics::MakeElement(
      "body", {{"name", kWholeHandBody}},
      {kinematics::MakeElement("freejoint", {}),
       kinematics::MakeElement(
           "inertial", {{"pos", "0 0 0"}, {"mass", kFrameMass}, {"diaginertia", kFrameInertia}})});
  int bodies = 0;
  for (XmlElement& section : root.children) {
    if (section.name != "worldbody") continue;
    PrepareBodies(section, bodies);
    for (XmlElement& child : section.children) {
      if (IsOfHand(child)) frame.children.push_back(std::move(child));
    }
  }
  std::erase_if(root.children, [](const XmlElement& section) {
    return section.name == "worldbody" || section.name == "keyframe" || section.name == "size" ||
           section.name == "sensor";
  });
  root.children.push_back(kinematics::MakeElement("size", {{"njmax", "1200"}, {"nconmax", "250"}}));
  root.children.push_back(kinematics::MakeElement(
      "worldbody", {},
      {kinematics::MakeElement("body", {{"name", kWholeHandMount}, {"mocap", "true"}}),
       std::move(frame)}));
  root.children.push_back(kinematics::MakeElement(
      "equality", {},
      {kinematics::MakeElement(
          "weld", {{"body1", kWholeHandMount}, {"body2", palm}, {"relpose", "0 0 0 1 0 0 0"}})}));
}

/// Return the digest of the hand file, the model's files and the meshes, as that of a hand.
std::string HandDigest(const std::string& description, const kinematics::ModelText& model) {
  std::string digests = Sha256(description);
  for (const auto& file : model.files) digests += Sha256(ReadFile(file));
  for (const kinematics::MeshFile& mesh : model.meshes) digests += Sha256(ReadFile(mesh.path));
  return Sha256(digests);
}

/// Return the distance of the farthest point of the collision geometry from the palm's origin.
double LengthOf(const mjModel& model, int palm) {
  const kinematics::DataPtr rest = kinematics::AtRest(model);
  const Eigen::Vector3d origin = kinematics::VectorAt(rest->xpos, palm);
  double length = 0;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (!kinematics::Collides(model, geom)) continue;
    const Eigen::Isometry3d pose = kinematics::PoseAt(rest->geom_xpos, rest->geom_xmat, geom);
    const collision::ConvexShape shape = kinematics::ShapeOfGeom(model, geom);
    for (const Eigen::Vector3d& point : shape.points) {
      length = std::max(length, (pose * point - origin).norm() + shape.radius);
    }
  }
  return length;
}

}  // namespace

WholeHand ReadWholeHand(const std::filesystem::path& path) {
  const std::string file = ReadFile(path);
  const Json value = ParseJson(file, path.string());
  const plan::JsonReader json(value, path.string());
  json.ExpectFormat(kHandFormat);
  WholeHand hand;
  hand.name = json.Member("name").String();
  hand.palm = json.Member("palm").String();
  hand.model_file = path.parent_path() / json.Member("model").String();
  hand.compiled =
      std::make_shared<const kinematics::CompiledModel>(kinematics::CompileModel(hand.model_file));
  kinematics::CheckPhysics(*hand.compiled);
  const mjModel& model = *hand.compiled->model;
  const int palm = mj_name2id(&model, mjOBJ_BODY, hand.palm.c_str());
  if (palm <= 0) json.Member("palm").Fail("body \"" + hand.palm + "\" not found in the model");
  hand.length = LengthOf(model, palm);
  if (hand.length == 0) {
    throw InputError(hand.model_file.string() + ": no geom collides, expected collision geometry");
  }
  hand.sha256 = HandDigest(file, hand.compiled->text);
  hand.text = hand.compiled->text;
  if (hand.text.root.name == "robot") hand.text = UrdfWithActuators(*hand.compiled);
  FixMasses(model, hand.text.root);
  ImposeCouplings(json, *hand.compiled, hand.text.root);
  WrapHand(hand.palm, hand.text.root);
  return hand;
}

}  // namespace regrasp::sim
