#include "planner/kinematics/inspect_hand.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/base/file.h"
#include "planner/base/number.h"
#include "planner/base/text_table.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/derive_hand.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/kinematics/hand_file.h"
#include "planner/kinematics/mujoco_model.h"

namespace regrasp::kinematics {
namespace {

namespace fs = std::filesystem;

constexpr int kReachSteps = 4;  ///< initial number of steps per independent joint
constexpr double kFinestStep = 1e-3;

/// Format a direction: "+x" for an axis, otherwise numbers.
std::string DirectionText(const Eigen::Vector3d& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      if (direction != sign * Eigen::Vector3d::Unit(axis)) continue;
      return std::string(sign < 0 ? "-" : "+") + "xyz"[axis] + " of the palm";
    }
  }
  return FormatFixed(direction.x(), 3) + " " + FormatFixed(direction.y(), 3) + " " +
         FormatFixed(direction.z(), 3) + " of the palm";
}

std::string Millimetres(double metres) { return FormatFixed(1e3 * metres, 1); }

std::string FingerTable(const InspectedHand& inspected) {
  std::vector<TextRow> rows = {{"finger", "joints", "reach mm", "sphere mm", "centre mm", "body"}};
  for (std::size_t i = 0; i < inspected.hand.fingers.size(); ++i) {
    const Finger& finger = inspected.hand.fingers[i];
    const HandDescription::Tip& tip = inspected.description.tips[i];
    const std::string drives = std::to_string(finger.drives);
    const bool coupled = finger.drives != static_cast<int>(finger.joints.size());
    rows.push_back({finger.name,
                    coupled ? std::to_string(finger.joints.size()) + " by " + drives : drives,
                    Millimetres(LargestReach(finger)), Millimetres(tip.radius),
                    Millimetres(tip.centre.x()) + " " + Millimetres(tip.centre.y()) + " " +
                        Millimetres(tip.centre.z()),
                    tip.body});
  }
  return FormatRows(rows);
}

std::string JointTable(const InspectedHand& inspected) {
  std::vector<TextRow> rows = {{"finger", "joint", "from°", "to°", "N m", "moved by"}};
  for (const Finger& finger : inspected.hand.fingers) {
    for (const Joint& joint : finger.joints) {
      std::string mover = "-";
      std::string force = "-";
      for (const JointActuator& actuator : inspected.actuators) {
        if (actuator.joint != joint.name) continue;
        mover = actuator.actuator;
        force = actuator.largest_torque > 0 ? FormatShort(actuator.largest_torque, 3) : "unknown";
      }
      for (const HandDescription::Coupling& coupling : inspected.description.couplings) {
        if (coupling.joint == joint.name) {
          mover = FormatShort(coupling.ratio) + " × " + coupling.follows;
          if (coupling.offset != 0) {
            mover += (coupling.offset < 0 ? " − " : " + ") +
                     FormatShort(std::abs(coupling.offset)) + " rad";
          }
        }
      }
      rows.push_back({finger.name, joint.name, FormatFixed(Degrees(joint.lower), 1),
                      FormatFixed(Degrees(joint.upper), 1), force, mover});
    }
  }
  return FormatRows(rows);
}

/// Format the list of conversions. Equal conversions of several elements are one row.
std::string ConversionText(const InspectedHand& inspected) {
  struct Group {
    const Conversion* first;
    int count;
  };
  std::vector<std::pair<std::string, Group>> groups;
  for (const Conversion& conversion : inspected.conversions) {
    const std::string key = conversion.file + "\n" + conversion.element + "\n" +
                            conversion.attribute + "\n" + conversion.outcome;
    const auto found = std::ranges::find(groups, key, &std::pair<std::string, Group>::first);
    if (found == groups.end()) {
      groups.emplace_back(key, Group{&conversion, 1});
    } else {
      ++found->second.count;
    }
  }
  std::vector<TextRow> rows;
  for (const auto& [unused, group] : groups) {
    const Conversion& first = *group.first;
    const std::string place =
        fs::path(first.file).filename().string() + ":" + std::to_string(first.line);
    const std::string element = first.element + (first.name.empty() ? "" : " " + first.name);
    rows.push_back(
        {"converted", place,
         element + (group.count > 1 ? " and " + std::to_string(group.count - 1) + " more" : ""),
         first.attribute.empty() ? "-" : first.attribute, first.outcome});
  }
  return rows.empty() ? "" : FormatRows(rows);
}

}  // namespace

InspectedHand InspectHand(const fs::path& path) {
  InspectedHand inspected;
  const bool is_description = path.extension() == ".json";
  inspected.model = path;
  if (is_description) {
    inspected.description = ParseHandDescription(ReadFile(path), path.string());
    inspected.model = path.parent_path() / inspected.description.model;
  }
  CompiledModel compiled = CompileModel(inspected.model);
  if (!is_description) {
    DerivedHand derived = DeriveHand(compiled, path.string());
    inspected.description = std::move(derived.description);
    inspected.description.model = path.filename().string();
    inspected.notes = std::move(derived.notes);
  }
  inspected.hand = BuildHand(inspected.description, compiled, path.string());
  inspected.visuals = VisualsOf(compiled, inspected.description.palm, inspected.hand);
  inspected.actuators = ActuatorsOf(compiled);
  for (std::string& warning : ActuationWarnings(inspected.hand, compiled)) {
    inspected.notes.push_back(std::move(warning));
  }
  inspected.conversions = std::move(compiled.text.conversions);
  return inspected;
}

double LargestReach(const Finger& finger) {
  const auto reach = [&](const JointConfiguration& configuration) {
    return TipAt(finger, configuration).centre.norm();
  };
  const JointConfiguration range = finger.upper - finger.lower;
  JointConfiguration best = finger.lower;
  // Odometer over all independent joints.
  std::vector<int> step(static_cast<std::size_t>(finger.drives), 0);
  for (bool more = true; more;) {
    JointConfiguration configuration = finger.lower;
    for (int i = 0; i < finger.drives; ++i) configuration[i] += range[i] * step[i] / kReachSteps;
    if (reach(configuration) > reach(best)) best = configuration;
    more = false;
    for (int& at : step) {
      more = ++at <= kReachSteps;
      if (more) break;
      at = 0;
    }
  }
  for (double size = 0.5 / kReachSteps; size > kFinestStep; size /= 2) {
    for (int i = 0; i < finger.drives; ++i) {
      for (const int sign : {-1, 1}) {
        JointConfiguration configuration = best;
        configuration[i] =
            std::clamp(best[i] + sign * size * range[i], finger.lower[i], finger.upper[i]);
        if (reach(configuration) > reach(best)) best = configuration;
      }
    }
  }
  return reach(best);
}

std::string InspectionText(const InspectedHand& inspected) {
  const HandDescription& description = inspected.description;
  std::string text =
      FormatRows({{"hand", description.name + ", " + inspected.model.lexically_normal().string()},
                  {"palm", description.palm},
                  {"up", DirectionText(description.up)}});
  text += "\n" + FingerTable(inspected) + "\n" + JointTable(inspected);
  std::string remarks = ConversionText(inspected);
  for (const std::string& note : inspected.notes) remarks += OneLine("note  " + note) + "\n";
  return remarks.empty() ? text : text + "\n" + remarks;
}

}  // namespace regrasp::kinematics
