#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "sim/scene/align_script.h"
#include "sim/scene/contact_patches.h"
#include "sim/scene/engine.h"
#include "sim/scene/settings.h"

namespace regrasp {

/// A body and a plan in the frame S of the simulation: metres about the object's centroid.
///
/// A planar object is the prism of its polygon about the plane z = 0, free to move in the plane and
/// to turn about z; its fingers are capsules along z that move in the plane.
struct Scene {
  int dimension = 3;
  ReplaySettings settings;
  std::vector<ContactSite> sites;                   ///< where fingers touch, metres in S
  std::vector<std::vector<ContactPatch>> patches;   ///< per site, metres in S
  std::vector<std::vector<int>> fingers_of_site;    ///< which fingers touch there
  std::vector<int> collision_bit;                   ///< of each finger; 0 where it never touches
  std::vector<int> first_site;                      ///< where the plan first puts each finger, −1
  std::vector<std::optional<AlignScript>> scripts;  ///< of every step that is an align, in S
  std::vector<std::string> unreachable;  ///< of every entry: which finger cannot stand, or nothing
  std::vector<Eigen::Vector3d> finger_start_S;        ///< tip of every finger at the beginning
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< kg m², about the centroid
};

/// Metres about the centroid; normal and face stay.
[[nodiscard]] Contact ToScene(const Object& object, double scale, const Contact& contact);
[[nodiscard]] FingerGrasp ToScene(const Object& object, double scale, FingerGrasp grasp);

/// Everything that the replay of `plan` needs to know about the body. Only the initial grasp and
/// the first `steps` steps are looked at.
/// @throws InputError  a size or mass out of range, a contact that is on no face.
[[nodiscard]] Scene MakeScene(const Object& body, const Plan& plan, int steps,
                              const ReplayOptions& options);

/// The site on `contact.face` whose path passes nearest to the contact.
[[nodiscard]] int FindSite(const Scene& scene, const Contact& contact_S);
/// The same for a way from one contact to another, straight inside one face or a turn to the next:
/// the site that both belong to.
[[nodiscard]] int FindSite(const Scene& scene, const Contact& from_S, const Contact& to_S);

/// The same scene in other units: what is in metres, kilograms and seconds is in `units`.
[[nodiscard]] Scene InUnits(Scene scene, const EngineUnits& units);

/// The scene as MJCF; every number reads back as the same double.
/// @param hold  the control of every finger, newtons over stiffness, that holds the
///              initial grasp; stored as the keyframe "hold".
/// @param surface  whether the object's true surface is written too, for the eye only.
[[nodiscard]] std::string FormatScene(const Scene& scene, const Object& body,
                                      const std::vector<Eigen::Vector3d>& hold, bool surface);

}  // namespace regrasp
