#include "render/frames/frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>

#include "planner/sets/polyhedron/face_part.h"
#include "render/frames/annotation.h"
#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/fault_marks.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/step_scene.h"
#include "render/frames/viewpoint.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

constexpr double kEdgeRadius = 0.0026;  // in diameters
/// Number of edges above which they are drawn thinner, because the edges of a fine mesh would cover
/// it.
constexpr double kManyEdges = 150;

/// Radius of cluster representatives, in diameters.
constexpr double kRepresentativeRadius = 0.005;
/// Opacity of the near surface if it shows clusters.
constexpr double kClusterOpacity = 0.85;

/// Opacity of the near surface, and of the far surface behind it.
constexpr double kOutsideOpacity = 0.33;
constexpr double kInsideOpacity = 0.30;
/// Opacity of a prism. Fingers and cones are on its top, so its lower part only indicates depth.
constexpr double kPrismOpacity = 0.9;
constexpr Color kPrism = {205, 221, 241};

/// Radii of the focus point, the lines to it and the outlines of contact regions, in diameters.
constexpr double kFocusRadius = 0.014;
constexpr double kFocusLineRadius = 0.0020;
constexpr double kRegionLineRadius = 0.0030;
constexpr Color kFocus = {150, 30, 90};
constexpr Color kBlack = {0, 0, 0};

/// Largest distance of a replayed contact from its planned face, in diameters.
constexpr double kFocusReach = 1e-2;

/// Distance from the centre (diameters) beyond which additional points do not enlarge the view.
constexpr double kFarMark = 1.5;

/// Translation (diameters) beyond which an object does not enlarge the view.
constexpr double kFarAway = 0.5;

/// Margins in font sizes: all around, at the top for a heading, and at the bottom for a caption of
/// two lines.
constexpr double kFrameMargin = 2.1;
constexpr double kHeadingMargin = 3.75;
constexpr double kCaptionMargin = 4.6;
constexpr double kMostMargin = 0.25;  ///< maximum margin per image height

/// Minimum width and height of a cropped frame per original side, for captions and headings.
constexpr double kNarrowest = 0.75;
constexpr double kLowest = 0.35;

constexpr int kMaxSupersampling = 4;

/// Opacity of the near side and the lines of the ghost.
constexpr double kGhostOpacity = 0.14;
constexpr double kGhostLineOpacity = 0.55;

/// Maximum number of evenly spaced frames of a hand that determine the viewpoint.
constexpr std::size_t kMostViewed = 12;

/// Meshes of clusters follow, one per colour, and then those of the hand's links.
enum Mesh { kOutsideMesh, kInsideMesh, kConeMesh, kArrowMesh, kClusterMesh };

void CheckOptions(const FrameOptions& options) {
  const auto good = [](int side) { return side >= kMinFrameSide && side <= kMaxFrameSide; };
  if (!good(options.width) || !good(options.height) || options.supersampling < 1 ||
      options.supersampling > kMaxSupersampling) {
    throw std::invalid_argument(
        "FrameRenderer: image size and supersampling must be within their limits");
  }
}

/// Split a surface into one mesh per colour.
std::vector<ShadedMesh> MakeClusterMeshes(const ShadedMesh& surface,
                                          const roadmap::ClusterView& clusters) {
  std::vector<ShadedMesh> meshes(roadmap::kClusterColors);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    ShadedMesh& mesh = meshes[clusters.color_of_triangle[i]];
    mesh.triangles.push_back(surface.triangles[i]);
    mesh.normals.push_back(surface.normals[i]);
  }
  return meshes;
}

std::vector<ShadedMesh> MakeMeshes(const BodyShape& body, bool planar, double friction_angle,
                                   const std::optional<roadmap::ClusterView>& clusters) {
  std::vector<ShadedMesh> meshes = {
      body.surface, TurnInsideOut(body.surface),
      planar ? MakeWedge(friction_angle, kConeLength) : MakeCone(friction_angle, kConeLength),
      MakeCone(kArrowHeadHalfAngle, kArrowHeadLength)};
  if (clusters) {
    for (ShadedMesh& mesh : MakeClusterMeshes(body.surface, *clusters)) {
      meshes.push_back(std::move(mesh));
    }
  }
  return meshes;
}

