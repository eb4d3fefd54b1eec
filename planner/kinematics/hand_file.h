#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/kinematics/hand_model.h"
#include "planner/plan/plan.h"

namespace regrasp::kinematics {

struct CompiledModel;

/// Hand with its description and compiled model.
struct HandFile {
  HandDescription description;
  /// Shared, because CompiledModel is incomplete here. Callers that require more than the hand use
  /// it.
  std::shared_ptr<const CompiledModel> compiled;
  HandModel hand;
  std::vector<std::string> warnings;  ///< ActuationWarnings (derive_couplings.h)
};

/// Read a hand: a file `hand.json` (docs/formats.md) and its MJCF or URDF model.
///
/// Joints between the model's root and the palm are fixed in the reference configuration. Colliding
/// geoms become convex shapes: a box its eight corners, a mesh the hull of its vertices, a cylinder
/// or an ellipsoid a polyhedron around it. Geoms of a fingertip's body are replaced by a capsule
/// from the body's origin to the fingertip sphere. Geoms inside the sphere of bodies fixed to the
/// fingertip's body are part of the fingertip.
/// @throws InputError  if the model cannot be compiled, a body or joint is missing, fingers share a
///     joint, a joint is not revolute or has no limits, or the model's physics, couplings or
///     collision geoms cannot be represented (hand_model.h). The message names the file and the
///     element.
[[nodiscard]] HandFile ReadHandFile(const std::filesystem::path& path);

/// Return the files that a hand file names: those of its model with includes, and the meshes.
/// Empty if the hand file or its model is invalid.
[[nodiscard]] std::vector<std::filesystem::path> FilesOfHand(const std::filesystem::path& path);

/// Return a hand on which gravity acts as in a plan (plan::HandUse::up).
[[nodiscard]] HandFile HandOfPlan(HandFile file, const plan::Plan& plan);

/// Read a hand without its model.
/// @throws InputError  as ReadHandFile.
[[nodiscard]] HandModel ReadHand(const std::filesystem::path& path);

/// Build a hand from a description and a compiled model. Its file name and digest are empty.
/// @param file  name of the hand's file in messages.
/// @throws InputError  as ReadHandFile, except for compilation.
[[nodiscard]] HandModel BuildHand(const HandDescription& description, const CompiledModel& compiled,
                                  const std::string& file);

}  // namespace regrasp::kinematics
