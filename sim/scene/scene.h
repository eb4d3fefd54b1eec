#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/plan_reach.h"
#include "sim/scene/align_script.h"
#include "sim/scene/contact_patches.h"
#include "sim/scene/engine.h"
#include "sim/scene/settings.h"

namespace regrasp::sim {

/// A place where fingers touch, and what stops them there; metres in S.
struct SceneSite {
  ContactSite place;
  std::vector<ContactPatch> patches;
  std::vector<FingerIndex> fingers;  ///< which touch there
};

/// A finger of the hand, whether the plan uses it or not.
struct SceneFinger {
  int collision_bit = 0;                              ///< 0 where it never touches
  SiteIndex first_site = {};                          ///< where the plan first puts it
  Eigen::Vector3d start_S = Eigen::Vector3d::Zero();  ///< its tip at the beginning
};

/// What the scene knows of an entry of the replay.
struct SceneEntry {
  std::optional<AlignScript> script;          ///< of an align, in S
  std::optional<plan::Obstacle> unreachable;  ///< a finger that cannot stand where it has to
};

/// A body and a plan in the frame S of the simulation: metres about the object's centroid.
///
/// A planar object is the prism of its polygon about the plane z = 0, free to move in the plane and
/// to turn about z; its fingers are capsules along z that move in the plane.
struct Scene {
  int dimension = 3;
  ReplaySettings settings;
  std::vector<SceneSite> sites;      ///< by SiteIndex
  std::vector<SceneFinger> fingers;  ///< by the number of the finger
  std::vector<SceneEntry> entries;   ///< as in the report: 0 is the hold, k the plan's k-th step
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< kg m², about the centroid
};

/// Metres about the centroid; normal and face stay.
[[nodiscard]] grasp::Contact ToScene(const object::Object& object, double scale,
                                     const grasp::Contact& contact);
[[nodiscard]] plan::FingerGrasp ToScene(const object::Object& object, double scale,
                                        plan::FingerGrasp grasp);

/// Everything that the replay of `plan` needs to know about the body. Only the initial grasp and
/// the first `steps` steps are looked at.
/// @throws InputError  a size or mass out of range, a contact that is on no face.
[[nodiscard]] Scene MakeScene(const object::Object& body, const plan::Plan& plan, int steps,
                              const ReplayOptions& options);

/// The site on `contact.face` whose path passes nearest to the contact.
[[nodiscard]] SiteIndex FindSite(const Scene& scene, const grasp::Contact& contact_S);
/// The same for a path from one contact to another, straight inside one face or a turn to the next:
/// the site that both belong to.
[[nodiscard]] SiteIndex FindSite(const Scene& scene, const grasp::Contact& from_S,
                                 const grasp::Contact& to_S);

/// The same scene in other units: what is in metres, kilograms and seconds is in `units`.
[[nodiscard]] Scene InUnits(Scene scene, const EngineUnits& units);

/// The scene as MJCF; every number reads back as the same double.
/// @param hold  the control of every finger, newtons over stiffness, that holds the
///              initial grasp; stored as the keyframe "hold".
/// @param surface  whether the object's true surface is written too, for the eye only.
[[nodiscard]] std::string FormatScene(const Scene& scene, const object::Object& body,
                                      const std::vector<Eigen::Vector3d>& hold, bool surface);

}  // namespace regrasp::sim
