#include "render/frames/frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <stdexcept>

#include "planner/sets/polyhedron/focus_contacts.h"
#include "render/frames/align_inset.h"
#include "render/frames/annotation.h"
#include "render/frames/body_shape.h"
#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/extent.h"
#include "render/frames/fault_overlay.h"
#include "render/frames/finger_glyph.h"
#include "render/frames/step_scene.h"
#include "render/frames/viewpoint.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/color_table.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

constexpr double kEdgeRadius = 0.0026;  // in diameters
/// The more edges a body has beyond this, the thinner they are drawn: those of a fine mesh would
/// cover it.
constexpr double kManyEdges = 150;

/// Representatives of clusters, in diameters.
constexpr double kRepresentativeRadius = 0.005;
/// Of the near surface where it shows clusters.
constexpr double kClusterOpacity = 0.85;

/// Opacity of the body's near surface, and of its far surface behind that.
constexpr double kOutsideOpacity = 0.33;
constexpr double kInsideOpacity = 0.30;
/// Of a prism, whose fingers and cones lie on its top: what is below only hints at its depth.
constexpr double kPrismOpacity = 0.9;
constexpr Color kPrism = {205, 221, 241};

/// The focus point, the lines to it and the outlines of contact regions, in diameters.
constexpr double kFocusRadius = 0.014;
constexpr double kFocusLineRadius = 0.0020;
constexpr double kRegionLineRadius = 0.0030;
constexpr Color kFocus = {150, 30, 90};
constexpr Color kBlack = {0, 0, 0};

/// A contact of the replay is this near to the face that it is planned on, in diameters.
constexpr double kFocusReach = 1e-2;

/// What is farther from the object's centre (diameters) does not widen the picture.
constexpr double kFarMark = 1.5;

/// An object that moved farther than this (diameters) does not widen the picture.
constexpr double kFarAway = 0.5;

/// What stays free of the scene, in font sizes: all around, above it for a heading, and below it
/// for a caption of two lines.
constexpr double kFrameMargin = 2.1;
constexpr double kHeadingMargin = 3.75;
constexpr double kCaptionMargin = 4.6;
constexpr double kMostMargin = 0.25;  ///< of the image's height

/// Of a frame's sides these shares stay, whatever is drawn: for captions and headings.
constexpr double kNarrowest = 0.75;
constexpr double kLowest = 0.35;

constexpr int kMaxSupersampling = 4;

/// Of the object where it was: its near side, its lines.
constexpr double kGhostOpacity = 0.14;
constexpr double kGhostLineOpacity = 0.55;

/// So many frames of a hand, evenly taken from all, say from where it is seen.
constexpr std::size_t kMostViewed = 12;

/// The clusters' meshes come next, one a colour, and then those of the hand's links.
enum Mesh { kOutsideMesh, kInsideMesh, kConeMesh, kArrowMesh, kClusterMesh };

void CheckOptions(const FrameOptions& options) {
  const auto good = [](int side) { return side >= kMinFrameSide && side <= kMaxFrameSide; };
  if (!good(options.width) || !good(options.height) || options.supersampling < 1 ||
      options.supersampling > kMaxSupersampling) {
    throw std::invalid_argument("FrameRenderer: image size or supersampling out of range");
  }
}

/// The surface's triangles, those of one colour a mesh.
std::vector<FacetMesh> MakeClusterMeshes(const FacetMesh& surface,
                                         const roadmap::ClusterView& clusters) {
  std::vector<FacetMesh> meshes(roadmap::kClusterColors);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    FacetMesh& mesh = meshes[clusters.color_of_triangle[i]];
    mesh.triangles.push_back(surface.triangles[i]);
    mesh.normals.push_back(surface.normals[i]);
  }
  return meshes;
}

std::vector<FacetMesh> MakeMeshes(const BodyShape& body, bool planar, double half_angle,
                                  const std::optional<roadmap::ClusterView>& clusters) {
  std::vector<FacetMesh> meshes = {
      body.surface, TurnInsideOut(body.surface),
      planar ? MakeWedge(half_angle, kConeLength) : MakeCone(half_angle, kConeLength),
      MakeCone(kArrowHeadHalfAngle, kArrowHeadLength)};
  if (clusters) {
    for (FacetMesh& mesh : MakeClusterMeshes(body.surface, *clusters)) {
      meshes.push_back(std::move(mesh));
    }
  }
  return meshes;
}

