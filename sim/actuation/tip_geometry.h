#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "planner/kinematics/hand_file.h"
#include "planner/object/polyhedron.h"

struct mjModel_;
struct mjData_;

namespace regrasp::sim {

// Fingertips that touch with what the hand's own model has there for collisions: convex shapes, as
// MuJoCo has them, against the object as the hull of its mesh.

/// By finger, the geoms of its tip's link that collide.
/// @param model  the hand's, or one that it is part of, with its flags of collisions.
/// @throws InputError  a finger has none: names the model's file, the link and the finger.
[[nodiscard]] std::vector<std::vector<int>> TipGeoms(const kinematics::HandFile& file,
                                                     const mjModel_& model);

/// No point of the geoms, all of one body, is farther than this from a point of the body's frame.
[[nodiscard]] double ReachFrom(const Eigen::Vector3d& point, const std::vector<int>& geoms,
                               const mjModel_& model);

/// @param scale  metres per unit of the solid.
/// @throws InputError  as TipGeoms; or the object has hollows, which its hull has not.
void RequireTipGeometry(const kinematics::HandFile& file, const object::Polyhedron& solid,
                        double scale);

/// Tips collide with the object, and with nothing else: with friction `mu` and no torsion, as hard
/// as balls do (tip_contact.h), several contacts for shapes that lie flat.
/// @param model  in which nothing collides.
void LetTipsCollide(const std::vector<std::vector<int>>& tips, int object_geom, double mu,
                    mjModel_& model);

/// The contacts of a tip with the object as one, in the engine's world.
struct ContactSum {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of the object's surface
  Eigen::Vector3d outward = Eigen::Vector3d::UnitZ();
  double gap = 0;                                   ///< the least
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< on the object, newtons
};

/// Force is the sum; point and normal are means weighted with the normal forces, or without weights
/// while nothing presses.
/// @returns nullopt where there is no contact.
[[nodiscard]] std::optional<ContactSum> SumContacts(const std::vector<int>& tip_geoms,
                                                    int object_geom, const mjModel_& model,
                                                    const mjData_& data);

}  // namespace regrasp::sim
