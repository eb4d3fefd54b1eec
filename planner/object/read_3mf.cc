#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/zip_archive.h"
#include "planner/object/read_object.h"
#include "planner/object/text_scanner.h"
#include "planner/object/weld.h"

namespace regrasp::object {

namespace {

constexpr const char* kRelationships = "_rels/.rels";
constexpr std::string_view kModelType =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

/// Decode the percent-encoded characters of a URI, such as "%20".
std::string PercentDecoded(std::string_view text) {
  std::string decoded;
  while (!text.empty()) {
    unsigned char code = 0;
    const char* digits = text.data() + 1;
    const bool escaped = text.size() >= 3 && text[0] == '%' &&
                         std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
    decoded += escaped ? static_cast<char>(code) : text[0];
    text.remove_prefix(escaped ? 3 : 1);
  }
  return decoded;
}

/// Parts of a 3MF package, by their names in the Open Packaging Conventions.
class Package3mf {
 public:
  /// @param bytes  bytes of the package; must outlive this object.
  /// @throws InputError  if they are not a ZIP archive.
  explicit Package3mf(std::string_view bytes) : archive_(bytes) {}

  /// Find the root model part: the target of the one relationship of that type in `_rels/.rels`.
  /// @returns its normalised name.
  /// @throws InputError  if `_rels/.rels` is missing or has none or several such relationships.
  [[nodiscard]] std::string RootModel();

  /// Read a part.
  /// @param part  name as PartName returns it.
  /// @throws InputError  if there is no such part or several parts of this name.
  [[nodiscard]] std::string Read(const std::string& part);

  /// Normalise the name of a part: without the first slash, "." and "..".
  [[nodiscard]] static std::string PartName(std::string_view target);