/// Those of a hand come last.
std::vector<FacetMesh> WithHand(std::vector<FacetMesh> meshes, const HandView* hand,
                                const PictureFrame& frame) {
  if (hand == nullptr) return meshes;
  for (FacetMesh& mesh : MakeHandMeshes(*hand, frame)) meshes.push_back(std::move(mesh));
  return meshes;
}

/// Turns the friction cones, which are flat in the plane, about their axes into the plane.
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
  Impl(const object::Object& object, double scale, double half_angle,
       const std::vector<plan::Snapshot>& snapshots, const FrameOptions& options)
      : options_(options),
        object_(object),
        scale_(scale),
        half_angle_(half_angle),
        body_(MakeBodyShape(object, options.body)),
        frame_{scale * object.diameter(), scale * object.mass_properties().centroid},
        planar_(object.dimension() == 2),
        hand_(options.hand ? std::make_shared<const HandFigure>(*options.hand, frame_) : nullptr),
        meshes_(MakeMeshes(body_, planar_, half_angle, options.clusters)),
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
    const std::vector<Vector3d> turn = AddBefore(snapshot, fault, camera, drawing);
    if (options_.show_focus) AddFocus(snapshot, drawing.shapes);
    if (options_.clusters) AddRepresentatives(snapshot, drawing.shapes);
    const auto draw = [&](Color paper) {
      const CairoImage page(canvas_.Draw(camera, drawing, paper));
      DrawRings(page, camera, fingers, style_);
      std::vector<Obstacle> covered = DrawCaption(page, camera, caption, frame_.diameter_m, style_);
      const auto cover = [&covered](const std::vector<Obstacle>& more) {
        covered.insert(covered.end(), more.begin(), more.end());
      };
      cover(ObstaclesOf(camera, turn));
      if (fault != nullptr) {
        cover(DrawFaultMarks(page, camera, frame_, body_, fingers, *fault, style_));
      }
      if (options_.gaps == GapView::kNone) {
        for (const AlignInset& inset : PlaceInsets(camera, fingers, covered, style_)) {
          const Drawing body = DrawBody(pose, inset.camera, inset.magnification);
          cover(DrawInset(page, inset, canvas_.Draw(inset.camera, body, paper), style_));
        }
      }
      DrawNumbers(page, camera, fingers, covered, style_);
      return page.ToImage();
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

  /// The object where it was before it moved in the hand, and how it turned; not where a fault has
  /// a ghost of its own.
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
    const auto turn = TurnArrow(body_.surface, before, after, camera.axes.col(2));
    if (!turn.empty()) AddTurnArrow(turn, kArrowMesh, style_.ground.turn, drawing.shapes);
    return turn;
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

  /// The body is translucent in two layers, its far side and its near side: what it hides, edges
  /// too, comes out paler by itself.
  /// @param magnification  that its lines do not share.
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
      shapes.push_back({Ball{frame_.FromWorld(snapshot.X_WO * (scale_ * p)), kRepresentativeRadius},
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

  /// The contacts of the fingers that hold, where they are planned, on the object.
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
    const auto view = polyhedron::DescribeFocus(*solid, grasp, half_angle_);
    if (!view) return;
    const auto place = [&](const Vector3d& p) {
      return frame_.FromWorld(snapshot.X_WO * (scale_ * p));
    };
    shapes.push_back({Ball{place(view->focus), kFocusRadius}, kFocus});
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

  /// All that is drawn of a sequence.
  struct Sequence {
    std::vector<std::vector<FingerGlyph>> frames = {};  ///< none of what is far away
    std::vector<Eigen::Isometry3d> poses = {Eigen::Isometry3d::Identity()};
    std::vector<Standing> standing = {};  ///< of plans for a hand
    std::vector<Vector3d> hands = {};     ///< points that bound them
  };

  [[nodiscard]] Sequence SequenceOf(const std::vector<plan::Snapshot>& snapshots) const {
    Sequence all;
    for (const plan::Snapshot& snapshot : snapshots) {
      all.frames.emplace_back();
      if (hand_) all.standing.emplace_back();
      const Eigen::Isometry3d pose = frame_.BodyPose(snapshot.X_WO);
      if (!IsNear(pose)) continue;
      all.poses.push_back(pose);
      if (snapshot.X_WO_before) all.poses.push_back(frame_.BodyPose(*snapshot.X_WO_before));
      if (hand_) {
        all.standing.back() = {pose.inverse(), hand_->Rays(snapshot)};
        const std::vector<Vector3d> bounds = hand_->Bounds(snapshot);
        all.hands.insert(all.hands.end(), bounds.begin(), bounds.end());
      }
      all.frames.back() =
          MakeFingerGlyphs(snapshot, frame_, body_.rays, {GapView::kNone, FingerRadius()});
    }
    return all;
  }

  /// Points whose pictures bound that of a sequence.
  [[nodiscard]] std::vector<Vector3d> ExtentOf(const Sequence& all,
                                               const Eigen::Matrix3d& axes) const {
    Extent extent(axes, meshes_);
    for (const Eigen::Isometry3d& pose : all.poses) extent.Add(MeshInstance{kOutsideMesh, pose});
    for (const std::vector<FingerGlyph>& fingers : all.frames) {
      for (const Shape& shape : FingerShapes(fingers)) extent.Add(shape.form);
      for (const FingerGlyph& glyph : fingers) {
        extent.Add(Ball{glyph.end + glyph.outward * kLabelSpace, kLabelSpace / 2});
      }
    }
    for (const Vector3d& p : all.hands) extent.Add(Ball{p, 0});
    for (const Vector3d& p_W : options_.reached) extent.Add(Ball{frame_.FromWorld(p_W), 0});
    for (const Vector3d& p_W : options_.also_seen) {
      const Vector3d p = frame_.FromWorld(p_W);
      if (p.norm() < kFarMark) extent.Add(Ball{p, kLabelSpace / 2});
    }
    return extent.points();
  }

  /// Of most frames, and of those that have one of their own, by their index.
  struct Cameras {
    Camera common;
    std::map<int, Camera> own = {};
  };

  /// The margins are as many pixels whatever the height.
  [[nodiscard]] Camera FitTo(const std::vector<Vector3d>& points, const Vector3d& back, int width,
                             int height) const {
    Margins margins = MarginsFor(options_);
    for (double* margin : {&margins.side, &margins.top, &margins.bottom}) {
      *margin *= static_cast<double>(options_.height) / height;
    }
    const Projection usual = planar_ ? Projection::kOrthographic : Projection::kPerspective;
    return FitCamera(CameraAxes(back), options_.view.projection.value_or(usual), width, height,
                     margins, points);
  }

  /// Through a hand's plan the palm stays where it is, seen from one place.
  [[nodiscard]] Viewpoints ViewpointsOf(const Sequence& all) const {
    if (all.standing.empty()) {
      return ChooseViewpoints(body_, planar_, all.frames, largest_force_);
    }
    const std::size_t stride = 1 + (all.frames.size() - 1) / kMostViewed;
    std::vector<std::vector<FingerGlyph>> frames;
    std::vector<Standing> standing;
    for (std::size_t i = 0; i < all.frames.size(); i += stride) {
      frames.push_back(all.frames[i]);
      standing.push_back(all.standing[i]);
    }
    return {ChooseViewpoints(body_, planar_, frames, largest_force_, standing).common, {}};
  }

  /// Cameras that see all that is drawn.
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
  double half_angle_;
  BodyShape body_;
  PictureFrame frame_;
  bool planar_;
  std::shared_ptr<const HandFigure> hand_;  ///< none without a hand; copies have the same
  std::vector<FacetMesh> meshes_;           ///< without the hand's
  double largest_force_;
  TextStyle style_;
  Cameras cameras_;
  Canvas canvas_;
};

FrameRenderer::FrameRenderer(const object::Object& object, double scale, double half_angle,
                             const std::vector<plan::Snapshot>& snapshots,
                             const FrameOptions& options) {
  CheckOptions(options);
  impl_ = std::make_unique<Impl>(object, scale, half_angle, snapshots, options);
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
