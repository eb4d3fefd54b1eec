#pragma once

#include <span>
#include <vector>

#include "planner/plan/reason.h"
#include "planner/plan/snapshot.h"
#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/facet_mesh.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/ray_tree.h"

namespace regrasp::render {

/// A link of a hand as frames show it.
struct HandLinkView {
  plan::HandLink link;
  bool is_tip = false;
  FacetMesh mesh;  ///< in its own frame, metres
};

/// A hand that frames show. Where its links are says plan::Snapshot::links_W, in the same order.
using HandView = std::vector<HandLinkView>;

/// For the canvas, in the picture's unit of length: for each link a dark shell, of which only the
/// rim is seen, its outline, and then the link itself.
[[nodiscard]] std::vector<FacetMesh> MakeHandMeshes(const HandView& hand,
                                                    const PictureFrame& frame);

/// What a frame needs of a hand besides its meshes, which may be large.
class HandFigure {
 public:
  HandFigure(const HandView& hand, const PictureFrame& frame);

  /// The links of a snapshot; none where it has no hand. Tips of fingers that touch have some of
  /// the finger's colour; `at_fault` is red.
  /// @param first_mesh  of MakeHandMeshes, among the canvas's.
  [[nodiscard]] std::vector<Shape> Shapes(const plan::Snapshot& snapshot,
                                          std::span<const plan::HandLink> at_fault,
                                          int first_mesh) const;

  /// Where the hand is seen through, as it would hide a contact: the more of it is hidden, the more
  /// clearly.
  [[nodiscard]] std::vector<Window> Windows(const plan::Snapshot& snapshot,
                                            std::span<const FingerGlyph> fingers,
                                            const Camera& camera) const;

  /// Points that bound what is seen of a snapshot's hand, as nearly as a picture needs it.
  [[nodiscard]] std::vector<Eigen::Vector3d> Bounds(const plan::Snapshot& snapshot) const;

  /// Surfaces of the links and where they are, for a choice of views.
  [[nodiscard]] std::vector<PlacedRays> Rays(const plan::Snapshot& snapshot) const;

 private:
  [[nodiscard]] Eigen::Isometry3d PoseOf(const plan::Snapshot& snapshot, std::size_t link) const;

  PictureFrame frame_;
  std::vector<plan::HandLink> links_;
  std::vector<bool> is_tip_;
  std::vector<RayTree> rays_;
  std::vector<std::vector<Eigen::Vector3d>> bounds_;  ///< of each link
};

}  // namespace regrasp::render
