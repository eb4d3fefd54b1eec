#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {
namespace {

namespace fs = std::filesystem;

constexpr char kPackage[] = "package://";
constexpr char kFile[] = "file://";

std::string LowerCase(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

bool IsReadByMujoco(const fs::path& path) {
  const std::string ending = LowerCase(path.extension().string());
  return ending == ".stl" || ending == ".obj" || ending == ".msh";
}

/// Remove surrounding white space, which numbers in XML can have.
std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return "";
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

/// Return a number of a joint; `otherwise` if the attribute is missing.
/// @throws InputError  if the attribute is not a finite number. The message names the line, joint
///     and attribute.
double NumberOf(const XmlElement& element, const std::string& joint, const char* attribute,
                double otherwise) {
  const std::string* text = element.Find(attribute);
  if (text == nullptr) return otherwise;
  const std::optional<double> number = ParseDouble(Trimmed(*text));
  if (number) return *number;
  throw InputError(element.file + ": line " + std::to_string(element.line) + ": <" + element.name +
                   "> of joint " + joint + ": " + attribute + ": expected a number, found \"" +
                   *text + "\"");
}

class UrdfConverter {
 public:
  UrdfConverter(const fs::path& folder, ModelText& text)
      : folder_(folder.empty() ? fs::path(".") : folder), text_(text) {}

  void Convert() {
    SetCompiler();
    for (XmlElement& element : text_.root.children) {
      if (element.name == "link") ConvertLink(element);
      if (element.name == "joint") TakeJoint(element);
      if (element.name == "loop_joint") {
        throw InputError(element.file + ": line " + std::to_string(element.line) +
                         ": <loop_joint>: closed loops are not supported, expected fingers that "
                         "are open chains of joints");
      }
    }
  }

 private:
  void Record(const XmlElement& element, const XmlElement& of, const std::string& attribute,
              const std::string& outcome) {
    const std::string* name = of.Find("name");
    text_.conversions.push_back({element.file, element.line, element.name,
                                 name != nullptr ? *name : "", attribute, outcome});
  }

  void SetCompiler();
  void ConvertLink(XmlElement& link);
  bool ConvertShape(const XmlElement& link, XmlElement& shape);
  void TakeJoint(const XmlElement& joint);
  void TakeMimic(const XmlElement& mimic, const std::string& joint);
  fs::path Locate(const std::string& name) const;
  std::string Alias(const fs::path& path, const std::string& scale);

  fs::path folder_;
  ModelText& text_;
  std::map<std::pair<std::string, std::string>, std::string> aliases_;  ///< alias by path and scale
  std::map<std::string, int> stems_;  ///< number of uses of each file stem
};

void UrdfConverter::SetCompiler() {
  auto& children = text_.root.children;
  const auto child = [](std::vector<XmlElement>& elements, const char* name) -> XmlElement& {
    const auto found = std::ranges::find(elements, name, &XmlElement::name);
    if (found != elements.end()) return *found;
    return *elements.insert(elements.begin(), XmlElement{name, {}, {}, "", 0});
  };
  XmlElement& compiler = child(child(children, "mujoco").children, "compiler");
  compiler.file = text_.root.file;
  if (compiler.line == 0) compiler.line = text_.root.line;
  constexpr std::pair<const char*, const char*> kSettings[] = {{"strippath", "false"},
                                                               {"balanceinertia", "true"},
                                                               {"fusestatic", "false"},
                                                               {"discardvisual", "false"}};
  for (const auto& [attribute, value] : kSettings) {
    if (compiler.Find(attribute) != nullptr) continue;
    compiler.Set(attribute, value);
    Record(compiler, compiler, attribute, std::string("added as ") + value);
  }
}

void UrdfConverter::ConvertLink(XmlElement& link) {
  std::vector<XmlElement> kept;
  for (XmlElement& shape : link.children) {
    const bool is_shape = shape.name == "visual" || shape.name == "collision";
    if (!is_shape || ConvertShape(link, shape)) kept.push_back(std::move(shape));
  }
  link.children = std::move(kept);
}

/// Convert the mesh paths of a shape.
/// @returns false if MuJoCo cannot read its mesh; the shape is then left out.
bool UrdfConverter::ConvertShape(const XmlElement& link, XmlElement& shape) {
  for (XmlElement& geometry : shape.children) {
    for (XmlElement& mesh : geometry.children) {
      const std::string* name = mesh.Find("filename");
      if (mesh.name != "mesh" || name == nullptr) continue;
      const fs::path path = Locate(*name);
      const std::string problem =
          IsReadByMujoco(path) ? WhyMeshIsMissing(path) : "MuJoCo reads STL, OBJ and MSH";
      if (!problem.empty()) {
        if (shape.name == "collision") {
          throw InputError(mesh.file + ": line " + std::to_string(mesh.line) + ": mesh " + *name +
                           ": " + problem);
        }
        Record(mesh, link, "filename", "left out, visual only: " + problem);
        return false;
      }
      const std::string* scale = mesh.Find("scale");
      mesh.Set("filename", Alias(path, scale != nullptr ? *scale : ""));
    }
  }
  return true;
}

/// Return the path of a mesh file, relative to the model or to a package. A package is the model's
/// folder, a folder above it or a folder next to one of these.
fs::path UrdfConverter::Locate(const std::string& name) const {
  if (name.starts_with(kFile)) return name.substr(sizeof kFile - 1);
  if (!name.starts_with(kPackage)) return folder_ / name;
  const fs::path in_packages = name.substr(sizeof kPackage - 1);
  if (in_packages.empty()) return folder_;
  const fs::path package = *in_packages.begin();
  const fs::path in_package = in_packages.lexically_relative(package);
  const fs::path start = fs::absolute(folder_).lexically_normal();
  for (fs::path above = start;; above = above.parent_path()) {
    for (const fs::path& candidate : {above / in_package, above / in_packages}) {
      if (fs::exists(candidate)) return candidate;
    }
    if (above == above.root_path()) break;
  }
  return folder_ / in_package;
}

std::string UrdfConverter::Alias(const fs::path& path, const std::string& scale) {
  std::string& alias = aliases_[{path.lexically_normal().string(), scale}];
  if (!alias.empty()) return alias;
  const std::string stem = path.stem().string();
  const int used = ++stems_[stem];
  alias = stem + (used == 1 ? "" : "__" + std::to_string(used)) + path.extension().string();
  text_.meshes.push_back({path, alias});
  return alias;
}

void UrdfConverter::TakeJoint(const XmlElement& joint) {
  const std::string* name = joint.Find("name");
  const std::string* type = joint.Find("type");
  if (name == nullptr || (type != nullptr && *type == "fixed")) return;
  if (const XmlElement* limit = joint.Child("limit")) {
    const double effort = NumberOf(*limit, *name, "effort", 0);
    if (effort < 0) {
      throw InputError(limit->file + ": line " + std::to_string(limit->line) +
                       ": <limit> of joint " + *name +
                       ": effort: expected a number of at least 0, found " + FormatShort(effort));
    }
    if (effort > 0) text_.efforts[*name] = effort;
  }
  if (const XmlElement* mimic = joint.Child("mimic")) TakeMimic(*mimic, *name);
}

void UrdfConverter::TakeMimic(const XmlElement& mimic, const std::string& joint) {
  const std::string* follows = mimic.Find("joint");
  if (follows == nullptr) {
    throw InputError(mimic.file + ": line " + std::to_string(mimic.line) + ": <mimic> of joint " +
                     joint + ": expected the attribute joint");
  }
  text_.mimics.push_back({joint, std::string(Trimmed(*follows)),
                          NumberOf(mimic, joint, "multiplier", 1),
                          NumberOf(mimic, joint, "offset", 0)});
}

}  // namespace

void ConvertUrdf(const fs::path& folder, ModelText& text) { UrdfConverter(folder, text).Convert(); }

void DiscardVisuals(const std::string& why, ModelText& text) {
  for (XmlElement& link : text.root.children) {
    if (link.name == "link") {
      std::erase_if(link.children, [](const XmlElement& e) { return e.name == "visual"; });
    }
  }
  text.conversions.push_back(
      {text.root.file, text.root.line, "visual", "", "", "left out, all visuals: " + why});
}

}  // namespace regrasp::kinematics
