#include "planner/kinematics/model_text.h"

#include <expat.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/number.h"

namespace regrasp::kinematics {

namespace {

using Attribute = std::pair<std::string, std::string>;

constexpr std::size_t kDeepest = 200;

/// Parser state for the callbacks of expat. Exceptions must not pass through expat because it is a
/// C library.
struct Parsing {
  XML_Parser parser;
  std::string file;
  std::vector<XmlElement> open;  ///< open elements from the root to the innermost
  XmlElement root;
  bool too_deep = false;

  static void Begin(void* data, const char* name, const char** pairs) {
    auto& parsing = *static_cast<Parsing*>(data);
    if (parsing.open.size() == kDeepest) {
      parsing.too_deep = true;
      XML_StopParser(parsing.parser, XML_FALSE);
      return;
    }
    XmlElement element;
    element.name = name;
    element.file = parsing.file;
    element.line = static_cast<int>(XML_GetCurrentLineNumber(parsing.parser));
    for (const char** pair = pairs; *pair != nullptr; pair += 2) {
      element.attributes.emplace_back(pair[0], pair[1]);
    }
    parsing.open.push_back(std::move(element));
  }

  static void End(void* data, const char* /*name*/) {
    auto& parsing = *static_cast<Parsing*>(data);
    if (parsing.open.empty()) return;
    XmlElement element = std::move(parsing.open.back());
    parsing.open.pop_back();
    (parsing.open.empty() ? parsing.root : parsing.open.back().children.emplace_back()) =
        std::move(element);
  }
};

std::string Escaped(const std::string& value) {
  std::string text;
  for (const char c : value) {
    switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '"':
        text += "&quot;";
        break;
      case '\n':
      case '\r':
      case '\t':
        text += "&#" + std::to_string(static_cast<int>(c)) + ";";
        break;
      default:
        text += c;
    }
  }
  return text;
}

void Append(const XmlElement& element, int depth, std::string& text) {
  text += std::string(static_cast<std::size_t>(depth), ' ') + "<" + element.name;
  for (const Attribute& attribute : element.attributes) {
    text += " " + attribute.first + "=\"" + Escaped(attribute.second) + "\"";
  }
  if (element.children.empty()) {
    text += "/>\n";
    return;
  }
  text += ">\n";
  for (const XmlElement& child : element.children) Append(child, depth + 1, text);
  text += std::string(static_cast<std::size_t>(depth), ' ') + "</" + element.name + ">\n";
}

}  // namespace

const std::string* XmlElement::Find(std::string_view attribute) const {
  const auto found = std::ranges::find(attributes, attribute, &Attribute::first);
  return found == attributes.end() ? nullptr : &found->second;
}

void XmlElement::Set(std::string_view attribute, std::string value) {
  const auto found = std::ranges::find(attributes, attribute, &Attribute::first);
  if (found != attributes.end()) {
    found->second = std::move(value);
  } else {
    attributes.emplace_back(attribute, std::move(value));
  }
}

void XmlElement::Remove(std::string_view attribute) {
  std::erase_if(attributes, [&](const Attribute& a) { return a.first == attribute; });
}

const XmlElement* XmlElement::Child(std::string_view child) const {
  const auto found = std::ranges::find(children, child, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

XmlElement MakeElement(std::string name,
                       std::vector<std::pair<std::string, std::string>> attributes,
                       std::vector<XmlElement> children) {
  XmlElement element;
  element.name = std::move(name);
  element.attributes = std::move(attributes);
  element.children = std::move(children);
  return element;
}

XmlElement ParseXml(std::string_view text, const std::string& file) {
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                       XML_ParserFree);
  Parsing parsing{parser.get(), file, {}, {}};
  XML_SetUserData(parser.get(), &parsing);
  XML_SetElementHandler(parser.get(), Parsing::Begin, Parsing::End);
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) ==
      XML_STATUS_ERROR) {
    const XML_Error code = XML_GetErrorCode(parser.get());
    const std::string line =
        file + ": line " + std::to_string(XML_GetCurrentLineNumber(parser.get())) + ": ";
    if (parsing.too_deep) {
      throw InputError(line + "elements nested too deep, expected at most " +
                       std::to_string(kDeepest) + " levels");
    }
    // For a file in another format, the parser's text would only repeat "not well-formed".
    const std::string why =
        code == XML_ERROR_INVALID_TOKEN ? "" : std::string(" (") + XML_ErrorString(code) + ")";
    throw InputError(line + "not valid XML" + why + ", expected an MJCF or URDF model");
  }
  return std::move(parsing.root);
}

std::string FormatXml(const XmlElement& root) {
  std::string text;
  Append(root, 0, text);
  return text;
}

namespace {

namespace fs = std::filesystem;

/// Resolver of `<include>` elements, as in MuJoCo: paths are relative to the model's folder, and
/// each file is included once.
class Includer {
 public:
  Includer(fs::path folder, std::vector<fs::path>& files)
      : folder_(std::move(folder)), files_(files) {}

  void Resolve(XmlElement& element) {
    std::vector<XmlElement> children;
    for (XmlElement& child : element.children) {
      if (child.name != "include") {
        Resolve(child);
        children.push_back(std::move(child));
        continue;
      }
      const std::string* file = child.Find("file");
      if (file == nullptr) {
        throw InputError(child.file + ": line " + std::to_string(child.line) +
                         ": <include>: requires the attribute file");
      }
      XmlElement included = Read(folder_ / *file);
      Resolve(included);
      std::ranges::move(included.children, std::back_inserter(children));
    }
    element.children = std::move(children);
  }

