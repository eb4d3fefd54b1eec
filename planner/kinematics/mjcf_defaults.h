#pragma once

#include <map>
#include <string>
#include <vector>

#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// The classes of defaults of an MJCF model, which give attributes to elements that have none.
class MjcfDefaults {
 public:
  /// Name of the class that all elements are of.
  static constexpr char kMain[] = "main";

  /// @param root  outlives this object and keeps its elements where they are.
  explicit MjcfDefaults(const XmlElement& root);

  /// Return the class of an element: its own, otherwise the one given.
  [[nodiscard]] static std::string ClassOf(const XmlElement& element, const std::string& otherwise);

  /// Return an attribute of an element, or of its class, or of one above that; nullptr if none has
  /// it.
  /// @param tags  names of the elements of the classes that may have it.
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