/// Append the meshes of a hand.
std::vector<ShadedMesh> WithHand(std::vector<ShadedMesh> meshes, const HandView* hand,
                                 const NormalizedFrame& frame) {
  if (hand == nullptr) return meshes;
  for (ShadedMesh& mesh : MakeHandMeshes(*hand, frame)) meshes.push_back(std::move(mesh));
  return meshes;
}

/// Rotate flat friction cones about their axes into the plane.
void LayFlat(std::vector<Shape>& shapes) {
  for (Shape& shape : shapes) {
    auto* mesh = std::get_if<MeshInstance>(&shape.form);
    if (mesh == nullptr || mesh->mesh != kConeMesh) continue;
    const Vector3d axis = mesh->pose.linear().col(2);
    mesh->pose.linear() << Vector3d::UnitZ().cross(axis), Vector3d::UnitZ(), axis;
  }
}

int EvenShare(double share, int side) { return 2 * static_cast<int>(share * side / 2); }

void PaintRed(const std::vector<FingerIndex>& at_fault, std::vector<FingerGlyph>& fingers) {
  for (FingerGlyph& glyph : fingers) {
    if (std::ranges::find(at_fault, glyph.finger) != at_fault.end()) glyph.color = kFaultRed;
  }
}

Margins MarginsFor(const FrameOptions& options) {
  const double font = FontSize(options.width, options.height) / options.height;
  const auto margin = [&](double fonts) { return std::min(fonts * font, kMostMargin); };
  return {margin(kFrameMargin), margin(options.has_heading ? kHeadingMargin : kFrameMargin),
          margin(kCaptionMargin)};
}

bool IsNear(const Eigen::Isometry3d& pose) {
  return pose.translation().allFinite() && pose.translation().norm() < kFarAway;
}

}  // namespace

class FrameRenderer::Impl {
 public:
  Impl(const object::Object& object, double scale, double friction_angle,
       const std::vector<plan::Snapshot>& snapshots, const FrameOptions& options)
      : options_(options),
        object_(object),
        scale_(scale),
        friction_angle_(friction_angle),
        body_(MakeBodyShape(object, options.body)),
        frame_{scale * object.diameter(), scale * object.mass_properties().centroid},
        planar_(object.dimension() == 2),
        hand_(options.hand ? std::make_shared<const HandFigure>(*options.hand, frame_) : nullptr),
        meshes_(MakeMeshes(body_, planar_, friction_angle, options.clusters)),
        largest_force_(LargestForce(snapshots)),
        style_{FontSize(options.width, options.height), GroundOf(options.background)},
        cameras_(MakeCameras(snapshots)),
        canvas_(WithHand(meshes_, options.hand.get(), frame_), width(), height(),
                options.supersampling) {}

  [[nodiscard]] int width() const { return cameras_.common.width; }
  [[nodiscard]] int height() const { return cameras_.common.height; }
  [[nodiscard]] bool HasOwnView(int index) const { return cameras_.own.contains(index); }

