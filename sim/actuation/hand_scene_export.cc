#include "sim/actuation/hand_scene_export.h"

#include <mujoco/mujoco.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/actuation/model_numbers.h"
#include "sim/actuation/surface_shell.h"
#include "sim/actuation/tip_geometry.h"

namespace regrasp::sim {

namespace {

using Eigen::Matrix3d;
using kinematics::XmlElement;

std::string Numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + FormatDouble(value);
  return text;
}

/// Smallest principal moment of inertia of a body, kg m². MuJoCo requires more than 1e-15.
constexpr double kSmallestInertia = 1e-14;

/// Return the object's body as in the engine: free, at its centroid, with the axes of its frame.
XmlElement ObjectBody(const object::Polyhedron& solid, double scale, double mass) {
  const object::MassProperties& properties = solid.mass_properties();
  const Matrix3d inertia = mass / properties.volume * scale * scale * properties.inertia;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> principal(inertia, Eigen::EigenvaluesOnly);
  if (!(principal.eigenvalues().x() > kSmallestInertia)) {
    throw InputError("the object's mass of " + FormatMass(mass) + " is too small to simulate");
  }
  return kinematics::MakeElement(
      "body", {{"name", kHandSceneObject}},
      {kinematics::MakeElement("freejoint", {}),
       kinematics::MakeElement(
           "inertial", {{"pos", "0 0 0"},
                        {"mass", FormatDouble(mass)},
                        {"fullinertia", Numbers({inertia(0, 0), inertia(1, 1), inertia(2, 2),
                                                 inertia(0, 1), inertia(0, 2), inertia(1, 2)})}}),
       kinematics::MakeElement("geom", {{"name", kHandSceneObject},
                                        {"type", "sphere"},
                                        {"size", "0.001"},
                                        {"contype", "0"},
                                        {"conaffinity", "0"}})});
}

/// Add the couplings of a finger as equality constraints. They relate angles relative to the
/// reference configuration.
void AddCouplings(const kinematics::Finger& finger, std::vector<XmlElement>& couplings) {
  for (const kinematics::Joint& joint : finger.joints) {
    if (!joint.follows) continue;
    const kinematics::Joint& leader = kinematics::LeadingJoint(finger, joint.drive);
    const double constant = joint.coupling_offset + joint.ratio * leader.rest - joint.rest;
    couplings.push_back(kinematics::MakeElement(
        "joint", {{"joint1", joint.name},
                  {"joint2", leader.name},
                  // A linkage is as stiff as contacts (tip_geometry.h).
                  {"solref", FormatDouble(kTipContactTime) + " 1"},
                  {"solimp", NumbersText({kTipImpedance.begin(), kTipImpedance.end()})},
                  {"polycoef", Numbers({constant, joint.ratio, 0, 0, 0})}}));
  }
}

/// Return the joint that an actuator of MJCF moves; empty if it moves a tendon.
std::string JointOf(const XmlElement& actuator) {
  for (const char* attribute : {"joint", "jointinparent"}) {
    if (const std::string* name = actuator.Find(attribute)) return *name;
  }
  return "";
}

/// Remove actuators of joints that follow another joint, if that joint has its own actuator.
/// Without a command such an actuator pulls to angle 0, against the coupling.
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

/// Return a URDF model with an actuator for each independent joint of a finger. A URDF has none.
/// The force limits are those of the joints.
kinematics::ModelText UrdfWithMotors(const kinematics::HandFile& file) {
  const kinematics::ModelText& urdf = file.compiled->text;
  kinematics::ModelText text = kinematics::MjcfOf(*file.compiled);
  std::vector<XmlElement> motors;
  for (const kinematics::Finger& finger : file.hand.fingers) {
    for (int drive = 0; drive < finger.drives; ++drive) {
      const std::string& name = kinematics::LeadingJoint(finger, drive).name;
      XmlElement& motor = motors.emplace_back(kinematics::MakeElement("motor", {{"joint", name}}));
      const auto found = urdf.efforts.find(name);
      if (found == urdf.efforts.end()) continue;
      const double effort = found->second;
      motor.Set("forcelimited", "true");
      motor.Set("forcerange", Numbers({-effort, effort}));
    }
  }
  text.root.children.push_back(kinematics::MakeElement("actuator", {}, std::move(motors)));
  return text;
}

/// Return the text of `count` numbers of a body.
std::string BodyNumbers(const mjtNum* values, int body, int count) {
  return NumbersText(values + std::ptrdiff_t{count} * body, count);
}

/// Write the inertia of every body of the hand's model, in the order of its bodies.
void WriteInertias(const mjModel& model, XmlElement& element, int& last) {
  for (XmlElement& child : element.children) {
    if (child.name != "body" || ++last >= model.nbody) continue;
    const int body = last;
    std::erase_if(child.children, [](const XmlElement& part) { return part.name == "inertial"; });
    if (model.body_mass[body] > 0) {
      child.children.insert(
          child.children.begin(),
          kinematics::MakeElement("inertial",
                                  {{"pos", BodyNumbers(model.body_ipos, body, 3)},
                                   {"quat", BodyNumbers(model.body_iquat, body, 4)},
                                   {"mass", FormatDouble(model.body_mass[body])},
                                   {"diaginertia", BodyNumbers(model.body_inertia, body, 3)}}));
    }
    WriteInertias(model, child, last);
  }
}

}  // namespace

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
  root.children.push_back(kinematics::MakeElement("size", {{"njmax", "600"}, {"nconmax", "150"}}));
  root.children.push_back(
      kinematics::MakeElement("worldbody", {}, {ObjectBody(solid, scale, mass)}));
  std::vector<XmlElement> couplings;
  for (const kinematics::Finger& finger : file.hand.fingers) AddCouplings(finger, couplings);
  if (!couplings.empty())
    root.children.push_back(kinematics::MakeElement("equality", {}, std::move(couplings)));
  return text;
}

