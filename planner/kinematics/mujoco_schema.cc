#include "planner/kinematics/mujoco_schema.h"

#include <mujoco/mujoco.h>

#include <sstream>
#include <stdexcept>
#include <vector>

namespace regrasp::kinematics {
namespace {

constexpr std::size_t kIndent = 3;
/// The names of elements begin to the left of this column, attributes not.
constexpr std::size_t kAttributeColumn = 30;

std::string PrintedSchema() {
  std::string text(1 << 18, '\0');
  const int size = mj_printSchema(nullptr, text.data(), static_cast<int>(text.size()), 0, 0);
  if (size <= 0 || static_cast<std::size_t>(size) >= text.size()) {
    throw std::logic_error("MuJoCo does not print its schema");
  }
  text.resize(static_cast<std::size_t>(size));
  return text;
}

/// Lines are "   name (type)    attribute attribute …", deeper elements farther to the right;
/// lines that begin in the column of the attributes go on with those of the element before.
SchemaElement Parse(const std::string& text) {
  SchemaElement root;
  std::vector<SchemaElement*> open;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t start = line.find_first_not_of(' ');
    if (start == std::string::npos) continue;
    std::istringstream words(line);
    if (start < kAttributeColumn) {
      std::string name;
      std::string type;
      words >> name >> type;
      if (name == "(world)body") name = "body";
      open.resize(std::min(open.size(), start / kIndent));
      SchemaElement& element = open.empty() ? root : open.back()->children[name];
      element.recursive = type == "(R)";
      open.push_back(&element);
    }
    if (open.empty()) throw std::logic_error("MuJoCo prints its schema in another way");
    for (std::string attribute; words >> attribute;) open.back()->attributes.insert(attribute);
  }
  return root;
}

}  // namespace

const SchemaElement* SchemaElement::Child(const std::string& parent,
                                          const std::string& child) const {
  // A worldbody is a body in the schema.
  const std::string known = child == "worldbody" ? "body" : child;
  const std::string self = parent == "worldbody" ? "body" : parent;
  if (recursive && known == self) return this;
  const auto found = children.find(known);
  return found == children.end() ? nullptr : &found->second;
}

const SchemaElement& MujocoSchema() {
  static const SchemaElement kSchema = Parse(PrintedSchema());
  return kSchema;
}

}  // namespace regrasp::kinematics
