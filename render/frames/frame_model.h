#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/projection.h"
#include "render/frames/body_shape.h"
#include "render/frames/canvas.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/frame.h"
#include "render/frames/hand_view.h"

namespace regrasp::render {

/// Canvas meshes of a frame. Meshes of clusters follow, one per colour, and then those of the
/// hand's links.
enum FrameMesh { kOutsideMesh, kInsideMesh, kShellMesh, kConeMesh, kArrowMesh, kClusterMesh };

/// The common data of the frames of a sequence: object, hand, meshes and scales.
struct FrameModel {
  /// @param object     must outlive this model.
  /// @param snapshots  snapshots of the sequence.
  FrameModel(const object::Object& object, double scale, double friction_angle,
             const std::vector<plan::Snapshot>& snapshots, const FrameOptions& options);

  /// Return the radius of fingers in diameters; nullopt for a symbolic size.
  [[nodiscard]] std::optional<double> FingerRadius() const;
  /// Return the glyphs of a snapshot.
  [[nodiscard]] std::vector<FingerGlyph> GlyphsOf(const plan::Snapshot& snapshot,
                                                  bool free_fingers) const;
  [[nodiscard]] std::vector<Shape> FingerShapes(const std::vector<FingerGlyph>& fingers) const;
  /// Return all meshes of the canvas.
  /// @param link_detail  size of the details of links that are omitted, in diameters
  ///                     (ReduceDetail).
  /// @param eyes         positions of the eye relative to the links (MakeHandMeshes).
  [[nodiscard]] std::vector<ShadedMesh> CanvasMeshes(
      double link_detail, std::span<const std::vector<Eigen::Vector3d>> eyes = {}) const;
  /// Return whether the object is drawn opaque.
  [[nodiscard]] bool opaque() const { return !planar && !options.glass; }

  FrameOptions options;
  const object::Object& object;
  double scale;
  double friction_angle;
  BodyShape body;
  NormalizedFrame frame;
  bool planar;
  std::shared_ptr<const HandFigure> hand;  ///< null without a hand; shared with copies
  std::vector<ShadedMesh> meshes;          ///< meshes of object and fingers
  double largest_force;
};

}  // namespace regrasp::render
