#include "sim/actuation/hand_scene_text.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/number.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/actuation/model_numbers.h"
#include "sim/actuation/tip_contact.h"

namespace regrasp::sim {
namespace {

using Eigen::Matrix3d;
using kinematics::XmlElement;

std::string Numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + FormatDouble(value);
  return text;
}

XmlElement Element(std::string name, std::vector<std::pair<std::string, std::string>> attributes,
                   std::vector<XmlElement> children = {}) {
  XmlElement element;
  element.name = std::move(name);
  element.attributes = std::move(attributes);
  element.children = std::move(children);
  return element;
}

/// The object as the engine has it: a free body at its centroid, with the axes of its frame.
XmlElement ObjectBody(const object::Polyhedron& solid, double scale, double mass) {
  const object::MassProperties& properties = solid.mass_properties();
  const Matrix3d inertia = mass / properties.volume * scale * scale * properties.inertia;
  return Element("body", {{"name", kHandSceneObject}},
                 {Element("freejoint", {}),
                  Element("inertial", {{"pos", "0 0 0"},
                                       {"mass", FormatDouble(mass)},
                                       {"fullinertia",
                                        Numbers({inertia(0, 0), inertia(1, 1), inertia(2, 2),
                                                 inertia(0, 1), inertia(0, 2), inertia(1, 2)})}}),
                  Element("geom", {{"name", kHandSceneObject},
                                   {"type", "sphere"},
                                   {"size", "0.001"},
                                   {"contype", "0"},
                                   {"conaffinity", "0"}})});
}

/// The couplings of a finger as equality constraints, which are between angles beyond those of the
/// reference position.
void AddCouplings(const kinematics::Finger& finger, std::vector<XmlElement>& couplings) {
  for (const kinematics::Joint& joint : finger.joints) {
    if (!joint.follows) continue;
    const kinematics::Joint& leader = kinematics::LeadingJoint(finger, joint.drive);
    const double constant = joint.coupling_offset + joint.ratio * leader.rest - joint.rest;
    couplings.push_back(
        Element("joint", {{"joint1", joint.name},
                          {"joint2", leader.name},
                          // A linkage is hard: as hard as contacts are (tip_contact.h).
                          {"solref", FormatDouble(kTipContactTime) + " 1"},
                          {"solimp", NumbersText({kTipImpedance.begin(), kTipImpedance.end()})},
                          {"polycoef", Numbers({constant, joint.ratio, 0, 0, 0})}}));
  }
}

/// The joint that an actuator of MJCF moves; empty if it moves a tendon.
std::string JointOf(const XmlElement& actuator) {
  for (const char* attribute : {"joint", "jointinparent"}) {
    if (const std::string* name = actuator.Find(attribute)) return *name;
  }
  return "";
}

/// An actuator of a joint that follows another one would fight its coupling: without a command it
/// pulls to angle 0. It is left out if the other joint has an actuator of its own.
void DropFollowersActuators(const kinematics::HandModel& hand, XmlElement& root) {
  std::set<std::string> moved;
  for (const XmlElement& section : root.children) {
    if (section.name != "actuator") continue;
    for (const XmlElement& actuator : section.children) moved.insert(JointOf(actuator));
  }
  std::set<std::string> dropped;
  for (const kinematics::Finger& finger : hand.fingers) {
    for (const kinematics::Joint& joint : finger.joints) {
      const bool led = moved.contains(kinematics::LeadingJoint(finger, joint.drive).name);
      if (joint.follows && led) dropped.insert(joint.name);
    }
  }
  for (XmlElement& section : root.children) {
    if (section.name != "actuator") continue;
    std::erase_if(section.children,
                  [&](const XmlElement& actuator) { return dropped.contains(JointOf(actuator)); });
  }
}

/// A URDF has no actuators: each drive of a finger gets a motor, as strong as the joint may be.
kinematics::ModelText UrdfWithMotors(const kinematics::HandFile& file) {
  const kinematics::ModelText& urdf = file.compiled->text;
  kinematics::ModelText text = kinematics::AsMjcf(urdf.files.front(), urdf);
  std::vector<XmlElement> motors;
  for (const kinematics::Finger& finger : file.hand.fingers) {
    for (int drive = 0; drive < finger.drives; ++drive) {
      const std::string& name = kinematics::LeadingJoint(finger, drive).name;
      XmlElement& motor = motors.emplace_back(Element("motor", {{"joint", name}}));
      const auto found = urdf.efforts.find(name);
      if (found == urdf.efforts.end()) continue;
      const double effort = found->second;
      motor.Set("forcelimited", "true");
      motor.Set("forcerange", Numbers({-effort, effort}));
    }
  }
  text.root.children.push_back(Element("actuator", {}, std::move(motors)));
  return text;
}

/// `count` numbers of a body.
std::string BodyNumbers(const mjtNum* values, int body, int count) {
  return NumbersText(values + std::ptrdiff_t{count} * body, count);
}

/// Write the inertia of every body as the hand's model has it, in the order of its bodies.
void WriteInertias(const mjModel& model, XmlElement& element, int& last) {
  for (XmlElement& child : element.children) {
    if (child.name != "body" || ++last >= model.nbody) continue;
    const int body = last;
    std::erase_if(child.children, [](const XmlElement& part) { return part.name == "inertial"; });
    if (model.body_mass[body] > 0) {
      child.children.insert(
          child.children.begin(),
          Element("inertial", {{"pos", BodyNumbers(model.body_ipos, body, 3)},
                               {"quat", BodyNumbers(model.body_iquat, body, 4)},
                               {"mass", FormatDouble(model.body_mass[body])},
                               {"diaginertia", BodyNumbers(model.body_inertia, body, 3)}}));
    }
    WriteInertias(model, child, last);
  }
}

/// A compiler that derives masses, or scales them, would do so with the object as well.
void FixMasses(const mjModel& model, XmlElement& root) {
  int last = 0;
  for (XmlElement& section : root.children) {
    if (section.name == "worldbody") WriteInertias(model, section, last);
    if (section.name != "compiler") continue;
    for (const char* derives :
         {"inertiafromgeom", "settotalmass", "boundmass", "boundinertia", "balanceinertia"}) {
      section.Remove(derives);
    }
  }
}

}  // namespace

kinematics::ModelText HandSceneText(const kinematics::HandFile& file,
                                    const object::Polyhedron& solid, double scale, double mass) {
  kinematics::ModelText text = file.compiled->text;
  if (text.root.name == "robot") text = UrdfWithMotors(file);
  XmlElement& root = text.root;
  DropFollowersActuators(file.hand, root);
  FixMasses(*file.compiled->model, root);
  std::erase_if(root.children, [](const XmlElement& child) {
    return child.name == "keyframe" || child.name == "size" || child.name == "sensor";
  });
  root.children.push_back(Element("size", {{"njmax", "600"}, {"nconmax", "150"}}));
  root.children.push_back(Element("worldbody", {}, {ObjectBody(solid, scale, mass)}));
  std::vector<XmlElement> couplings;
  for (const kinematics::Finger& finger : file.hand.fingers) AddCouplings(finger, couplings);
  if (!couplings.empty()) root.children.push_back(Element("equality", {}, std::move(couplings)));
  return text;
}

}  // namespace regrasp::sim
