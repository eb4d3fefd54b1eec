#include "render/frames/frame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "planner/sets/polyhedron/face_part.h"
#include "render/frames/annotation.h"
#include "render/frames/canvas.h"
#include "render/frames/fault_marks.h"
#include "render/frames/frame_model.h"
#include "render/frames/sequence_cameras.h"
#include "render/frames/step_scene.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {

namespace {

using Eigen::Vector3d;

/// Number of edges above which they are drawn thinner, because the edges of a fine mesh would cover
/// it.
constexpr double kManyEdges = 150;

/// Radius of cluster representatives, in diameters.
constexpr double kRepresentativeRadius = 0.005;
/// Opacity of the near surface if it shows clusters.
constexpr double kClusterOpacity = 0.85;

/// Size of the details of links that an animation omits, pixels.
constexpr double kLinkDetail = 1.2;

/// Distance of the eye of an orthographic camera, in diameters.
constexpr double kFarEye = 1e4;

/// Opacity of fingers behind an opaque object.
constexpr double kXray = 0.6;
/// Opacity of the near surface, and of the far surface behind it.
constexpr double kOutsideOpacity = 0.33;
constexpr double kInsideOpacity = 0.30;
/// Opacity of a prism. Fingers and cones are on its top, so its lower part only indicates depth.
constexpr double kPrismOpacity = 0.9;
/// Pale colour of an opaque object, on which fingers behind it are visible.
constexpr Color kOpaqueBody = {200, 214, 236};
constexpr Color kPrism = {205, 221, 241};

/// Radii of the focus point, the lines to it and the outlines of contact regions, in diameters.
constexpr double kFocusRadius = 0.014;
constexpr double kFocusLineRadius = 0.0020;
constexpr double kRegionLineRadius = 0.0030;
constexpr Color kFocus = {150, 30, 90};
constexpr Color kBlack = {0, 0, 0};

/// Largest distance of a replayed contact from its planned face, in diameters.
constexpr double kFocusReach = 1e-2;

constexpr int kMaxSupersampling = 4;

/// Opacity of the near side and the lines of the ghost.
constexpr double kGhostOpacity = 0.14;
constexpr double kGhostLineOpacity = 0.55;

void CheckOptions(const FrameOptions& options) {
  const auto good = [](int side) { return side >= kMinFrameSide && side <= kMaxFrameSide; };
  if (!good(options.width) || !good(options.height) || options.supersampling < 1 ||
      options.supersampling > kMaxSupersampling) {
    throw std::invalid_argument(
        "FrameRenderer: image size and supersampling must be within their limits");
  }
}

void PaintRed(const std::vector<FingerIndex>& at_fault, std::vector<FingerGlyph>& fingers) {
  for (FingerGlyph& glyph : fingers) {
    if (std::ranges::find(at_fault, glyph.finger) != at_fault.end()) glyph.color = kFaultRed;
  }
}

}  // namespace

class FrameRenderer::Impl {
 public:
  Impl(const object::Object& object, double scale, double friction_angle,
       const std::vector<plan::Snapshot>& snapshots, const FrameOptions& options)
      : model_(object, scale, friction_angle, snapshots, options),
        style_{FontSize(options.width, options.height), GroundOf(options.background)},
        cameras_(MakeCameras(model_, snapshots)),
        canvas_(model_.CanvasMeshes(LinkDetail(), LinkEyes()), width(), height(),
                options.supersampling) {}

  [[nodiscard]] int width() const { return cameras_.common.width; }
  [[nodiscard]] int height() const { return cameras_.common.height; }
  [[nodiscard]] bool HasOwnView(int index) const { return cameras_.own.contains(index); }