namespace {

constexpr const char* kMeshPrefix = "mesh_";
constexpr const char* kTipPrefix = "regrasp_tip_";
constexpr const char* kPiecePrefix = "regrasp_object_";

void ForEach(XmlElement& element, const std::function<void(XmlElement&)>& visit) {
  visit(element);
  for (XmlElement& child : element.children) ForEach(child, visit);
}

/// Return the section of that name; create it if it is missing.
XmlElement& Section(XmlElement& root, const std::string& name) {
  const auto found = std::ranges::find(root.children, name, &XmlElement::name);
  return found != root.children.end()
             ? *found
             : root.children.emplace_back(kinematics::MakeElement(name, {}));
}

class SceneWriter {
 public:
  SceneWriter(const kinematics::HandFile& file, const object::Polyhedron& solid, double scale,
              const HandWorldOptions& options)
      : file_(file),
        solid_(solid),
        scale_(scale),
        mu_(options.mu),
        own_tips_(options.tip == TipShape::kGeometry),
        world_(file, solid, scale, options),
        text_(kinematics::AsMjcf(file.compiled->text.files.front(),
                                 HandSceneText(file, solid, scale, options.mass_kg))) {
    if (!IsConvex(solid)) shell_ = SurfaceShell(solid, scale);
  }

  std::vector<SceneFile> Write(const std::vector<SceneKey>& keys) {
    XmlElement& root = text_.root;
    // Remove elements that some versions of MuJoCo name differently or do not have.
    std::erase_if(root.children, [](const XmlElement& child) {
      return child.name == "size" || child.name == "statistic" || child.name == "custom";
    });
    std::vector<SceneFile> files = TakeMeshes();
    SetOptions(Section(root, "option"));
    WriteModelNumbers(world_.model(), root);
    SetBodies();
    AddContacts();
    XmlElement& frames = Section(root, "keyframe");
    for (const SceneKey& key : keys) {
      frames.children.push_back(
          kinematics::MakeElement("key", {{"name", key.name},
                                          {"time", FormatDouble(key.time_s)},
                                          {"qpos", NumbersText(key.qpos)},
                                          {"ctrl", NumbersText(key.controls)}}));
    }
    files.push_back({kSceneName, kinematics::FormatXml(root)});
    return files;
  }

