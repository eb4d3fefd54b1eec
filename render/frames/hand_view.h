#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "planner/plan/projection.h"
#include "planner/plan/reason.h"
#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/shaded_mesh.h"

namespace regrasp::render {

/// A link of a hand as it appears in frames.
struct HandLinkView {
  plan::HandLink link;
  bool is_fingertip = false;
  ShadedMesh mesh;  ///< mesh in the link frame, metres
};

/// The links of a hand in frames, in the order of plan::Snapshot::links_W, which has their poses.
using HandView = std::vector<HandLinkView>;

/// Return the drawn meshes of the links, in normalized units.
/// @param tolerance  size of the details that are omitted, in normalized units (ReduceDetail); 0
///                   for all triangles. Equal links have equal meshes.
[[nodiscard]] std::vector<ShadedMesh> MakeLinkMeshes(const HandView& hand,
                                                     const NormalizedFrame& frame,
                                                     double tolerance = 0);

/// Return the canvas meshes of a hand, in normalized units. Each link has a dark shell, of which
/// only the rim is visible as outline, and then its mesh (MakeLinkMeshes).
/// @param tolerance  size of omitted details, as for MakeLinkMeshes.
/// @param eyes       positions of the eye in the frame of each link, in normalized units. If they
///                   are given, triangles that none of them sees are omitted (VisiblePart).
[[nodiscard]] std::vector<ShadedMesh> MakeHandMeshes(
    const HandView& hand, const NormalizedFrame& frame, double tolerance = 0,
    std::span<const std::vector<Eigen::Vector3d>> eyes = {});

/// The drawing of a hand without its meshes, which can be large.
class HandFigure {
 public:
  HandFigure(const HandView& hand, const NormalizedFrame& frame);

  /// Return the links of a snapshot; empty if it has no hand. Fingertips in contact
  /// have a tint of their finger's colour, and links in `at_fault` are red.
  /// @param first_mesh  index of the first mesh of MakeHandMeshes in the canvas.
  [[nodiscard]] std::vector<Shape> Shapes(const plan::Snapshot& snapshot,
                                          std::span<const plan::HandLink> at_fault,
                                          int first_mesh) const;
  /// Return the shells of the fingertips in contact, or those of all other links.
  [[nodiscard]] std::vector<Shape> Rims(const plan::Snapshot& snapshot, bool in_contact,
                                        int first_mesh) const;

  /// Return the windows through a hand that would hide contacts. The more of a contact is hidden,
  /// the clearer the window.
  [[nodiscard]] std::vector<Window> Windows(const plan::Snapshot& snapshot,
                                            std::span<const FingerGlyph> fingers,
                                            const Camera& camera) const;

  /// Return points that approximately bound a snapshot's hand.
  [[nodiscard]] std::vector<Eigen::Vector3d> Bounds(const plan::Snapshot& snapshot) const;

  /// Return the posed surfaces of the links, for the choice of viewpoints.
  [[nodiscard]] std::vector<PlacedRays> Rays(const plan::Snapshot& snapshot) const;

 private:
  [[nodiscard]] bool IsInContact(const plan::Snapshot& snapshot, std::size_t link) const;
  [[nodiscard]] Eigen::Isometry3d PoseOf(const plan::Snapshot& snapshot, std::size_t link) const;

  NormalizedFrame frame_;
  std::vector<plan::HandLink> links_;
  std::vector<bool> is_fingertip_;
  std::vector<RayTree> rays_;
  std::vector<std::vector<Eigen::Vector3d>> bounds_;  ///< bounding points of each link
};

}  // namespace regrasp::render