  Image Render(const plan::Snapshot& snapshot, const std::string& caption, const FaultMarks* fault,
               int view) {
    const Camera& camera = HasOwnView(view) ? cameras_.own.at(view) : cameras_.common;
    std::vector<FingerGlyph> fingers = GlyphsOf(snapshot);
    for (FingerGlyph& glyph : fingers) glyph.force_color = style_.ground.force;
    if (fault != nullptr) PaintRed(fault->fingers, fingers);
    const Eigen::Isometry3d pose = frame_.BodyPose(snapshot.X_WO);
    Drawing drawing = DrawBody(pose, camera);
    for (Shape& shape : FingerShapes(fingers)) drawing.shapes.push_back(std::move(shape));
    if (!snapshot.links_W.empty() && hand_) {
      drawing.veil = HandOf(snapshot, fingers, fault, camera);
    }
    const std::vector<Vector3d> arrow = AddBefore(snapshot, fault, camera, drawing);
    if (options_.show_focus) AddFocus(snapshot, drawing.shapes);
    if (options_.clusters) AddRepresentatives(snapshot, drawing.shapes);
    const auto draw = [&](Color paper) {
      const CairoImage image(canvas_.Draw(camera, drawing, paper));
      DrawRings(image, camera, fingers, style_);
      std::vector<Obstacle> covered =
          DrawCaption(image, camera, caption, frame_.diameter_m, style_);
      const auto cover = [&covered](const std::vector<Obstacle>& more) {
        covered.insert(covered.end(), more.begin(), more.end());
      };
      cover(ObstaclesOf(camera, arrow));
      if (fault != nullptr) {
        cover(DrawFaultMarks(image, camera, frame_, body_, fingers, *fault, style_));
      }
      if (options_.gaps == GapView::kNone) {
        for (const AlignInset& inset : PlaceInsets(camera, fingers, covered, style_)) {
          const Drawing body = DrawBody(pose, inset.camera, inset.magnification);
          cover(DrawInset(image, inset, canvas_.Draw(inset.camera, body, paper), style_));
        }
      }
      DrawNumbers(image, camera, fingers, covered, style_);
      return image.ToImage();
    };
    if (options_.background != Background::kTransparent) return draw(style_.ground.paper);
    return MakeTransparent(draw(kWhite), draw(kBlack));
  }

 private:
  [[nodiscard]] Veil HandOf(const plan::Snapshot& snapshot, std::span<const FingerGlyph> fingers,
                            const FaultMarks* fault, const Camera& camera) const {
    const std::vector<plan::HandLink> none;
    return {hand_->Shapes(snapshot, fault != nullptr ? fault->links : none,
                          static_cast<int>(meshes_.size())),
            {{kOutsideMesh, frame_.BodyPose(snapshot.X_WO)}},
            hand_->Windows(snapshot, fingers, camera)};
  }

  /// Draw the pose before an in-hand motion and an arrow of the rotation, unless a fault has its
  /// own ghost.
  std::vector<Vector3d> AddBefore(const plan::Snapshot& snapshot, const FaultMarks* fault,
                                  const Camera& camera, Drawing& drawing) const {
    if (!snapshot.X_WO_before || (fault != nullptr && fault->X_WO_before)) return {};
    const Eigen::Isometry3d before = frame_.BodyPose(*snapshot.X_WO_before);
    const Eigen::Isometry3d after = frame_.BodyPose(snapshot.X_WO);
    drawing.layers.insert(drawing.layers.begin(),
                          {{{MeshInstance{kOutsideMesh, before}, kBefore}}, kGhostOpacity});
    std::vector<Shape> lines;
    AddLines(body_.edges, before, 1, lines);
    AddLines(FindOutline(body_,
                         [&](const Vector3d& p) -> Vector3d {
                           return before.linear().transpose() * camera.ToEye(before * p);
                         }),
             before, 1, lines);
    for (Shape& line : lines) {
      line.color = kBefore;
      line.opacity = kGhostLineOpacity;
      drawing.shapes.push_back(std::move(line));
    }
    const auto arrow = RotationArrow(body_.surface, before, after, camera.axes.col(2));
    if (!arrow.empty()) AddRotationArrow(arrow, kArrowMesh, style_.ground.rotation, drawing.shapes);
    return arrow;
  }

  [[nodiscard]] std::vector<FingerGlyph> GlyphsOf(const plan::Snapshot& snapshot) const {
    return MakeFingerGlyphs(snapshot, frame_, body_.rays, {options_.gaps, FingerRadius()});
  }

  [[nodiscard]] std::optional<double> FingerRadius() const {
    if (!options_.finger_radius) return std::nullopt;
    return *options_.finger_radius / object_.diameter();
  }

  [[nodiscard]] std::vector<Shape> FingerShapes(const std::vector<FingerGlyph>& fingers) const {
    std::vector<Shape> shapes;
    for (const FingerGlyph& glyph : fingers) {
      AddFingerShapes(glyph, largest_force_, {kConeMesh, kArrowMesh}, shapes);
    }
    if (planar_) LayFlat(shapes);
    return shapes;
  }

