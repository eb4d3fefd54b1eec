#pragma once

#include <string>

#include "planner/kinematics/derive_hand.h"

namespace regrasp::kinematics {

/// Modifications of a model of three fingers.
struct RingParts {
  std::string before = "";  ///< first elements of the model
  std::string after = "";   ///< last elements of the model
  std::string palm = R"(<geom type="cylinder" size="0.07 0.01" pos="0 0 -0.02"/>)";
  std::string joint3 = "";  ///< attributes of the third joint of each finger
  std::string geoms = "";   ///< attributes of all geoms of the fingers
  std::string inside = "";  ///< elements of each fingertip's body
};

/// Return a finger "fK" along z with joints fK1, fK2, fK3 about y.
/// Its links are capsules of radius 0.008 m, its fingertip a sphere of radius 0.01 m.
inline std::string RingFinger(const RingParts& parts, const std::string& name,
                              const std::string& place) {
  const auto capsule = [&](const std::string& end) {
    return "<geom type=\"capsule\" size=\"0.008\" fromto=\"0 0 0 0 0 " + end + "\" " + parts.geoms +
           "/>";
  };
  return "<body name=\"" + name + "a\" " + place + "><joint name=\"" + name +
         "1\" axis=\"1 0 0\" range=\"-0.7 0.7\"/>" + capsule("0.048") + "<body name=\"" + name +
         "b\" pos=\"0 0 0.048\"><joint name=\"" + name + "2\" axis=\"0 1 0\" range=\"-0.1 1.4\"/>" +
         capsule("0.032") + "<body name=\"" + name + "c\" pos=\"0 0 0.032\"><joint name=\"" + name +
         "3\" axis=\"0 1 0\" range=\"-0.5 1.6\" " + parts.joint3 + "/>" + capsule("0.024") +
         "<geom type=\"sphere\" size=\"0.01\" pos=\"0 0 0.024\" " + parts.geoms + "/>" +
         parts.inside + "</body></body></body>";
}

/// Return an MJCF model of three fingers on a palm, in radians.
inline std::string RingXml(const RingParts& parts = {}) {
  return R"(<mujoco model="ring"><compiler angle="radian" autolimits="true"/>)" + parts.before +
         "<worldbody><body name=\"palm\">" + parts.palm + R"(<body name="knob" pos="0 0 -0.03">
         <joint name="knob1" axis="0 0 1" range="-1 1"/><geom size="0.005" contype="0"
         conaffinity="0"/></body>)" +
         RingFinger(parts, "f", "pos=\"0.06 0 0\" euler=\"0 0 3.14159265\"") +
         RingFinger(parts, "g", "pos=\"-0.03 0.052 0\" euler=\"0 0 5.23598776\"") +
         RingFinger(parts, "h", "pos=\"-0.03 -0.052 0\" euler=\"0 0 7.33038286\"") +
         "</body></worldbody>" + parts.after + "</mujoco>";
}

}  // namespace regrasp::kinematics