 private:
  ZipArchive archive_;
};

std::string Package3mf::PartName(std::string_view target) {
  const std::string absolute = "/" + std::string(target);
  return std::filesystem::path(absolute).lexically_normal().relative_path().string();
}

std::string Package3mf::RootModel() {
  const std::string text = Read(kRelationships);
  std::optional<std::string> root;
  ScanXml(text, kRelationships, [&](const XmlTag& tag) {
    if (tag.name() != "Relationship" || tag.Find("Type") != kModelType) return;
    if (tag.Find("TargetMode") == "External") {
      throw InputError("model in another file, \"" + tag.Text("Target") + "\": not supported");
    }
    if (root) throw InputError("expected one relationship to a model, found several");
    root = PartName(tag.Text("Target"));
  });
  if (!root) throw InputError(std::string(kRelationships) + ": relationship to a model not found");
  return *root;
}

std::string Package3mf::Read(const std::string& part) {
  // Part names are not case-sensitive.
  for (const std::string& name : {part, PercentDecoded(part)}) {
    const auto is_it = [&](const std::string& entry) {
      return LowerCase(PartName(entry)) == LowerCase(name);
    };
    const std::vector<std::string> entries = archive_.names();
    const auto found = std::ranges::find_if(entries, is_it);
    if (found == entries.end()) continue;
    if (std::ranges::count_if(entries, is_it) > 1) {
      throw InputError(part + ": must be once in the archive, found twice or more");
    }
    if (auto text = archive_.Read(*found, kMaxInputBytes)) return *std::move(text);
  }
  throw InputError(part + ": not found in the archive");
}

using Eigen::Affine3d;

constexpr std::string_view kCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr std::string_view kProduction =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
constexpr std::string_view kMaterials =
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";

/// Name of an object in a part of the package.
struct ObjectName {
  std::string part, id;
  auto operator<=>(const ObjectName&) const = default;
};

struct Placed {
  ObjectName object;
  Affine3d transform = Affine3d::Identity();
};

struct Object3mf {
  std::string type = "model";
  bool has_mesh = false;
  PolygonSoup mesh;
  std::vector<Placed> components;
};

/// Contents of a model part.
struct Model {
  std::string part;
  std::string unit = "millimeter";
  std::map<std::string, Object3mf> objects;
  std::vector<Placed> items;
  Object3mf* current = nullptr;
  std::string current_id;
};

int VertexOf(const XmlTag& tag, std::string_view attribute, const PolygonSoup& mesh) {
  const std::string text = tag.Text(attribute);
  const auto index = ParseInteger(text);
  if (index && *index >= 0 && *index < std::ssize(mesh.vertices)) return int(*index);
  throw InputError(
      "triangle: " + std::string(attribute) + ": expected an integer of at least 0 and less than " +
      std::to_string(mesh.vertices.size()) + ", the number of vertices, found " + Quoted(text));
}

/// Read twelve numbers: the rows of a matrix by which a point, as a row vector, is multiplied.
Affine3d TransformOf(const XmlTag& tag) {
  Affine3d transform = Affine3d::Identity();
  const auto text = tag.Find("transform");
  if (!text) return transform;
  TextScanner scanner(*text, std::string(tag.name()));
  for (int k = 0; k < 12; ++k) transform(k % 3, k / 3) = scanner.ReadDouble("transform");
  if (scanner.Next())
    throw InputError(std::string(tag.name()) + ": transform: expected 12 numbers");
  return transform;
}

/// Return the object of an item or component, in this part or in the one given by `p:path`.
Placed PlacedBy(const XmlTag& tag, const Model& model) {
  const auto path = tag.Find("path", kProduction);
  return {{path ? Package3mf::PartName(*path) : model.part, tag.Text("objectid")},
          TransformOf(tag)};
}

/// Read the attributes of a model. All other required extensions are rejected, because they change
/// the meaning of the core elements.
void TakeModel(const XmlTag& tag, Model& model) {
  if (auto unit = tag.Find("unit")) model.unit = *std::move(unit);
  std::istringstream required(tag.Find("requiredextensions").value_or(""));
  for (std::string prefix; required >> prefix;) {
    const auto found = tag.prefixes().find(prefix);
    const std::string space = found == tag.prefixes().end() ? "" : found->second;
    if (space != kProduction && space != kMaterials) {
      throw InputError("required extension " + Quoted(prefix) + ": not supported, found " +
                       (space.empty() ? "no namespace" : "namespace \"" + space + "\""));
    }
  }
}

void TakeObject(const XmlTag& tag, Model& model) {
  model.current_id = tag.Text("id");
  const auto [place, is_new] = model.objects.try_emplace(model.current_id);
  if (!is_new) throw InputError("object " + Quoted(model.current_id) + ": the id must be unique");
  model.current = &place->second;
  if (auto type = tag.Find("type")) model.current->type = *std::move(type);
}

void TakeItem(const XmlTag& tag, Model& model) {
  if (tag.Find("printable") == "0") {
    throw InputError("item: printable: not supported, expected \"1\", found \"0\"");
  }
  model.items.push_back(PlacedBy(tag, model));
}

/// Elements by which extensions replace the mesh of an object or add to it.
constexpr auto kOtherShapes = std::to_array<std::string_view>(
    {"beamlattice", "booleanshape", "displacementmesh", "levelset", "implicitfunction"});

void TakeElement(const XmlTag& tag, Model& model) {
  if (tag.space() != kCore) {
    if (model.current != nullptr &&
        std::ranges::find(kOtherShapes, tag.name()) != kOtherShapes.end()) {
      throw InputError("object " + Quoted(model.current_id) + ": " + Quoted(tag.name()) +
                       ": not supported, expected a mesh or components");
    }
    return;
  }
  if (tag.name() == "model") return TakeModel(tag, model);
  if (tag.name() == "object") return TakeObject(tag, model);
  if (tag.name() == "item") return TakeItem(tag, model);
  if (model.current == nullptr) return;
  PolygonSoup& mesh = model.current->mesh;
  if (tag.name() == "mesh") {
    model.current->has_mesh = true;
  } else if (tag.name() == "vertex") {
    mesh.vertices.emplace_back(tag.Number("x"), tag.Number("y"), tag.Number("z"));
  } else if (tag.name() == "triangle") {
    const std::array<int, 3> corners = {VertexOf(tag, "v1", mesh), VertexOf(tag, "v2", mesh),
                                        VertexOf(tag, "v3", mesh)};
    mesh.facets.emplace_back(corners.begin(), corners.end());
  } else if (tag.name() == "component") {
    model.current->components.push_back(PlacedBy(tag, model));
  }
}

Model ParseModel(const std::string& text, const std::string& part) {
  Model model;
  model.part = part;
  bool is_model = false;
  ScanXml(text, part, [&](const XmlTag& tag) {
    is_model = is_model || (tag.space() == kCore && tag.name() == "model");
    if (!is_model) {
      throw InputError("expected the element \"model\" of 3MF, found " + Quoted(tag.name()) +
                       (tag.space().empty() ? " without a namespace" : " of another namespace"));
    }
    TakeElement(tag, model);
  });
  return model;
}

struct Unit3mf {
  double metres;
  const char* name;
};

const Unit3mf& UnitOf3mf(const std::string& unit) {
  static const std::map<std::string, Unit3mf> kUnits = {{"micron", {1e-6, "micrometres"}},
                                                        {"millimeter", {1e-3, "millimetres"}},
                                                        {"centimeter", {0.01, "centimetres"}},
                                                        {"inch", {0.0254, "inches"}},
                                                        {"foot", {0.3048, "feet"}},
                                                        {"meter", {1, "metres"}}};
  const auto found = kUnits.find(unit);
  if (found == kUnits.end()) throw InputError("unit: not supported, found " + Quoted(unit));
  return found->second;
}

/// Maximum depth of nested components, and maximum number of placed objects.
constexpr int kDeepest = 64, kMostPlaced = 100'000;

/// Model parts of a package, each parsed once.
class Models {
 public:
  explicit Models(std::string_view bytes) : package_(bytes), root_(package_.RootModel()) {}

