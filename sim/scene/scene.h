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

/// Place at which fingers make contact, and the patches that stop them there; metres in S.
struct SceneSite {
  ContactSite place;
  std::vector<ContactPatch> patches;
  std::vector<FingerIndex> fingers;  ///< fingers that make contact there
};

/// Finger of the hand, whether or not the plan uses it.
struct SceneFinger {
  int collision_bit = 0;                              ///< 0 if it never makes contact
  SiteIndex first_site = {};                          ///< site of its first contact in the plan
  Eigen::Vector3d start_S = Eigen::Vector3d::Zero();  ///< initial position of its fingertip
};

/// Data of the scene for an entry of the replay.
struct SceneEntry {
  std::optional<AlignScript> script;          ///< execution of a sliding step, in S
  std::optional<plan::Obstacle> unreachable;  ///< finger that cannot reach a required contact
};

/// Object and plan in the frame S of the simulation: metres about the object's centroid.
///
/// A planar object is the prism of its polygon about the plane z = 0, free to move in the plane and
/// to rotate about z. Its fingers are capsules along z that move in the plane.
struct Scene {
  int dimension = 3;
  ReplaySettings settings;
  std::vector<SceneSite> sites;      ///< sites [SiteIndex]
  std::vector<SceneFinger> fingers;  ///< fingers [number of the finger]
  /// Entries as in the report: 0 is the initial grasp, k the plan's k-th step.
  std::vector<SceneEntry> entries;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< kg m², about the centroid
};

/// Convert a contact to metres about the centroid; normal and face do not change.
[[nodiscard]] grasp::Contact ToScene(const object::Object& object, double scale,
                                     const grasp::Contact& contact);
[[nodiscard]] plan::FingerGrasp ToScene(const object::Object& object, double scale,
                                        plan::FingerGrasp grasp);

/// Make the scene of the replay of a plan.
/// @param steps  number of steps of the plan that are included after the initial grasp.
/// @throws InputError  if a size or mass is out of range, or a contact has no face.
[[nodiscard]] Scene MakeScene(const object::Object& body, const plan::Plan& plan, int steps,
                              const ReplayOptions& options);

/// Return the site on `contact.face` whose path is nearest to the contact.
[[nodiscard]] SiteIndex FindSite(const Scene& scene, const grasp::Contact& contact_S);
/// Return the site that two contacts of a path share.
/// The path is straight inside one face, or turns to the next face.
[[nodiscard]] SiteIndex FindSite(const Scene& scene, const grasp::Contact& from_S,
                                 const grasp::Contact& to_S);

/// Return the scene in other units instead of metres, kilograms and seconds.
[[nodiscard]] Scene InUnits(Scene scene, const EngineUnits& units);

/// Return the scene as MJCF; every number reads back as the same double.
/// @param hold  control of every finger, newtons over stiffness, that holds the initial grasp;
///     stored as the keyframe "hold".
/// @param surface  whether to include the object's surface for rendering.
[[nodiscard]] std::string FormatScene(const Scene& scene, const object::Object& body,
                                      const std::vector<Eigen::Vector3d>& hold, bool surface);

}  // namespace regrasp::sim