  /// Draw the object as two translucent layers, its far and its near side. Hidden parts and edges
  /// thereby become paler.
  /// @param magnification  magnification of the camera; line widths do not scale with it.
  [[nodiscard]] Drawing DrawBody(const Eigen::Isometry3d& pose, const Camera& camera,
                                 double magnification = 1) const {
    Drawing drawing;
    AddLines(body_.edges, pose, magnification, drawing.shapes);
    drawing.layers = {{{{MeshInstance{kInsideMesh, pose}, kBodyInside}}, kInsideOpacity},
                      {NearSurface(pose), NearOpacity()}};
    drawing.hiding = {{kOutsideMesh, pose}};
    AddLines(FindOutline(body_,
                         [&](const Vector3d& p) -> Vector3d {
                           return pose.linear().transpose() * camera.ToEye(pose * p);
                         }),
             pose, magnification, drawing.outline);
    return drawing;
  }

  [[nodiscard]] std::vector<Shape> NearSurface(const Eigen::Isometry3d& pose) const {
    if (!options_.clusters) {
      return {{MeshInstance{kOutsideMesh, pose}, planar_ ? kPrism : kBodyOutside}};
    }
    std::vector<Shape> shapes;
    for (int color = 0; color < roadmap::kClusterColors; ++color) {
      shapes.push_back({MeshInstance{kClusterMesh + color, pose}, kClusterPalette[color]});
    }
    return shapes;
  }

  [[nodiscard]] double NearOpacity() const {
    if (planar_) return kPrismOpacity;
    return options_.clusters ? kClusterOpacity : kOutsideOpacity;
  }

  void AddRepresentatives(const plan::Snapshot& snapshot, std::vector<Shape>& shapes) const {
    for (const Vector3d& p : options_.clusters->representatives) {
      shapes.push_back(
          {Sphere{frame_.FromWorld(snapshot.X_WO * (scale_ * p)), kRepresentativeRadius},
           style_.ground.ink});
    }
  }

  void AddLines(const std::vector<std::array<Vector3d, 2>>& lines, const Eigen::Isometry3d& pose,
                double magnification, std::vector<Shape>& shapes) const {
    const auto edges = static_cast<double>(body_.edges.size());
    const double radius =
        kEdgeRadius * std::min(1.0, std::sqrt(kManyEdges / edges)) / magnification;
    for (const auto& [a, b] : lines) {
      shapes.push_back({Line{pose * a, pose * b, radius}, style_.ground.ink});
    }
  }

  /// Return the grasp of the fingers in contact, projected onto the faces of the object.
  [[nodiscard]] grasp::Grasp HeldGrasp(const plan::Snapshot& snapshot) const {
    const Eigen::Isometry3d X_OW = snapshot.X_WO.inverse();
    grasp::Grasp grasp;
    for (const plan::FingerState& finger : snapshot.fingers) {
      if (finger.role == plan::FingerRole::kFree || finger.role == plan::FingerRole::kReleased)
        continue;
      grasp::Contact contact = {X_OW * finger.contact_W / scale_, X_OW.linear() * finger.normal_W};
      double most = -1;
      for (const FaceIndex face : object_.FacesNear(contact.p, kFocusReach * object_.diameter())) {
        const double along = object_.inward_normal(face).dot(contact.n);
        if (along <= most) continue;
        most = along;
        contact.face = face;
      }
      if (!contact.face.valid()) return {};
      contact.p = object_.ClosestPoint(contact.face, contact.p);
      grasp.push_back(contact);
    }
    return grasp;
  }

