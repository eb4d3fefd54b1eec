#include "planner/kinematics/mjcf_defaults.h"

#include <set>

namespace regrasp::kinematics {

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

}  // namespace regrasp::kinematics
