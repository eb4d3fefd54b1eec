#include "planner/kinematics/missing_meshes.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/mjcf_defaults.h"

namespace regrasp::kinematics {
namespace {

namespace fs = std::filesystem;

class VisualDropper {
 public:
  VisualDropper(const MeshPaths& paths, ModelText& text)
      : paths_(paths), text_(text), defaults_(text.root) {}

  void Drop() {
    FindMissing();
    if (missing_.empty()) return;
    // Default classes must stay in place because `defaults_` refers to them. Only bodies and assets
    // change.
    for (XmlElement& section : text_.root.children) {
      if (section.name == "worldbody") DropFrom(section, MjcfDefaults::kMain);
      if (section.name != "asset") continue;
      std::erase_if(section.children, [&](const XmlElement& asset) {
        return asset.name == "mesh" && missing_.contains(NameOf(asset));
      });
    }
  }

 private:
  static std::string NameOf(const XmlElement& mesh) {
    if (const std::string* name = mesh.Find("name")) return *name;
    const std::string* file = mesh.Find("file");
    return file == nullptr ? "" : fs::path(*file).stem().string();
  }

  void FindMissing() {
    for (const XmlElement& section : text_.root.children) {
      if (section.name != "asset") continue;
      for (const XmlElement& asset : section.children) {
        const std::string* file = asset.Find("file");
        if (asset.name != "mesh" || file == nullptr) continue;
        std::string why = WhyMeshIsMissing(paths_.PathOf(*file));
        if (!why.empty()) missing_.emplace(NameOf(asset), std::move(why));
      }
    }
  }

  [[nodiscard]] bool IsZero(const XmlElement& geom, const std::string& default_class,
                            const char* attribute) const {
    const std::string* value = defaults_.Find(geom, default_class, {"geom"}, attribute);
    return value != nullptr && ParseDouble(*value) == 0.0;
  }

  void DropFrom(XmlElement& body, const std::string& inherited_class) {
    const std::string* childclass = body.Find("childclass");
    const std::string default_class = childclass != nullptr ? *childclass : inherited_class;
    const bool has_inertia = body.Child("inertial") != nullptr;
    std::erase_if(body.children, [&](const XmlElement& geom) {
      return geom.name == "geom" &&
             IsDropped(geom, MjcfDefaults::ClassOf(geom, default_class), has_inertia);
    });
    for (XmlElement& child : body.children) {
      if (child.name == "body") DropFrom(child, default_class);
    }
  }

  bool IsDropped(const XmlElement& geom, const std::string& default_class, bool has_inertia) {
    const std::string* mesh = defaults_.Find(geom, default_class, {"geom"}, "mesh");
    const auto missing = mesh == nullptr ? missing_.end() : missing_.find(*mesh);
    if (missing == missing_.end()) return false;
    const bool collides =
        !IsZero(geom, default_class, "contype") || !IsZero(geom, default_class, "conaffinity");
    const bool has_mass = !has_inertia && !IsZero(geom, default_class, "mass") &&
                          !IsZero(geom, default_class, "density");
    if (collides || has_mass) {
      throw InputError(geom.file + ": line " + std::to_string(geom.line) + ": mesh " + *mesh +
                       ": " + missing->second);
    }
    text_.conversions.push_back(
        {geom.file, geom.line, "geom", *mesh, "mesh", "left out, a look: " + missing->second});
    return true;
  }

  MeshPaths paths_;
  ModelText& text_;
  MjcfDefaults defaults_;
  std::map<std::string, std::string> missing_;  ///< reason by name of the mesh
};

}  // namespace

std::string WhyMeshIsMissing(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return path.string() + ": no such file";
  if (fs::file_size(path, error) == 0) return path.string() + ": the file is empty";
  return "";
}

void DropMissingVisuals(const MeshPaths& paths, ModelText& text) {
  VisualDropper(paths, text).Drop();
}

}  // namespace regrasp::kinematics
