#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/kinematics/model_text.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {
namespace {

namespace fs = std::filesystem;
using Numbers = std::vector<double>;

using Tags = std::vector<const char*>;

/// Defaults of an actuator can be written with the tag of any actuator kind.
const Tags kActuatorTags = {"general", "motor",    "position", "velocity", "intvelocity",
                            "damper",  "cylinder", "muscle",   "adhesion"};
constexpr char kToActuators[] = "to its actuators";

/// Parse the numbers of an attribute; empty if the text is not a list of numbers.
Numbers ParseNumbers(const std::string& text) {
  Numbers numbers;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::optional<double> number = ParseDouble(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::string FormatNumbers(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : " ") + FormatDouble(number);
  return text;
}

struct Outcome {
  const char* element;
  const char* attribute;
  const char* outcome;
};

/// Reported outcome of attributes that are omitted or converted elsewhere.
constexpr Outcome kOutcomes[] = {
    {"position", "kv", kToActuators},
    {"position", "timeconst", kToActuators},
    {"position", "dampratio", kToActuators},
    {"position", "inheritrange", kToActuators},
    {"joint", "actuatorfrcrange", kToActuators},
    {"joint", "actuatorfrclimited", "left out: the force range limits it"},
    {"body", "gravcomp", "left out: gravity acts on the links"},
    {"mesh", "content_type", "left out: implied by the file extension"},
    {"mesh", "maxhullvert", "left out: hulls keep all vertices"},
    {"option", "ls_iterations", "left out: setting of a newer solver"},
    {"option", "ls_tolerance", "left out: setting of a newer solver"},
    {"flag", "eulerdamp", "left out: damping is integrated implicitly"},
};

std::string OutcomeOf(const std::string& element, const std::string& attribute) {
  for (const Outcome& known : kOutcomes) {
    if (element == known.element && attribute == known.attribute) return known.outcome;
  }
  return "left out: not supported";
}

class MjcfConverter {
 public:
  MjcfConverter(const fs::path& folder, ModelText& text) : folder_(folder), text_(text) {}

  void Convert() {
    ConvertSettings();
    ResolveFrames(text_.root);
    const MjcfDefaults defaults(text_.root);
    defaults_ = &defaults;
    for (const XmlElement& section : text_.root.children) {
      if (section.name == "worldbody") AddJoints(section, MjcfDefaults::kMain);
    }
    const bool lacks_autolimits = Setting("compiler", "autolimits").empty() && HasOpenLimits();
    for (XmlElement& section : text_.root.children) {
      if (section.name != "actuator") continue;
      for (XmlElement& actuator : section.children) ConvertActuator(actuator);
    }
    Clean(text_.root, MujocoSchema());
    if (lost_actuators_) DropControls();
    if (lacks_autolimits) AddAutolimits();
    const MeshPaths paths = {folder_ / Setting("compiler", "meshdir"),
                             Setting("compiler", "strippath") == "true"};
    DropMissingVisuals(paths, text_);
    ListMeshes(paths);
  }

 private:
  struct JointFacts {
    const XmlElement* element;
    std::string default_class;
  };

  void Record(const XmlElement& element, const std::string& attribute, const std::string& outcome) {
    std::string name;
    for (const char* named : {"name", "class", "joint"}) {
      const std::string* value = element.Find(named);
      if (name.empty() && value != nullptr) name = *value;
    }
    text_.conversions.push_back(
        {element.file, element.line, element.name, name, attribute, outcome});
  }

  void ConvertSettings();
  bool HasOpenLimits() const;
  void AddAutolimits();
  void Rename(XmlElement& element, const char* from, const std::vector<const char*>& to);
  void ResolveFrames(XmlElement& element);
  void AddJoints(const XmlElement& body, const std::string& inherited_class);
  const std::string* Effective(const XmlElement& element, const std::string& default_class,
                               const Tags& tags, const std::string& attribute) const {
    return defaults_->Find(element, default_class, tags, attribute);
  }
  Numbers EffectiveNumbers(const XmlElement& element, const std::string& default_class,
                           const Tags& tags, const std::string& attribute) const {
    const std::string* found = Effective(element, default_class, tags, attribute);
    return found == nullptr ? Numbers{} : ParseNumbers(*found);
  }
  void ConvertActuator(XmlElement& actuator);
  void InheritRange(XmlElement& actuator, const std::string& default_class,
                    const JointFacts* joint);
  void ConvertServo(XmlElement& actuator, const std::string& default_class);
  void LimitForce(XmlElement& actuator, const std::string& default_class, const JointFacts& joint);
  void Clean(XmlElement& element, const SchemaElement& schema);
  void DropControls();
  void ListMeshes(const MeshPaths& paths);
  /// Return a setting. As in MuJoCo, the last one in the file counts.
  std::string Setting(const std::string& section, const std::string& attribute) const {
    std::string value;
    for (const XmlElement& element : text_.root.children) {
      const std::string* found = element.name == section ? element.Find(attribute) : nullptr;
      if (found != nullptr) value = *found;
    }
    return value;
  }

  fs::path folder_;
  ModelText& text_;
  const MjcfDefaults* defaults_ = nullptr;  ///< valid until the text changes
  std::vector<JointFacts> joints_;
  std::set<const XmlElement*> limited_joints_;  ///< joints with force range moved to actuators
  int actuators_ = 0;                           ///< number of actuators so far that the schema has
  bool lost_actuators_ = false;
};

void MjcfConverter::Rename(XmlElement& element, const char* from,
                           const std::vector<const char*>& to) {
  const std::string* found = element.Find(from);
  if (found == nullptr) return;
  const std::string value = *found;
  element.Remove(from);
  std::string names;
  for (const char* name : to) {
    if (element.Find(name) == nullptr) element.Set(name, value);
    names += (names.empty() ? "" : " and ") + std::string(name);
  }
  Record(element, from, "to " + names);
}

/// Return whether a joint, tendon or actuator has a range without the attribute that makes it a
/// limit.
/// MuJoCo 2.2.2 rejects such ranges; newer versions make them limits.
bool MjcfConverter::HasOpenLimits() const {
  const auto is_open = [&](const XmlElement& element, const std::string& default_class,
                           const Tags& tags, const char* range, const char* limited) {
    return Effective(element, default_class, tags, range) != nullptr &&
           Effective(element, default_class, tags, limited) == nullptr;
  };
  for (const auto& [joint, default_class] : joints_) {
    if (is_open(*joint, default_class, {"joint"}, "range", "limited")) return true;
  }
  for (const XmlElement& section : text_.root.children) {
    for (const XmlElement& element : section.children) {
      const std::string* own_class = element.Find("class");
      const std::string default_class = own_class != nullptr ? *own_class : MjcfDefaults::kMain;
      if (section.name == "tendon" &&
          is_open(element, default_class, {"tendon"}, "range", "limited")) {
        return true;
      }
      if (section.name == "actuator" &&
          (is_open(element, default_class, kActuatorTags, "ctrlrange", "ctrllimited") ||
           is_open(element, default_class, kActuatorTags, "forcerange", "forcelimited"))) {
        return true;
      }
    }
  }
  return false;
}

void MjcfConverter::AddAutolimits() {
  XmlElement compiler{"compiler", {{"autolimits", "true"}}, {}, text_.root.file, text_.root.line};
  Record(compiler, "autolimits", "added, because newer versions default to true");
  text_.root.children.insert(text_.root.children.begin(), std::move(compiler));
}

void MjcfConverter::ConvertSettings() {
  for (XmlElement& section : text_.root.children) {
    if (section.name == "compiler") Rename(section, "assetdir", {"meshdir", "texturedir"});
    if (section.name != "option") continue;
    Rename(section, "ccd_iterations", {"mpr_iterations"});
    Rename(section, "ccd_tolerance", {"mpr_tolerance"});
    const std::string* integrator = section.Find("integrator");
    if (integrator != nullptr && *integrator == "implicitfast") {
      Record(section, "integrator", "implicitfast to implicit");
      section.Set("integrator", "implicit");
    }
  }
}

/// Convert a frame to an unnamed body without joints. Its name would otherwise become the name of a
/// body.
void MjcfConverter::ResolveFrames(XmlElement& element) {
  for (XmlElement& child : element.children) {
    if (child.name == "frame") {
      Record(child, "", "to a body without joints");
      child.name = "body";
      child.Remove("name");
    }
    ResolveFrames(child);
  }
}

void MjcfConverter::AddJoints(const XmlElement& body, const std::string& inherited_class) {
  const std::string* childclass = body.Find("childclass");
  const std::string default_class = childclass != nullptr ? *childclass : inherited_class;
  for (const XmlElement& child : body.children) {
    if (child.name == "body") AddJoints(child, default_class);
    if (child.name != "joint") continue;
    const std::string* own_class = child.Find("class");
    joints_.push_back({&child, own_class != nullptr ? *own_class : default_class});
  }
}

void MjcfConverter::ConvertActuator(XmlElement& actuator) {
  const SchemaElement* section = MujocoSchema().Child("mujoco", "actuator");
  if (section->Child("actuator", actuator.name) == nullptr) return;
  const std::string* own_class = actuator.Find("class");
  const std::string default_class = own_class != nullptr ? *own_class : MjcfDefaults::kMain;
  const std::string tag = actuator.name;
  const std::string* dyntype = actuator.Find("dyntype");
  if (dyntype != nullptr && *dyntype == "filterexact") {
    Record(actuator, "dyntype", "filterexact to filter");
    actuator.Set("dyntype", "filter");
  }
  const JointFacts* joint = nullptr;
  for (const char* transmission : {"joint", "jointinparent"}) {
    const std::string* moved = actuator.Find(transmission);
    for (const JointFacts& facts : joints_) {
      const std::string* name = facts.element->Find("name");
      if (moved != nullptr && name != nullptr && *name == *moved) joint = &facts;
    }
  }
  if (joint != nullptr) LimitForce(actuator, default_class, *joint);
  if (tag == "position") {
    InheritRange(actuator, default_class, joint);
    ConvertServo(actuator, default_class);
  }
  ++actuators_;
}

void MjcfConverter::InheritRange(XmlElement& actuator, const std::string& default_class,
                                 const JointFacts* joint) {
  const Numbers wide = EffectiveNumbers(actuator, default_class, {"position"}, "inheritrange");
  if (wide.size() != 1 || !(wide[0] > 0)) return;
  const Numbers range = joint == nullptr ? Numbers{}
                                         : EffectiveNumbers(*joint->element, joint->default_class,
                                                            {"joint"}, "range");
  if (range.size() != 2 || actuator.Find("ctrlrange") != nullptr) {
    Record(actuator, "inheritrange", "left out: the actuator has no joint range to inherit");
    return;
  }
  const std::string* type = Effective(*joint->element, joint->default_class, {"joint"}, "type");
  // Controls are in radians, whatever the unit of angles in the file.
  const bool degrees = Setting("compiler", "angle") != "radian" && (!type || *type == "hinge");
  const double unit = degrees ? std::numbers::pi / 180 : 1;
  const double middle = unit * (range[0] + range[1]) / 2;
  const double half = unit * wide[0] * (range[1] - range[0]) / 2;
  actuator.Set("ctrlrange", FormatNumbers({middle - half, middle + half}));
  actuator.Set("ctrllimited", "true");
  Record(actuator, "inheritrange", "to ctrlrange, from the joint's range");
}

/// Convert a damped position servo to a general actuator with an affine bias.
void MjcfConverter::ConvertServo(XmlElement& actuator, const std::string& default_class) {
  const auto number = [&](const char* attribute) -> std::optional<double> {
    const Numbers found = EffectiveNumbers(actuator, default_class, {"position"}, attribute);
    return found.size() == 1 ? std::optional(found[0]) : std::nullopt;
  };
  const std::optional<double> damping = number("kv");
  const std::optional<double> ratio = number("dampratio");
  const std::optional<double> time = number("timeconst");
  if (!damping && !ratio && !time) return;
  const double stiffness = number("kp").value_or(1);
  if (damping) Record(actuator, "kv", "to biasprm of a general actuator");
  if (ratio) {
    Record(actuator, "dampratio", "to biasprm: damping from the inertia of the joint");
    text_.damping_ratios.push_back({actuators_, *ratio});
  }
  if (time) Record(actuator, "timeconst", "to dynprm of a filter");
  actuator.name = "general";
  for (const char* attribute : {"kp", "kv", "dampratio", "timeconst", "inheritrange"}) {
    actuator.Remove(attribute);
  }
  actuator.Set("gaintype", "fixed");
  actuator.Set("biastype", "affine");
  actuator.Set("gainprm", FormatNumbers({stiffness}));
  actuator.Set("biasprm", FormatNumbers({0, -stiffness, -damping.value_or(0)}));
  if (time && *time > 0) {
    actuator.Set("dyntype", "filter");
    actuator.Set("dynprm", FormatNumbers({*time}));
  }
}

/// Limit an actuator to the force range of its joint, divided by its gear.
void MjcfConverter::LimitForce(XmlElement& actuator, const std::string& default_class,
                               const JointFacts& joint) {
  Numbers range =
      EffectiveNumbers(*joint.element, joint.default_class, {"joint"}, "actuatorfrcrange");
  if (range.size() != 2) return;
  const Numbers gears = EffectiveNumbers(actuator, default_class, kActuatorTags, "gear");
  const double gear = gears.empty() ? 1 : gears[0];
  if (gear == 0) return;
  for (double& force : range) force /= gear;
  std::ranges::sort(range);
  const Numbers own = EffectiveNumbers(actuator, default_class, kActuatorTags, "forcerange");
  if (own.size() == 2) {
    range = {std::max(range[0], own[0]), std::min(range[1], own[1])};
    if (!(range[0] < range[1])) return;
  }
  actuator.Set("forcerange", FormatNumbers(range));
  actuator.Set("forcelimited", "true");
  Record(*joint.element, "actuatorfrcrange", "to forcerange of its actuators");
  limited_joints_.insert(joint.element);
}

void MjcfConverter::Clean(XmlElement& element, const SchemaElement& schema) {
  const bool is_body = element.name == "body" || element.name == "worldbody";
  for (std::size_t i = 0; i < element.attributes.size();) {
    const std::string attribute = element.attributes[i].first;
    if (schema.attributes.contains(attribute)) {
      ++i;
      continue;
    }
    const std::string outcome = OutcomeOf(element.name, attribute);
    // Outcomes in actuators are recorded when the actuators are converted.
    if (outcome != kToActuators) {
      Record(element, attribute, outcome);
    } else if (element.name == "joint" && element.Find("name") &&
               !limited_joints_.contains(&element)) {
      Record(element, attribute, "left out: the joint has no actuator to limit");
    }
    element.Remove(attribute);
  }
  std::vector<XmlElement> children;
  for (XmlElement& child : element.children) {
    const SchemaElement* known = schema.Child(element.name, child.name);
    // Older versions know only the name of constraints between sites.
    const bool of_sites = element.name == "equality" && child.Find("site1") != nullptr;
    if (known == nullptr && is_body && child.name != "plugin") {
      throw InputError(
          child.file + ": line " + std::to_string(child.line) + ": <" + child.name +
          "> is not supported by MuJoCo " + mj_versionString() +
          " and is part of the hand; help: expand it (mj_saveLastXML of a newer version "
          "writes the expanded model)");
    }
    if (element.name == "equality" && (known == nullptr || of_sites)) {
      throw InputError(child.file + ": line " + std::to_string(child.line) + ": <" + child.name +
                       (of_sites ? "> between sites" : ">") + " is not supported by MuJoCo " +
                       mj_versionString() + ", and joints would be unconstrained without it");
    }
    if (known == nullptr) {
      Record(child, "", "left out: not supported");
      if (element.name == "actuator") lost_actuators_ = true;
      continue;
    }
    Clean(child, *known);
    children.push_back(std::move(child));
  }
  element.children = std::move(children);
}

/// Remove the controls of keyframes, whose number must be the number of actuators.
void MjcfConverter::DropControls() {
  for (XmlElement& section : text_.root.children) {
    if (section.name != "keyframe") continue;
    for (XmlElement& key : section.children) {
      for (const char* attribute : {"ctrl", "act"}) {
        if (key.Find(attribute) == nullptr) continue;
        Record(key, attribute, "left out: the conversion omits actuators");
        key.Remove(attribute);
      }
    }
  }
}

void MjcfConverter::ListMeshes(const MeshPaths& paths) {
  for (const XmlElement& section : text_.root.children) {
    if (section.name != "asset") continue;
    for (const XmlElement& asset : section.children) {
      const std::string* file = asset.Find("file");
      if (asset.name != "mesh" || file == nullptr) continue;
      const fs::path path = paths.PathOf(*file);
      if (std::ranges::find(text_.meshes, path, &MeshFile::path) == text_.meshes.end()) {
        text_.meshes.push_back({path, ""});
      }
    }
  }
}

}  // namespace

void ConvertMjcf(const fs::path& folder, ModelText& text) { MjcfConverter(folder, text).Convert(); }

void SetDampings(const std::vector<double>& dampings, ModelText& text) {
  int actuator = 0;
  std::size_t next = 0;
  for (XmlElement& section : text.root.children) {
    if (section.name != "actuator") continue;
    for (XmlElement& element : section.children) {
      if (next < text.damping_ratios.size() && text.damping_ratios[next].actuator == actuator) {
        const double stiffness = ParseNumbers(*element.Find("gainprm")).at(0);
        element.Set("biasprm", FormatNumbers({0, -stiffness, -dampings.at(next++)}));
      }
      ++actuator;
    }
  }
}

}  // namespace regrasp::kinematics
