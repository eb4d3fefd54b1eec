#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/snapshot.h"
#include "planner/roadmap/cluster_view.h"
#include "render/frames/body_shape.h"
#include "render/frames/fault_picture.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/hand_view.h"
#include "render/frames/viewpoint.h"
#include "render/picture/color_table.h"
#include "render/picture/image.h"

namespace regrasp::render {

/// Sizes that frames may have, along either axis.
inline constexpr int kMinFrameSide = 48;
inline constexpr int kMaxFrameSide = 4096;

/// What a frame stands on: white, dark with light text, or nothing (an alpha channel).
enum class Background { kWhite, kDark, kTransparent };
/// Of what is transparent it is the white one: so it is seen on the contact sheet and the page.
[[nodiscard]] Ground GroundOf(Background background);

/// The camera of all frames that have none of their own.
inline constexpr int kCommonView = -1;

struct FrameOptions {
  int width = 1280;
  int height = 960;
  int supersampling = 2;  ///< rendered this many times as large along both axes, then averaged
  BodyOptions body = {};
  ViewOptions view = {};
  /// Fingers in the air are drawn away from their contacts (render/frames/finger_glyph.h). The
  /// camera is the same.
  GapView gaps = GapView::kNone;
  /// Fingers are drawn as thick as they are, in the object's unit of length; otherwise as signs.
  std::optional<double> finger_radius = std::nullopt;
  /// Leaves room at the top for the heading of a failed step.
  bool has_heading = false;
  /// The camera sees these points too: metres, world frame.
  std::vector<Eigen::Vector3d> also_seen = {};
  /// Of a concurrent grasp of a solid: the focus point, the lines to it, and the contact regions
  /// that it gives on the faces (planner/sets/polyhedron/focus_contacts.h).
  bool show_focus = false;
  /// Of a solid: its surface in the colours of these clusters, and their representatives as dots.
  std::optional<roadmap::ClusterView> clusters = std::nullopt;
  /// Frames are no larger than what is drawn in them: of the size above only one side is kept.
  bool crop = false;
  /// Of a plan for a hand; null: fingers without one. Frames have the palm at rest then, and no
  /// frame has a view of its own.
  std::shared_ptr<const HandView> hand = nullptr;
  /// The camera sees these points too, however far they are: metres, world frame.
  std::vector<Eigen::Vector3d> reached = {};
  Background background = Background::kWhite;
};

/// Draws frames of a replay: the object translucent with creases and outline, fingers as a ball and
/// a stem along the normal, one colour and number a finger for the whole sequence, true friction
/// cones, force arrows, and the finger that moves told apart: a placed one has a ring and an arrow
/// that arrives, a released one is a ghost with an arrow that leaves, an aligned one has a ghost
/// where it came from and a dashed track. Planar objects are nearly opaque prisms, seen from
/// straight above without perspective, with contacts and flat friction cones on their top.
///
/// One renderer draws a whole plan, with one camera, so that frames can be laid side by side. The
/// camera is chosen once (ChooseViewpoints) and sees all that is drawn of `snapshots`; those that
/// it does not show well enough have one of their own, unless the direction is given. Force arrows
/// have one scale for all of them too. Deterministic: the same bytes every time. A renderer may be
/// used by one thread after the other.
class FrameRenderer {
 public:
  /// @param object      must outlive this renderer.
  /// @param scale       metres per unit of the object.
  /// @param half_angle  of the friction cones drawn, radians.
  /// @param snapshots   of the whole sequence, to choose the camera.
  /// @throws EnvironmentError       no off-screen rendering context.
  /// @throws std::invalid_argument  a side is outside [kMinFrameSide, kMaxFrameSide], or
  ///                                supersampling outside [1, 4].
  FrameRenderer(const object::Object& object, double scale, double half_angle,
                const std::vector<plan::Snapshot>& snapshots, const FrameOptions& options = {});
  /// Draws the same frames, at the same time in another thread.
  FrameRenderer(const FrameRenderer& other);
  FrameRenderer& operator=(const FrameRenderer&) = delete;
  ~FrameRenderer();

  /// Sides of every frame, pixels; even, and smaller than asked for where they are cropped.
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;

  /// Whether a snapshot of the sequence, by its index, has a camera of its own.
  [[nodiscard]] bool HasOwnView(int index) const;

  /// @param caption  one line of UTF-8 at the bottom left; none where empty.
  /// @param fault    of a failed step: its fingers are red, and what is wrong is drawn.
  /// @param view     the snapshot of the sequence, by its index, whose camera takes the picture;
  ///                 kCommonView for that of most.
  [[nodiscard]] Image Render(const plan::Snapshot& snapshot, const std::string& caption = "",
                             const FaultMarks* fault = nullptr, int view = kCommonView);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp::render
