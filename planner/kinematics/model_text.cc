#include "planner/kinematics/model_text.h"

#include <algorithm>
#include <set>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/kinematics/convert_mjcf.h"
#include "planner/kinematics/convert_urdf.h"

namespace regrasp::kinematics {
namespace {

namespace fs = std::filesystem;

/// Puts what <include> names in its place, as MuJoCo does: relative to the model's folder, each
/// file once.
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
                         ": <include> names no file");
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
      throw InputError(path.string() + ": is included twice, or by itself");
    }
    files_.push_back(path);
    return ParseXml(ReadFile(path), path.string());
  }

  fs::path folder_;
  std::vector<fs::path>& files_;
};

/// Prefixes of names of the xacro namespace, with the colon.
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

/// A model whose macros are not expanded would lose fingers and numbers without a word.
/// @throws InputError  names the first element of xacro, or the attribute with an expression.
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

}  // namespace regrasp::kinematics
