#include "sim/actuation/hand_scene_export.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/kinematics/model_names.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/actuation/hand_scene_text.h"
#include "sim/actuation/model_numbers.h"
#include "sim/actuation/tip_contact.h"

namespace regrasp::sim {
namespace {

using kinematics::XmlElement;

constexpr const char* kMeshPrefix = "mesh_";
constexpr const char* kTipPrefix = "regrasp_tip_";

XmlElement ExportElement(std::string name,
                         std::vector<std::pair<std::string, std::string>> attributes) {
  XmlElement element;
  element.name = std::move(name);
  element.attributes = std::move(attributes);
  return element;
}

void ForEach(XmlElement& element, const std::function<void(XmlElement&)>& visit) {
  visit(element);
  for (XmlElement& child : element.children) ForEach(child, visit);
}

/// The section of that name; made where there is none.
XmlElement& Section(XmlElement& root, const std::string& name) {
  const auto found = std::ranges::find(root.children, name, &XmlElement::name);
  return found != root.children.end() ? *found
                                      : root.children.emplace_back(ExportElement(name, {}));
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
                                 HandSceneText(file, solid, scale, options.mass_kg))) {}

  std::vector<SceneFile> Write(const std::vector<SceneKey>& keys) {
    XmlElement& root = text_.root;
    // What versions of MuJoCo call differently, or do without.
    std::erase_if(root.children, [](const XmlElement& child) {
      return child.name == "size" || child.name == "statistic" || child.name == "custom";
    });
    std::vector<SceneFile> files = TakeMeshes();
    SetOptions(Section(root, "option"));
    WriteModelNumbers(world_.model(), root);
    SetBodies();
    SetContacts(Section(root, "contact"));
    XmlElement& frames = Section(root, "keyframe");
    for (const SceneKey& key : keys) {
      frames.children.push_back(ExportElement("key", {{"name", key.name},
                                                      {"time", FormatDouble(key.time_s)},
                                                      {"qpos", NumbersText(key.qpos)},
                                                      {"ctrl", NumbersText(key.controls)}}));
    }
    files.push_back({kSceneName, kinematics::FormatXml(root)});
    return files;
  }

 private:
  /// The files of meshes come along under names of their own; textures do not.
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
      files.push_back({name, ReadFile(path)});
      // A mesh is called after its file where it has no name.
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

  /// The options that the replay does not leave at their defaults (SetReplayOptions).
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
    Section(text_.root, "asset").children.push_back(ObjectMesh());
    ForEach(text_.root, [&](XmlElement& element) {
      const std::string* name = element.Find("name");
      if (element.name == "geom") {
        if (name != nullptr && *name == kHandSceneObject) {
          element.attributes = {{"name", *name}, {"type", "mesh"}, {"mesh", kHandSceneObject}};
        }
        // Only tips touch anything, and only the object: SetContacts.
        element.Set("contype", "0");
        element.Set("conaffinity", "0");
      } else if (element.name == "body" && name != nullptr) {
        if (*name == kHandSceneObject) element.children.push_back(OriginSite());
        AddTip(*name, element);
      }
    });
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
          ExportElement("geom", {{"name", tips_.back()},
                                 {"type", "sphere"},
                                 {"size", FormatDouble(tips[i].radius)},
                                 {"pos", NumbersText(tips[i].centre.data(), 3)},
                                 {"mass", "0"},
                                 {"rgba", "0.9 0.5 0.1 0.5"},
                                 {"contype", "0"},
                                 {"conaffinity", "0"}}));
    }
  }

  /// The origin of the object's file, in the frame of the object's body, which is at its centroid.
  [[nodiscard]] XmlElement OriginSite() const {
    const Eigen::Vector3d origin = -scale_ * solid_.mass_properties().centroid;
    return ExportElement("site", {{"name", kSceneOrigin}, {"pos", NumbersText(origin.data(), 3)}});
  }

  /// About the object's centroid, in metres.
  [[nodiscard]] XmlElement ObjectMesh() const {
    std::vector<double> vertices;
    for (const Eigen::Vector3d& vertex : solid_.vertices()) {
      const Eigen::Vector3d at = scale_ * (vertex - solid_.mass_properties().centroid);
      vertices.insert(vertices.end(), at.begin(), at.end());
    }
    std::string faces;
    for (const auto& triangle : solid_.triangles()) {
      for (const int corner : triangle)
        faces += (faces.empty() ? "" : " ") + std::to_string(corner);
    }
    return ExportElement("mesh",
                         // The hand's model may scale all meshes that do not say.
                         {{"name", kHandSceneObject},
                          {"scale", "1 1 1"},
                          {"vertex", NumbersText(vertices)},
                          {"face", faces}});
  }

  /// Geoms of a tip's link that collide.
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

  void SetContacts(XmlElement& section) const {
    std::erase_if(section.children, [](const XmlElement& child) { return child.name == "pair"; });
    const std::string mu = FormatDouble(mu_);
    for (const std::string& tip : tips_) {
      section.children.push_back(ExportElement(
          "pair", {{"geom1", tip},
                   {"geom2", kHandSceneObject},
                   {"condim", "3"},
                   {"friction", mu + " " + mu + " 0.005 0.0001 0.0001"},
                   {"solref", FormatDouble(kTipContactTime) + " 1"},
                   {"solimp", NumbersText(kTipImpedance.data(), kTipImpedance.size())}}));
    }
  }

  const kinematics::HandFile& file_;
  const object::Polyhedron& solid_;
  double scale_;
  double mu_;
  bool own_tips_;
  HandWorld world_;
  kinematics::ModelText text_;
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