  const Model& root() { return Part(root_); }

  /// Return an object.
  /// @throws InputError  if there is no such object.
  const Object3mf& Find(const ObjectName& name) {
    const Model& model = Part(name.part);
    const auto found = model.objects.find(name.id);
    if (found != model.objects.end()) return found->second;
    throw InputError(name.part + ": object " + Quoted(name.id) + " not found");
  }

 private:
  /// Part names are not case-sensitive.
  const Model& Part(const std::string& part) {
    const auto [place, is_new] = models_.try_emplace(LowerCase(part));
    if (!is_new) return place->second;
    if (models_.size() > kMostParts) throw InputError("too large, limit 10000 parts");
    place->second = ParseModel(package_.Read(part), part);
    if (place->second.unit != root().unit) {
      throw InputError(part + ": unit: expected " + Quoted(root().unit) + " as in " + root_ +
                       ", found " + Quoted(place->second.unit));
    }
    return place->second;
  }

  static constexpr std::size_t kMostParts = 10'000;
  Package3mf package_;
  std::string root_;
  std::map<std::string, Model> models_;
};

[[noreturn]] void RefuseMore(const std::string& what, std::size_t most, const std::string& unit) {
  throw InputError(what + ": too large, limit " + std::to_string(most) + " " + unit);
}

class Placer {
 public:
  explicit Placer(Models& models) : models_(models) {}

  void Place(const Placed& placed, int depth = 0) {
    const Object3mf& object = models_.Find(placed.object);
    if (object.type == "support" || object.type == "solidsupport") return;
    CheckObject(placed.object, object);
    const PolygonSoup& mesh = object.mesh;
    if (depth == kDeepest) RefuseMore("components", kDeepest, "levels; they may be recursive");
    if (++placed_ > kMostPlaced) RefuseMore("components", kMostPlaced, "placed objects");
    if (soup_.facets.size() + mesh.facets.size() > kMaxFacets) {
      RefuseMore("surface", kMaxFacets, "triangles");
    }
    if (soup_.vertices.size() + mesh.vertices.size() > 3 * kMaxFacets) {
      RefuseMore("surface", 3 * kMaxFacets, "vertices");
    }
    Add(mesh, placed.transform);
    for (const Placed& component : object.components) {
      Place({component.object, placed.transform * component.transform}, depth + 1);
    }
  }

  [[nodiscard]] const PolygonSoup& soup() const { return soup_; }

 private:
  static void CheckObject(const ObjectName& name, const Object3mf& object) {
    const std::string what = name.part + ": object " + Quoted(name.id);
    if (object.type != "model") {
      throw InputError(what + ": type: not supported, expected \"model\", found " +
                       Quoted(object.type));
    }
    if (object.has_mesh == !object.components.empty()) {
      throw InputError(what + ": expected a mesh or components, found " +
                       (object.has_mesh ? "both" : "neither"));
    }
  }

  void Add(const PolygonSoup& mesh, const Affine3d& transform) {
    const int first = static_cast<int>(soup_.vertices.size());
    for (const auto& vertex : mesh.vertices) soup_.vertices.push_back(transform * vertex);
    const bool mirrors = transform.linear().determinant() < 0;
    for (std::vector<int> facet : mesh.facets) {
      for (int& v : facet) v += first;
      if (mirrors) std::ranges::reverse(facet);
      soup_.facets.push_back(std::move(facet));
    }
  }

  Models& models_;
  PolygonSoup soup_;
  int placed_ = 0;
};

}  // namespace

PolygonSoup Read3mf(std::string_view bytes) {
  Models models(bytes);
  const Model& root = models.root();
  const Unit3mf& unit = UnitOf3mf(root.unit);
  const Affine3d metres(Eigen::Scaling(unit.metres));
  Placer placer(models);
  for (const Placed& item : root.items) placer.Place({item.object, metres * item.transform});
  PolygonSoup soup = placer.soup();
  if (soup.facets.empty())
    throw InputError(root.part + ": build: object of type \"model\" not found");
  soup.unit = unit.name;
  return soup;
}

}  // namespace regrasp::object