  void AddFocus(const plan::Snapshot& snapshot, std::vector<Shape>& shapes) const {
    const auto* solid = dynamic_cast<const object::Polyhedron*>(&object_);
    if (solid == nullptr) return;
    const grasp::Grasp grasp = HeldGrasp(snapshot);
    const auto view = polyhedron::DescribeFocus(*solid, grasp, friction_angle_);
    if (!view) return;
    const auto place = [&](const Vector3d& p) {
      return frame_.FromWorld(snapshot.X_WO * (scale_ * p));
    };
    shapes.push_back({Sphere{place(view->focus), kFocusRadius}, kFocus});
    for (const grasp::Contact& contact : grasp) {
      shapes.push_back({Line{place(contact.p), place(view->focus), kFocusLineRadius}, kFocus});
    }
    for (const std::vector<Vector3d>& region : view->regions) {
      for (std::size_t i = 0; i < region.size(); ++i) {
        shapes.push_back(
            {Line{place(region[i]), place(region[(i + 1) % region.size()]), kRegionLineRadius},
             kFocus});
      }
    }
  }

  /// Everything that is drawn of a sequence.
  struct Sequence {
    /// Fingers of each frame; empty if the object is far away.
    std::vector<std::vector<FingerGlyph>> frames = {};
    std::vector<Eigen::Isometry3d> poses = {Eigen::Isometry3d::Identity()};
    /// Object and hand in each frame of a plan for a hand.
    std::vector<FramePlacement> placements = {};
    std::vector<Vector3d> hands = {};  ///< points that bound the hands
  };

  [[nodiscard]] Sequence SequenceOf(const std::vector<plan::Snapshot>& snapshots) const {
    Sequence all;
    for (const plan::Snapshot& snapshot : snapshots) {
      all.frames.emplace_back();
      if (hand_) all.placements.emplace_back();
      const Eigen::Isometry3d pose = frame_.BodyPose(snapshot.X_WO);
      if (!IsNear(pose)) continue;
      all.poses.push_back(pose);
      if (snapshot.X_WO_before) all.poses.push_back(frame_.BodyPose(*snapshot.X_WO_before));
      if (hand_) {
        all.placements.back() = {pose.inverse(), hand_->Rays(snapshot)};
        const std::vector<Vector3d> bounds = hand_->Bounds(snapshot);
        all.hands.insert(all.hands.end(), bounds.begin(), bounds.end());
      }
      all.frames.back() =
          MakeFingerGlyphs(snapshot, frame_, body_.rays, {GapView::kNone, FingerRadius()});
    }
    return all;
  }

  /// Return points whose projections bound the images of a sequence.
  [[nodiscard]] std::vector<Vector3d> ExtentOf(const Sequence& all,
                                               const Eigen::Matrix3d& axes) const {
    ProjectedExtent extent(axes, meshes_);
    for (const Eigen::Isometry3d& pose : all.poses) extent.Add(MeshInstance{kOutsideMesh, pose});
    for (const std::vector<FingerGlyph>& fingers : all.frames) {
      for (const Shape& shape : FingerShapes(fingers)) extent.Add(shape.form);
      for (const FingerGlyph& glyph : fingers) {
        extent.Add(Sphere{glyph.end + glyph.outward * kLabelSpace, kLabelSpace / 2});
      }
    }
    for (const Vector3d& p : all.hands) extent.Add(Sphere{p, 0});
    for (const Vector3d& p_W : options_.reached) extent.Add(Sphere{frame_.FromWorld(p_W), 0});
    for (const Vector3d& p_W : options_.also_seen) {
      const Vector3d p = frame_.FromWorld(p_W);
      if (p.norm() < kFarMark) extent.Add(Sphere{p, kLabelSpace / 2});
    }
    return extent.points();
  }

  /// The common camera, and the own cameras of frames by index.
  struct Cameras {
    Camera common;
    std::map<int, Camera> own = {};
  };

  /// Fit a camera with the same margins in pixels for any height.
  [[nodiscard]] Camera FitTo(const std::vector<Vector3d>& points, const Vector3d& back, int width,
                             int height) const {
    Margins margins = MarginsFor(options_);
    for (double* margin : {&margins.side, &margins.top, &margins.bottom}) {
      *margin *= static_cast<double>(options_.height) / height;
    }
    const Projection default_projection =
        planar_ ? Projection::kOrthographic : Projection::kPerspective;
    return FitCamera(CameraAxes(back), options_.view.projection.value_or(default_projection), width,
                     height, margins, points);
  }

