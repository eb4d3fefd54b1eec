#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/kinematics/hand_description.h"
#include "planner/kinematics/hand_model.h"

namespace regrasp::kinematics {

struct CompiledModel;

/// A hand with what it was read from.
struct HandFile {
  HandDescription description;
  /// Shared, as its type is not shown: whoever needs more than the hand takes it from there.
  std::shared_ptr<const CompiledModel> compiled;
  HandModel hand;
  std::vector<std::string> warnings;  ///< ActuationWarnings (joint_actuators.h)
};

/// Reads a hand: a file `hand.json` (docs/formats.md) and the MJCF or URDF model beside it.
///
/// Joints between the model's root and the palm stay as the model has them at rest. Colliding geoms
/// become convex shapes: a box its eight corners, a mesh the hull of its vertices, a cylinder or an
/// ellipsoid a polyhedron around it; those of the tip's body are replaced by a capsule from the
/// body's origin to the ball. Geoms of bodies fixed to the tip's body that lie inside the ball are
/// part of the tip.
/// @throws InputError  names the file, the element and what is wrong: the model cannot be compiled,
///                     a body or joint is not there, fingers share a joint, a joint is no hinge or
///                     has no limits; the model's physics, couplings or collision geoms cannot be
///                     represented (check_model.h).
[[nodiscard]] HandFile ReadHandFile(const std::filesystem::path& path);

/// The hand alone.
/// @throws InputError  as ReadHandFile.
[[nodiscard]] HandModel ReadHand(const std::filesystem::path& path);

/// The same of what is read already; without file and digest.
/// @param file  how messages call the hand's file.
[[nodiscard]] HandModel BuildHand(const HandDescription& description, const CompiledModel& compiled,
                                  const std::string& file);

}  // namespace regrasp::kinematics