 private:
  /// Return the mesh files under new names. Textures are omitted.
  std::vector<SceneFile> TakeMeshes() {
    std::vector<SceneFile> files;
    ForEach(text_.root, [](XmlElement& element) {
      if (element.name == "compiler") {
        element.Remove("meshdir");
        element.Remove("texturedir");
      }
      if (element.name == "material") element.Remove("texture");
      std::erase_if(element.children, [](const XmlElement& child) {
        return child.name == "texture" || child.name == "hfield";
      });
    });
    ForEach(text_.root, [&](XmlElement& element) {
      const std::string* named = element.name == "mesh" ? element.Find("file") : nullptr;
      if (named == nullptr) return;
      const std::filesystem::path path = MeshPath(*named);
      const std::string name =
          kMeshPrefix + std::to_string(files.size()) + path.extension().string();
      files.push_back({name, kinematics::ReadMeshFile(path)});
      // An unnamed mesh gets the name of its file.
      if (element.Find("name") == nullptr) {
        element.Set("name", std::filesystem::path(*named).stem().string());
      }
      element.Set("file", name);
    });
    return files;
  }

  [[nodiscard]] std::filesystem::path MeshPath(const std::string& named) const {
    const auto mesh = std::ranges::find_if(text_.meshes, [&](const kinematics::MeshFile& known) {
      return known.alias.empty() ? ("/" + known.path.string()).ends_with("/" + named)
                                 : known.alias == named;
    });
    return mesh == text_.meshes.end() ? std::filesystem::path(named) : mesh->path;
  }

  /// Set the options that the replay changes from their defaults (SetReplayOptions).
  void SetOptions(XmlElement& option) const {
    const mjOption& opt = world_.model().opt;
    option.attributes = {{"timestep", FormatDouble(opt.timestep)},
                         {"gravity", NumbersText(opt.gravity, 3)},
                         {"cone", "elliptic"},
                         {"impratio", FormatDouble(opt.impratio)},
                         {"tolerance", FormatDouble(opt.tolerance)},
                         {"integrator", opt.integrator == mjINT_IMPLICIT ? "implicit" : "Euler"}};
    option.children.clear();
  }

  void SetBodies() {
    XmlElement& assets = Section(text_.root, "asset");
    assets.children.push_back(ObjectMesh());
    for (std::size_t i = 0; i < shell_.size(); ++i) assets.children.push_back(PieceMesh(i));
    ForEach(text_.root, [&](XmlElement& element) {
      const std::string* name = element.Find("name");
      if (element.name == "geom") {
        if (name != nullptr && *name == kHandSceneObject) {
          element.attributes = {{"name", *name}, {"type", "mesh"}, {"mesh", kHandSceneObject}};
        }
        // Only fingertips and the object make contact: AddContacts.
        element.Set("contype", "0");
        element.Set("conaffinity", "0");
      } else if (element.name == "body" && name != nullptr) {
        if (*name == kHandSceneObject) AddToObject(element);
        AddTip(*name, element);
      }
    });
  }

  /// Add the site of the origin, and the pieces that collide in place of a nonconvex object.
  void AddToObject(XmlElement& body) {
    body.children.push_back(OriginSite());
    for (std::size_t i = 0; i < shell_.size(); ++i) {
      body.children.push_back(kinematics::MakeElement("geom", {{"name", PieceName(i)},
                                                               {"type", "mesh"},
                                                               {"mesh", PieceName(i)},
                                                               {"mass", "0"},
                                                               {"group", "3"},
                                                               {"contype", "0"},
                                                               {"conaffinity", "0"}}));
    }
  }

  [[nodiscard]] static std::string PieceName(std::size_t piece) {
    return kPiecePrefix + std::to_string(piece);
  }

  void AddTip(const std::string& body, XmlElement& element) {
    const auto& tips = file_.description.tips;
    for (std::size_t i = 0; i < tips.size(); ++i) {
      if (tips[i].body != body) continue;
      if (own_tips_) {
        NameTips(body, element);
        continue;
      }
      tips_.push_back(kTipPrefix + std::to_string(i));
      element.children.push_back(
          kinematics::MakeElement("geom", {{"name", tips_.back()},
                                           {"type", "sphere"},
                                           {"size", FormatDouble(tips[i].radius)},
                                           {"pos", NumbersText(tips[i].centre.data(), 3)},
                                           {"mass", "0"},
                                           {"rgba", "0.9 0.5 0.1 0.5"},
                                           {"contype", "0"},
                                           {"conaffinity", "0"}}));
    }
  }