  /// Choose viewpoints. A plan for a hand has one viewpoint, with the palm fixed in the image.
  [[nodiscard]] Viewpoints ViewpointsOf(const Sequence& all) const {
    if (all.placements.empty()) {
      return ChooseViewpoints(body_, planar_, all.frames, largest_force_);
    }
    const std::size_t stride = 1 + (all.frames.size() - 1) / kMostViewed;
    std::vector<std::vector<FingerGlyph>> frames;
    std::vector<FramePlacement> placements;
    for (std::size_t i = 0; i < all.frames.size(); i += stride) {
      frames.push_back(all.frames[i]);
      placements.push_back(all.placements[i]);
    }
    return {ChooseViewpoints(body_, planar_, frames, largest_force_, placements).common, {}};
  }

  /// Compute cameras that see everything.
  [[nodiscard]] Cameras MakeCameras(const std::vector<plan::Snapshot>& snapshots) const {
    const Sequence all = SequenceOf(snapshots);
    const ViewOptions& view = options_.view;
    const Viewpoints viewpoints =
        view.direction ? Viewpoints{view.direction->ToCamera(), {}} : ViewpointsOf(all);
    const std::vector<Vector3d> points = ExtentOf(all, CameraAxes(viewpoints.common));
    Cameras cameras = {FitTo(points, viewpoints.common, options_.width, options_.height)};
    if (options_.crop) {
      cameras.common =
          Crop(cameras.common, MarginsFor(options_), points, EvenShare(kNarrowest, options_.width),
               EvenShare(kLowest, options_.height));
    }
    const auto& [width, height] = std::pair(cameras.common.width, cameras.common.height);
    for (std::size_t i = 0; i < viewpoints.own.size(); ++i) {
      if (!viewpoints.own[i]) continue;
      const Vector3d& back = *viewpoints.own[i];
      cameras.own[static_cast<int>(i)] =
          FitTo(ExtentOf(all, CameraAxes(back)), back, width, height);
    }
    cameras.common.half_height /= view.zoom;
    for (auto& [index, camera] : cameras.own) camera.half_height /= view.zoom;
    return cameras;
  }

  static double LargestForce(const std::vector<plan::Snapshot>& snapshots) {
    double largest = 0;
    for (const plan::Snapshot& snapshot : snapshots) {
      for (const plan::FingerState& finger : snapshot.fingers) {
        if (finger.role != plan::FingerRole::kReleased) {
          largest = std::max(largest, finger.force_W.norm());
        }
      }
    }
    return largest;
  }

  FrameOptions options_;
  const object::Object& object_;
  double scale_;
  double friction_angle_;
  BodyShape body_;
  NormalizedFrame frame_;
  bool planar_;
  std::shared_ptr<const HandFigure> hand_;  ///< null without a hand; shared with copies
  std::vector<ShadedMesh> meshes_;          ///< meshes of object and fingers
  double largest_force_;
  TextStyle style_;
  Cameras cameras_;
  Canvas canvas_;
};

FrameRenderer::FrameRenderer(const object::Object& object, double scale, double friction_angle,
                             const std::vector<plan::Snapshot>& snapshots,
                             const FrameOptions& options) {
  CheckOptions(options);
  impl_ = std::make_unique<Impl>(object, scale, friction_angle, snapshots, options);
}
FrameRenderer::FrameRenderer(const FrameRenderer& other)
    : impl_(std::make_unique<Impl>(*other.impl_)) {}
FrameRenderer::~FrameRenderer() = default;

Ground GroundOf(Background background) {
  return background == Background::kDark ? kDarkGround : kWhiteGround;
}

int FrameRenderer::width() const { return impl_->width(); }
int FrameRenderer::height() const { return impl_->height(); }

bool FrameRenderer::HasOwnView(int index) const { return impl_->HasOwnView(index); }

Image FrameRenderer::Render(const plan::Snapshot& snapshot, const std::string& caption,
                            const FaultMarks* fault, int view) {
  return impl_->Render(snapshot, caption, fault, view);
}

}  // namespace regrasp::render