 private:
  XmlElement Read(const fs::path& path) {
    const auto is_same = [&](const fs::path& other) {
      return other.lexically_normal() == path.lexically_normal();
    };
    if (std::ranges::any_of(files_, is_same)) {
      throw InputError(path.string() + ": must be included once, found twice or recursively");
    }
    files_.push_back(path);
    return ParseXml(ReadFile(path), path.string());
  }

  fs::path folder_;
  std::vector<fs::path>& files_;
};

/// Name prefixes of the xacro namespace, with the colon.
using XacroPrefixes = std::set<std::string>;

XacroPrefixes XacroPrefixesOf(const XmlElement& element, XacroPrefixes prefixes) {
  constexpr std::string_view kDeclaration = "xmlns:";
  for (const auto& [attribute, value] : element.attributes) {
    if (!attribute.starts_with(kDeclaration)) continue;
    if (value.ends_with("/xacro") || value.ends_with("/xacro/")) {
      prefixes.insert(attribute.substr(kDeclaration.size()) + ":");
    }
  }
  return prefixes;
}

/// Reject a model with unexpanded macros, which would silently lose fingers and numbers.
/// @throws InputError  if it has any. The message names the first xacro element, or the attribute
///     with an expression.
void RefuseXacro(const XmlElement& element, const XacroPrefixes& above) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(element.file + ": line " + std::to_string(element.line) + ": " + what +
                     ": xacro is not expanded, expected URDF or MJCF; help: xacro " +
                     fs::path(element.file).filename().string() + " > hand.urdf");
  };
  const XacroPrefixes prefixes = XacroPrefixesOf(element, above);
  for (const std::string& prefix : prefixes) {
    if (element.name.starts_with(prefix)) refuse("<" + element.name + ">");
  }
  for (const auto& [attribute, value] : element.attributes) {
    if (value.find("${") == std::string::npos && value.find("$(") == std::string::npos) continue;
    refuse("<" + element.name + "> " + attribute + "=\"" + value + "\"");
  }
  for (const XmlElement& child : element.children) RefuseXacro(child, prefixes);
}

}  // namespace

ModelText ReadModelText(const fs::path& path) {
  ModelText text;
  text.root = ParseXml(ReadFile(path), path.string());
  text.files.push_back(path);
  RefuseXacro(text.root, {"xacro:"});
  if (text.root.name == "mujoco") {
    Includer(path.parent_path(), text.files).Resolve(text.root);
    ConvertMjcf(path.parent_path(), text);
  } else if (text.root.name == "robot") {
    ConvertUrdf(path.parent_path(), text);
  } else {
    throw InputError(path.string() + ": expected a model as MJCF (<mujoco>) or URDF (<robot>), " +
                     "found <" + text.root.name + ">");
  }
  return text;
}

MjcfDefaults::MjcfDefaults(const XmlElement& root) {
  for (const XmlElement& section : root.children) {
    if (section.name == "default") Add(section, "");
  }
}

void MjcfDefaults::Add(const XmlElement& element, const std::string& parent) {
  const std::string name = ClassOf(element, parent.empty() ? kMain : parent);
  DefaultClass& added = classes_[name];
  added.elements.push_back(&element);
  if (name != parent) added.parent = parent;
  for (const XmlElement& child : element.children) {
    if (child.name == "default") Add(child, name);
  }
}

std::string MjcfDefaults::ClassOf(const XmlElement& element, const std::string& otherwise) {
  const std::string* own = element.Find("class");
  return own != nullptr ? *own : otherwise;
}

const std::string* MjcfDefaults::Find(const XmlElement& element, const std::string& default_class,
                                      const std::vector<const char*>& tags,
                                      const std::string& attribute) const {
  if (const std::string* own = element.Find(attribute)) return own;
  std::set<std::string> seen;  // stops at classes that contain each other
  for (std::string name = default_class; seen.insert(name).second;) {
    const auto found = classes_.find(name);
    if (found == classes_.end()) return nullptr;
    for (const XmlElement* defaults : found->second.elements) {
      for (const char* tag : tags) {
        const XmlElement* tagged = defaults->Child(tag);
        const std::string* value = tagged == nullptr ? nullptr : tagged->Find(attribute);
        if (value != nullptr) return value;
      }
    }
    name = found->second.parent;
  }
  return nullptr;
}

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
        {geom.file, geom.line, "geom", *mesh, "mesh", "left out, visual only: " + missing->second});
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

std::string ReadMeshFile(const std::filesystem::path& path) {
  std::string bytes = ReadFile(path);
  const std::string ending = path.extension().string();
  if (ending != ".obj" && ending != ".OBJ") return bytes;
  std::string joined;
  int objects = 0;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size() - 1) + 1;
    const std::string_view line = std::string_view(bytes).substr(begin, end - begin);
    const bool is_object = line.starts_with("o ") || line.starts_with("g ");
    if (is_object) ++objects;
    if (!is_object) joined += line;
    begin = end;
  }
  return objects > 1 ? joined : bytes;
}

}  // namespace regrasp::kinematics
