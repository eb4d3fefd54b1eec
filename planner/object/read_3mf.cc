#include "planner/object/read_3mf.h"

#include <expat.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/base/zip_archive.h"
#include "planner/object/size_limits.h"
#include "planner/object/text_scanner.h"

namespace regrasp::object {

namespace {

using Eigen::Affine3d;

constexpr const char* kModel = "3D/3dmodel.model";

/// The text of the package's model. @throws InputError
std::string ReadModel(std::string_view bytes) {
  auto text = ZipArchive(bytes).Read(kModel, kMaxInputBytes);
  if (!text) throw InputError(std::string("the archive has no ") + kModel);
  return std::move(*text);
}

struct Placed {
  std::string object;
  Affine3d transform = Affine3d::Identity();
};

struct Object3mf {
  PolygonSoup mesh;
  std::vector<Placed> components;
};

struct Model {
  std::string unit = "millimeter";
  std::map<std::string, Object3mf> objects;
  std::vector<Placed> items;
  Object3mf* current = nullptr;
};

/// The attributes of an element.
class Attributes {
 public:
  Attributes(std::string element, const char** pairs)
      : element_(std::move(element)), pairs_(pairs) {}

  [[nodiscard]] std::optional<std::string> Find(std::string_view name) const {
    for (const char** pair = pairs_; *pair != nullptr; pair += 2) {
      if (name == pair[0]) return pair[1];
    }
    return std::nullopt;
  }
  [[nodiscard]] std::string Text(std::string_view name) const {
    if (auto text = Find(name)) return *std::move(text);
    throw InputError(element_ + ": lacks " + std::string(name));
  }
  [[nodiscard]] double Double(std::string_view name) const {
    const auto value = ParseDouble(Text(name));
    if (!value) throw InputError(element_ + ": " + std::string(name) + " is not a finite number");
    return *value;
  }
  [[nodiscard]] int Vertex(std::string_view name, const PolygonSoup& mesh) const {
    const auto index = ParseInteger(Text(name));
    if (index && *index >= 0 && *index < std::ssize(mesh.vertices)) return int(*index);
    throw InputError(element_ + ": " + std::string(name) + ": " + Quoted(Text(name)) +
                     " is out of range (" + std::to_string(mesh.vertices.size()) + " vertices)");
  }
  /// Twelve numbers, the rows of a matrix that points are multiplied with from the left.
  [[nodiscard]] Affine3d Transform() const {
    Affine3d transform = Affine3d::Identity();
    const auto text = Find("transform");
    if (!text) return transform;
    TextScanner scanner(*text, element_);
    for (int k = 0; k < 12; ++k) transform(k % 3, k / 3) = scanner.ReadDouble("transform");
    return transform;
  }

 private:
  std::string element_;
  const char** pairs_;
};

void TakeElement(const Attributes& attributes, std::string_view element, Model& model) {
  if (element == "model") {
    if (auto unit = attributes.Find("unit")) model.unit = *std::move(unit);
  } else if (element == "object") {
    model.current = &model.objects[attributes.Text("id")];
  } else if (element == "item") {
    model.items.push_back({attributes.Text("objectid"), attributes.Transform()});
  } else if (model.current == nullptr) {
    return;
  } else if (element == "vertex") {
    model.current->mesh.vertices.emplace_back(attributes.Double("x"), attributes.Double("y"),
                                              attributes.Double("z"));
  } else if (element == "triangle") {
    const PolygonSoup& mesh = model.current->mesh;
    const std::array<int, 3> corners = {attributes.Vertex("v1", mesh),
                                        attributes.Vertex("v2", mesh),
                                        attributes.Vertex("v3", mesh)};
    model.current->mesh.facets.emplace_back(corners.begin(), corners.end());
  } else if (element == "component") {
    model.current->components.push_back({attributes.Text("objectid"), attributes.Transform()});
  }
}

/// What expat, which is C, is handed and hands back: exceptions do not pass through it.
struct Parsing {
  XML_Parser parser;
  Model model;
  std::string failure;

  static void Begin(void* data, const char* name, const char** pairs) {
    auto& parsing = *static_cast<Parsing*>(data);
    if (!parsing.failure.empty()) return;
    const std::string_view qualified = name;
    const std::string_view element = qualified.substr(qualified.find(':') + 1);
    try {
      TakeElement(Attributes(std::string(element), pairs), element, parsing.model);
    } catch (const std::exception& error) {
      parsing.failure = error.what();
      XML_StopParser(parsing.parser, XML_FALSE);
    }
  }
};

Model ParseModel(const std::string& text) {
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                       XML_ParserFree);
  Parsing parsing{parser.get(), {}, {}};
  XML_SetUserData(parser.get(), &parsing);
  XML_SetStartElementHandler(parser.get(), Parsing::Begin);
  if (XML_Parse(parser.get(), text.data(), int(text.size()), XML_TRUE) == XML_STATUS_ERROR) {
    throw InputError(std::string(kModel) + ": line " +
                     std::to_string(XML_GetCurrentLineNumber(parser.get())) + ": " +
                     (parsing.failure.empty() ? XML_ErrorString(XML_GetErrorCode(parser.get()))
                                              : parsing.failure));
  }
  return std::move(parsing.model);
}

struct Unit {
  double metres;
  const char* name;
};

const Unit& UnitOf(const std::string& unit) {
  static const std::map<std::string, Unit> kUnits = {{"micron", {1e-6, "micrometres"}},
                                                     {"millimeter", {1e-3, "millimetres"}},
                                                     {"centimeter", {0.01, "centimetres"}},
                                                     {"inch", {0.0254, "inches"}},
                                                     {"foot", {0.3048, "feet"}},
                                                     {"meter", {1, "metres"}}};
  const auto found = kUnits.find(unit);
  if (found == kUnits.end()) throw InputError("its unit " + Quoted(unit) + " is not one of 3MF");
  return found->second;
}

/// Components of components lie no deeper, and no more objects are placed.
constexpr int kDeepest = 64, kMostPlaced = 100'000;

class Placer {
 public:
  explicit Placer(const Model& model) : model_(model) {}

  void Place(const Placed& placed, int depth = 0) {
    const auto found = model_.objects.find(placed.object);
    if (found == model_.objects.end()) {
      throw InputError("there is no object " + Quoted(placed.object));
    }
    const auto& [mesh, components] = found->second;
    if (depth == kDeepest || ++placed_ > kMostPlaced ||
        soup_.facets.size() + mesh.facets.size() > kMaxFacets ||
        soup_.vertices.size() + mesh.vertices.size() > 3 * kMaxFacets) {
      throw InputError("its components are too many, or contain each other");
    }
    Add(mesh, placed.transform);
    for (const Placed& component : components) {
      Place({component.object, placed.transform * component.transform}, depth + 1);
    }
  }

  [[nodiscard]] const PolygonSoup& soup() const { return soup_; }

 private:
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

  const Model& model_;
  PolygonSoup soup_;
  int placed_ = 0;
};

}  // namespace

PolygonSoup Read3mf(std::string_view bytes) {
  const Model model = ParseModel(ReadModel(bytes));
  const Unit& unit = UnitOf(model.unit);
  const Affine3d metres(Eigen::Scaling(unit.metres));
  Placer placer(model);
  for (const Placed& item : model.items) placer.Place({item.object, metres * item.transform});
  PolygonSoup soup = placer.soup();
  soup.unit = unit.name;
  return soup;
}

}  // namespace regrasp::object
