#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/projection.h"
#include "planner/roadmap/clustered_roadmap.h"
#include "render/frames/body_shape.h"
#include "render/frames/fault_marks.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/hand_view.h"
#include "render/frames/viewpoint.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// Minimum and maximum side of a frame, pixels.
inline constexpr int kMinFrameSide = 48;
inline constexpr int kMaxFrameSide = 4096;

/// Background of a frame: white, dark with light text, or transparent (an alpha channel).
enum class Background { kWhite, kDark, kTransparent };
/// Return the colours for a background. Transparent frames use those for white, because reports
/// show them on white.
[[nodiscard]] Ground GroundOf(Background background);

/// Index of the camera of all frames without an own camera.
inline constexpr int kCommonView = -1;

/// Texts of a frame: one line of UTF-8 each; empty for none.
struct FrameText {
  std::string caption;        ///< text at the bottom left
  std::string progress = {};  ///< text at the top right
  /// Whether the image is part of a page or an overview, which has the heading of a fault as text.
  /// The image then omits it.
  bool is_on_page = false;
  double size = 1;  ///< size of texts; larger ones stay readable in images that are shown smaller
};

struct FrameOptions {
  int width = 1280;
  int height = 960;
  int supersampling = 2;  ///< factor by which both axes are rendered larger, before averaging
  BodyOptions body = {};
  ViewOptions view = {};
  /// Whether frames are those of an animation: with free fingers in the air, and without insets.
  bool animated = false;
  /// Whether the object is translucent like glass, instead of opaque.
  bool glass = false;
  /// Names of the fingers by index; other fingers have their number.
  std::vector<std::string> finger_names = {};
  /// True radius of the fingers, in object units. If not set, fingers have a symbolic size.
  std::optional<double> finger_radius = std::nullopt;
  /// Whether to leave space at the top for the heading of a failed step.
  bool has_heading = false;
  /// Additional points that must be visible unless they are far away: metres, world frame.
  std::vector<Eigen::Vector3d> also_seen = {};
  /// Directions that the last snapshot must show from the side, such as the distance of a finger
  /// from the surface: unit vectors, world frame. If one of them points towards the eye, the
  /// snapshot gets its own camera.
  std::vector<Eigen::Vector3d> shown_lengths = {};
  /// Whether to draw the focus point of a concurrent grasp of a solid, the lines to it and its
  /// independent contact regions on planar faces (planner/sets/polyhedron/face_part.h).
  bool show_focus = false;
  /// Contact clusters of a solid: their colours on its surface and their representatives as dots.
  std::optional<roadmap::ClusterView> clusters = std::nullopt;
  /// Whether to crop frames to their content. Only one side of the size above is then kept.
  bool crop = false;
  /// Hand that executes the plan; null for fingers without a hand. With a hand the palm is fixed in
  /// the image, and no frame has its own camera.
  std::shared_ptr<const HandView> hand = nullptr;
  /// Poses of the hand's links in all frames of an animation: metres, world frame. If they are
  /// given, parts of links that none of these frames shows are not drawn.
  std::vector<std::vector<Eigen::Isometry3d>> links_W = {};
  /// Additional points that must be visible at any distance: metres, world frame.
  std::vector<Eigen::Vector3d> reached = {};
  Background background = Background::kWhite;
};

/// A renderer for the frames of a replay.
///
/// The object is opaque with creases and outline, and fingers behind it shine through faintly. With
/// a hand its colours depend on the direction of the surface, so that they show its rotation. Each
/// finger has a sphere and a stem along
/// the normal, a number or name, and a colour that is the same in the whole sequence. Friction
/// cones have their true angle, and forces are arrows. A placed finger has a ring and an arrow
/// towards the object. A released finger is a ghost with an arrow away from it. A sliding finger
/// has a ghost at its start and a dashed track. Planar objects are nearly opaque prisms, seen
/// vertically from above without perspective, with contacts and flat friction cones on top.
///
/// One renderer draws a whole plan with one camera, so that frames are comparable. The camera shows
/// everything that is drawn of `snapshots` (ChooseViewpoints). Unless the direction is given,
/// snapshots that it does not show well get their own camera. All frames share the scale of force
/// arrows. Deterministic: the same input gives the same bytes. One thread at a time can use a
/// renderer.
class FrameRenderer {
 public:
  /// Create a renderer.
  /// @param object          must outlive this renderer.
  /// @param scale           metres per unit of the object.
  /// @param friction_angle  friction angle of the cones, radians.
  /// @param snapshots       snapshots of the whole sequence, for the choice of cameras.
  /// @throws EnvironmentError       if off-screen rendering is not available.
  /// @throws std::invalid_argument  if a side is outside [kMinFrameSide, kMaxFrameSide], or
  ///                                supersampling outside [1, 4].
  FrameRenderer(const object::Object& object, double scale, double friction_angle,
                const std::vector<plan::Snapshot>& snapshots, const FrameOptions& options = {});
  /// Copy a renderer, for use by another thread. Both draw the same frames.
  FrameRenderer(const FrameRenderer& other);
  FrameRenderer& operator=(const FrameRenderer&) = delete;
  ~FrameRenderer();

  /// Sides of every frame, pixels. They are even, and smaller than the options if frames are
  /// cropped.
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;

  /// Return whether the snapshot with this index in the sequence has its own camera.
  [[nodiscard]] bool HasOwnView(int index) const;

  /// Draw a frame.
  /// @param fault    marks of a failed step, whose fingers are red; null for none.
  /// @param view     index of the snapshot in the sequence whose camera is used; kCommonView for
  ///                 the common camera.
  [[nodiscard]] Image Render(const plan::Snapshot& snapshot, const FrameText& text = {},
                             const FaultMarks* fault = nullptr, int view = kCommonView);
  /// Draw a frame with several texts. It takes little longer than with one.
  /// @returns an image for each text.
  [[nodiscard]] std::vector<Image> RenderWithTexts(const plan::Snapshot& snapshot,
                                                   std::span<const FrameText> texts,
                                                   const FaultMarks* fault = nullptr,
                                                   int view = kCommonView);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::render
