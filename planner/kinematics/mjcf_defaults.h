#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// Default classes of an MJCF model, which define attributes that elements omit.
class MjcfDefaults {
 public:
  /// Name of the root class.
  static constexpr char kMain[] = "main";

  /// @param root  root element; outlives this object and does not move its elements.
  explicit MjcfDefaults(const XmlElement& root);

  /// Return the class of an element: its own, otherwise `otherwise`.
  [[nodiscard]] static std::string ClassOf(const XmlElement& element, const std::string& otherwise);

  /// Return an attribute of an element; nullptr if there is none.
  /// If the element omits it, its class and the ancestors of the class are searched.
  /// @param tags  element names of the classes that can have the attribute.
  [[nodiscard]] const std::string* Find(const XmlElement& element, const std::string& default_class,
                                        const std::vector<const char*>& tags,
                                        const std::string& attribute) const;

 private:
  struct DefaultClass {
    std::string parent;
    std::vector<const XmlElement*> elements;
  };
  void Add(const XmlElement& element, const std::string& parent);

  std::map<std::string, DefaultClass> classes_;
};

}  // namespace regrasp::kinematics