  /// Return the origin of the object's file, in the frame of the object's body at its centroid.
  [[nodiscard]] XmlElement OriginSite() const {
    const Eigen::Vector3d origin = -scale_ * solid_.mass_properties().centroid;
    return kinematics::MakeElement(
        "site", {{"name", kSceneOrigin}, {"pos", NumbersText(origin.data(), 3)}});
  }

  /// Return the object's mesh about its centroid, in metres.
  [[nodiscard]] XmlElement ObjectMesh() const {
    std::vector<Eigen::Vector3d> vertices;
    for (const Eigen::Vector3d& vertex : solid_.vertices()) {
      vertices.emplace_back(scale_ * (vertex - solid_.mass_properties().centroid));
    }
    return Mesh(kHandSceneObject, vertices, solid_.triangles());
  }

  [[nodiscard]] XmlElement PieceMesh(std::size_t piece) const {
    return Mesh(PieceName(piece), shell_[piece], {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}});
  }

  [[nodiscard]] static XmlElement Mesh(const std::string& name,
                                       std::span<const Eigen::Vector3d> vertices,
                                       const std::vector<std::array<int, 3>>& triangles) {
    std::vector<double> numbers;
    for (const Eigen::Vector3d& at : vertices) numbers.insert(numbers.end(), at.begin(), at.end());
    std::string faces;
    for (const auto& triangle : triangles) {
      for (const int corner : triangle)
        faces += (faces.empty() ? "" : " ") + std::to_string(corner);
    }
    return kinematics::MakeElement(
        "mesh",
        // The hand's model may have a default scale of meshes.
        {{"name", name}, {"scale", "1 1 1"}, {"vertex", NumbersText(numbers)}, {"face", faces}});
  }

  /// Name the colliding geoms of a fingertip's link.
  void NameTips(const std::string& body, XmlElement& element) {
    const mjModel& model = *file_.compiled->model;
    int geom = model.body_geomadr[mj_name2id(&model, mjOBJ_BODY, body.c_str())];
    for (XmlElement& child : element.children) {
      if (child.name != "geom") continue;
      if (kinematics::Collides(model, geom++)) {
        if (child.Find("name") == nullptr) {
          child.Set("name", kTipPrefix + std::to_string(tips_.size()));
        }
        tips_.push_back(*child.Find("name"));
      }
    }
  }

  /// Add contacts of each fingertip with the object or each of its pieces.
  void AddContacts() {
    XmlElement& defaults = Section(text_.root, "default");
    std::erase_if(defaults.children, [](const XmlElement& child) { return child.name == "pair"; });
    const std::string mu = FormatDouble(mu_);
    defaults.children.push_back(kinematics::MakeElement(
        "pair", {{"condim", "3"},
                 {"friction", mu + " " + mu + " 0.005 0.0001 0.0001"},
                 {"solref", FormatDouble(kTipContactTime) + " 1"},
                 {"solimp", NumbersText(kTipImpedance.data(), kTipImpedance.size())}}));
    XmlElement& contacts = Section(text_.root, "contact");
    std::erase_if(contacts.children, [](const XmlElement& child) { return child.name == "pair"; });
    for (const std::string& tip : tips_) {
      if (shell_.empty()) AddContact(contacts, tip, kHandSceneObject);
      for (std::size_t i = 0; i < shell_.size(); ++i) AddContact(contacts, tip, PieceName(i));
    }
  }

  static void AddContact(XmlElement& contacts, const std::string& tip, const std::string& object) {
    contacts.children.push_back(
        kinematics::MakeElement("pair", {{"geom1", tip}, {"geom2", object}}));
  }

  const kinematics::HandFile& file_;
  const object::Polyhedron& solid_;
  double scale_;
  double mu_;
  bool own_tips_;
  HandWorld world_;
  kinematics::ModelText text_;
  std::vector<ShellPiece> shell_;  ///< convex pieces of a nonconvex object
  std::vector<std::string> tips_;  ///< names of the geoms that touch the object
};

}  // namespace

bool IsSceneFile(const std::string& name) {
  return name == kSceneName || name.starts_with(kMeshPrefix);
}

std::vector<SceneFile> ExportHandScene(const kinematics::HandFile& file,
                                       const object::Polyhedron& solid, double scale,
                                       const HandWorldOptions& options,
                                       const std::vector<SceneKey>& keys) {
  return SceneWriter(file, solid, scale, options).Write(keys);
}

}  // namespace regrasp::sim
