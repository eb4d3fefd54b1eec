#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "render/frames/offscreen_context.h"
#include "render/frames/shaded_mesh.h"

namespace regrasp::render {

/// Choose eyes that represent all given ones: seen from `centre`, each eye is within `angle` of a
/// chosen one.
[[nodiscard]] std::vector<Eigen::Vector3d> ChooseEyes(std::span<const Eigen::Vector3d> eyes,
                                                      const Eigen::Vector3d& centre, double angle);

/// Side of the context of VisiblePart, pixels.
inline constexpr int kVisibleSide = 1024;

/// A mesh and its shell, which has the same triangles with the opposite orientation (MakeShell).
struct ShelledMesh {
  ShadedMesh mesh;
  ShadedMesh shell;
};

/// Return the triangles of a mesh and its shell that at least one eye sees.
///
/// The mesh is drawn as each eye sees it, with a colour per triangle. Triangles of the mesh with a
/// common corner are also returned, because an eye between the given ones can see them.
/// @param shelled  mesh and shell without colours.
/// @param eyes     positions of the eye outside the shell, in the frame of the mesh.
/// @param pixel    size of a drawn pixel at the mesh, in units of the mesh.
/// @param context  context of kVisibleSide × kVisibleSide pixels. Larger meshes have larger pixels.
[[nodiscard]] ShelledMesh VisiblePart(const ShelledMesh& shelled,
                                      std::span<const Eigen::Vector3d> eyes, double pixel,
                                      OffscreenContext& context);

}  // namespace regrasp::render