  std::vector<Image> Render(const plan::Snapshot& snapshot, std::span<const FrameText> texts,
                            const FaultMarks* fault, int view) {
    const Camera& camera = HasOwnView(view) ? cameras_.own.at(view) : cameras_.common;
    std::vector<FingerGlyph> fingers = model_.GlyphsOf(snapshot, model_.options.animated);
    for (FingerGlyph& glyph : fingers) glyph.force_color = style_.ground.force;
    if (fault != nullptr) PaintRed(fault->fingers, fingers);
    Drawing drawing = DrawBody(model_.frame.BodyPose(snapshot.X_WO), camera);
    for (Shape& shape : model_.FingerShapes(fingers)) drawing.shapes.push_back(std::move(shape));
    if (!snapshot.links_W.empty() && model_.hand) {
      drawing.veil = HandOf(snapshot, fingers, fault, camera);
    }
    const std::vector<Vector3d> arrow = AddBefore(snapshot, fault, camera, drawing);
    if (model_.options.show_focus) AddFocus(snapshot, drawing.shapes);
    if (model_.options.clusters) AddRepresentatives(snapshot, drawing.shapes);
    const auto draw = [&](Color paper) {
      const Image drawn = canvas_.Draw(camera, drawing, paper);
      std::vector<Image> images;
      for (const FrameText& text : texts) {
        const CairoImage image(drawn);
        Annotate(image, camera, snapshot, fingers, arrow, text, fault, paper);
        images.push_back(image.ToImage());
      }
      return images;
    };
    if (model_.options.background != Background::kTransparent) return draw(style_.ground.paper);
    std::vector<Image> images;
    const std::vector<Image> on_white = draw(kWhite), on_black = draw(kBlack);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      images.push_back(MakeTransparent(on_white[i], on_black[i]));
    }
    return images;
  }

 private:
  /// Return the size of the details of links that are omitted, in diameters; 0 unless the frames
  /// are those of an animation. The reduction of the meshes takes longer than one frame.
  [[nodiscard]] double LinkDetail() const {
    if (!model_.options.animated) return 0;
    return kLinkDetail / cameras_.common.PixelsPerUnit(Vector3d::Zero());
  }

  /// Return the positions of the eye relative to each link, in all frames; empty if the poses of
  /// the links are not known.
  [[nodiscard]] std::vector<std::vector<Vector3d>> LinkEyes() const {
    if (!model_.options.animated || !model_.hand || model_.options.links_W.empty()) return {};
    const Camera& camera = cameras_.common;
    const bool perspective = camera.projection == Projection::kPerspective;
    const Vector3d eye = perspective ? camera.position : Vector3d(kFarEye * camera.axes.col(2));
    std::vector<std::vector<Vector3d>> eyes(model_.options.hand->size());
    for (const std::vector<Eigen::Isometry3d>& links_W : model_.options.links_W) {
      for (std::size_t i = 0; i < links_W.size(); ++i) {
        Eigen::Isometry3d pose = links_W[i];
        pose.translation() = model_.frame.FromWorld(pose.translation());
        eyes[i].emplace_back(pose.inverse() * eye);
      }
    }
    return eyes;
  }

  /// Draw rings, texts, marks and insets.
  void Annotate(const CairoImage& image, const Camera& camera, const plan::Snapshot& snapshot,
                const std::vector<FingerGlyph>& fingers, const std::vector<Vector3d>& arrow,
                const FrameText& text, const FaultMarks* fault, Color paper) {
    TextStyle style = style_;
    style.font *= text.size;
    DrawRings(image, camera, fingers, style);
    // The heading of a fault has the place of the progress.
    const bool has_heading = fault != nullptr;
    const std::string more = has_heading && !text.progress.empty() ? " · " + text.progress : "";
    std::vector<Obstacle> covered =
        DrawCaption(image, camera, text.caption + more, model_.frame.diameter_m, style);
    const auto cover = [&covered](const std::vector<Obstacle>& more) {
      covered.insert(covered.end(), more.begin(), more.end());
    };
    if (!has_heading) cover(DrawProgress(image, camera, text.progress, style));
    cover(ObstaclesOf(camera, arrow));
    if (fault != nullptr) {
      FaultMarks marks = *fault;
      if (text.is_on_page) marks.heading.clear();
      cover(DrawFaultMarks(image, camera, model_.frame, model_.body, fingers, marks, style));
    }
    if (!model_.options.animated) {
      const Eigen::Isometry3d pose = model_.frame.BodyPose(snapshot.X_WO);
      for (const AlignInset& inset : PlaceInsets(camera, fingers, covered, style)) {
        const Drawing body = DrawBody(pose, inset.camera, inset.magnification);
        cover(DrawInset(image, inset, canvas_.Draw(inset.camera, body, paper), style));
      }
    }
    DrawNumbers(image, camera, fingers, model_.options.finger_names, covered, style);
  }

  [[nodiscard]] Veil HandOf(const plan::Snapshot& snapshot, std::span<const FingerGlyph> fingers,
                            const FaultMarks* fault, const Camera& camera) const {
    const std::vector<plan::HandLink> none;
    const auto first_mesh = static_cast<int>(model_.meshes.size());
    return {model_.hand->Shapes(snapshot, fault != nullptr ? fault->links : none, first_mesh),
            model_.hand->Rims(snapshot, /*in_contact=*/false, first_mesh),
            {{kOutsideMesh, model_.frame.BodyPose(snapshot.X_WO)}},
            model_.hand->Windows(snapshot, fingers, camera),
            model_.hand->Rims(snapshot, /*in_contact=*/true, first_mesh)};
  }

  /// Draw the pose before an in-hand motion and an arrow of the rotation, unless a fault has its
  /// own ghost.
  std::vector<Vector3d> AddBefore(const plan::Snapshot& snapshot, const FaultMarks* fault,
                                  const Camera& camera, Drawing& drawing) const {
    if (!snapshot.X_WO_before || (fault != nullptr && fault->X_WO_before)) return {};
    const Eigen::Isometry3d before = model_.frame.BodyPose(*snapshot.X_WO_before);
    const Eigen::Isometry3d after = model_.frame.BodyPose(snapshot.X_WO);
    if (!model_.opaque()) {
      drawing.layers.insert(drawing.layers.begin(),
                            {{{MeshInstance{kOutsideMesh, before}, kBefore}}, kGhostOpacity});
    }
    std::vector<Shape>& lines = model_.opaque() ? drawing.solid->shapes : drawing.shapes;
    const std::size_t first = lines.size();
    AddLines(model_.body.edges, before, 1, lines);
    AddOutline(before, camera, 1, lines);
    for (std::size_t i = first; i < lines.size(); ++i) {
      lines[i].color = kBefore;
      lines[i].opacity = kGhostLineOpacity;
    }
    const auto arrow = RotationArrow(model_.body.surface, before, after, camera.axes.col(2));
    if (!arrow.empty()) AddRotationArrow(arrow, kArrowMesh, style_.ground.rotation, drawing.shapes);
    return arrow;
  }

  /// Draw the object: opaque, or as two translucent layers, its far and its near side. Hidden parts
  /// and edges thereby become paler.
  /// @param magnification  magnification of the camera; line widths do not scale with it.
  [[nodiscard]] Drawing DrawBody(const Eigen::Isometry3d& pose, const Camera& camera,
                                 double magnification = 1) const {
    Drawing drawing;
    if (model_.opaque()) {
      drawing.solid = Solid{NearSurface(pose), kXray};
      AddLines(model_.body.edges, pose, magnification, drawing.solid->shapes);
      AddContour(pose, camera, magnification, drawing.solid->shapes);
      return drawing;
    }
    AddLines(model_.body.edges, pose, magnification, drawing.shapes);
    drawing.layers = {{{{MeshInstance{kInsideMesh, pose}, kBodyInside}}, kInsideOpacity},
                      {NearSurface(pose), NearOpacity()}};
    drawing.hiding = {{kOutsideMesh, pose}};
    AddContour(pose, camera, magnification, drawing.outline);
    return drawing;
  }

  [[nodiscard]] std::vector<Shape> NearSurface(const Eigen::Isometry3d& pose) const {
    if (!model_.options.clusters) {
      return {{MeshInstance{kOutsideMesh, pose}, SurfaceColor()}};
    }
    std::vector<Shape> shapes;
    for (int color = 0; color < roadmap::kClusterColors; ++color) {
      shapes.push_back({MeshInstance{kClusterMesh + color, pose}, kClusterPalette[color]});
    }
    return shapes;
  }

  [[nodiscard]] Color SurfaceColor() const {
    if (model_.planar) return kPrism;
    return model_.opaque() ? kOpaqueBody : kBodyOutside;
  }

  [[nodiscard]] double NearOpacity() const {
    if (model_.planar) return kPrismOpacity;
    return model_.options.clusters ? kClusterOpacity : kOutsideOpacity;
  }

  void AddRepresentatives(const plan::Snapshot& snapshot, std::vector<Shape>& shapes) const {
    for (const Vector3d& p : model_.options.clusters->representatives) {
      shapes.push_back({Sphere{model_.frame.FromWorld(snapshot.X_WO * (model_.scale * p)),
                               kRepresentativeRadius},
                        style_.ground.ink});
    }
  }

  /// Add the outline: the rim of the shell of a scan, or folds. A magnified rim would be too wide.
  void AddContour(const Eigen::Isometry3d& pose, const Camera& camera, double magnification,
                  std::vector<Shape>& shapes) const {
    if (model_.body.shell.triangles.empty() || magnification != 1) {
      AddOutline(pose, camera, magnification, shapes);
    } else {
      shapes.push_back({MeshInstance{kShellMesh, pose}, style_.ground.ink});
    }
  }

  void AddOutline(const Eigen::Isometry3d& pose, const Camera& camera, double magnification,
                  std::vector<Shape>& shapes) const {
    const auto to_eye = [&](const Vector3d& p) -> Vector3d {
      return pose.linear().transpose() * camera.ToEye(pose * p);
    };
    AddLines(FindOutline(model_.body, to_eye), pose, magnification, shapes);
  }

  void AddLines(const std::vector<std::array<Vector3d, 2>>& lines, const Eigen::Isometry3d& pose,
                double magnification, std::vector<Shape>& shapes) const {
    const auto edges = static_cast<double>(model_.body.edges.size());
    const double radius =
        kEdgeWidth / 2 * std::min(1.0, std::sqrt(kManyEdges / edges)) / magnification;
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
      grasp::Contact contact = {X_OW * finger.contact_W / model_.scale,
                                X_OW.linear() * finger.normal_W};
      double most = -1;
      for (const FaceIndex face :
           model_.object.FacesNear(contact.p, kFocusReach * model_.object.diameter())) {
        const double along = model_.object.inward_normal(face).dot(contact.n);
        if (along <= most) continue;
        most = along;
        contact.face = face;
      }
      if (!contact.face.valid()) return {};
      contact.p = model_.object.ClosestPoint(contact.face, contact.p);
      grasp.push_back(contact);
    }
    return grasp;
  }

  void AddFocus(const plan::Snapshot& snapshot, std::vector<Shape>& shapes) const {
    const auto* solid = dynamic_cast<const object::Polyhedron*>(&model_.object);
    if (solid == nullptr) return;
    const grasp::Grasp grasp = HeldGrasp(snapshot);
    const auto view = polyhedron::DescribeFocus(*solid, grasp, model_.friction_angle);
    if (!view) return;
    const auto place = [&](const Vector3d& p) {
      return model_.frame.FromWorld(snapshot.X_WO * (model_.scale * p));
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

  FrameModel model_;
  TextStyle style_;
  SequenceCameras cameras_;
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

Image FrameRenderer::Render(const plan::Snapshot& snapshot, const FrameText& text,
                            const FaultMarks* fault, int view) {
  return std::move(impl_->Render(snapshot, {&text, 1}, fault, view).front());
}

std::vector<Image> FrameRenderer::RenderWithTexts(const plan::Snapshot& snapshot,
                                                  std::span<const FrameText> texts,
                                                  const FaultMarks* fault, int view) {
  return impl_->Render(snapshot, texts, fault, view);
}

}  // namespace regrasp::render
