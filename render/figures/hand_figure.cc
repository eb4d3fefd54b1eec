#include "render/figures/hand_figure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "render/figures/figure_page.h"
#include "render/figures/plan_figure.h"
#include "render/figures/region_lines.h"
#include "render/figures/solid_painter.h"
#include "render/figures/surface_buffer.h"
#include "render/frames/object_tint.h"
#include "render/frames/sequence_cameras.h"
#include "render/frames/step_scene.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Number of samples across the image of the hand: 0.15 points in a column of a journal.
constexpr int kSamplesAcross = 1600;
/// Size of the image for which the camera is chosen. Its margins are in proportion.
constexpr int kViewWidth = 1280, kViewHeight = 960;

/// Margin above and below everything that is drawn, per width.
constexpr double kMarginPerWidth = 0.03;

constexpr int kSolidLabel = 0;
constexpr int kFirstLink = 1;

/// Distance by which a link counts as nearer per preceding joint, in diameters. Links overlap at
/// joints with nearly the same surface, and the border between them would be ragged.
constexpr double kLiftPerJoint = 8e-3;
/// Differences of depths between neighbouring samples, in diameters: at an outline, at a thin line,
/// and at an outline behind the solid, where details would confuse.
constexpr double kDepthStep = 0.12;
constexpr double kThinDepthStep = 0.025;
constexpr double kHiddenDepthStep = 0.25;
/// Total length of the shortest drawn lines, and size of the smallest areas, in samples.
constexpr double kShortestOutline = 60;
constexpr double kShortestCrease = 160;
constexpr double kShortestHidden = 120;
constexpr double kSmallestArea = 12;
/// Tolerance of printed lines, and length of the shortest inner line, points.
constexpr double kPrintTolerance = 0.15;
constexpr double kShortestInPrint = 2;

// Colours of the hand, and share of the finger's colour in a fingertip in contact.
constexpr Color kHandFill = {237, 233, 226};
constexpr Color kHandLine = {92, 88, 84};
constexpr Color kHandCrease = {138, 133, 126};
constexpr Color kHiddenHandLine = {150, 146, 140};
constexpr double kFingertipTint = 0.3;
/// Distance from the border of the panel at which a cut hand begins to fade, per width or height.
constexpr double kFade = 0.14;
/// Opacity of the hand, through which the object is visible.
constexpr double kHandFillOpacity = 0.84;

// Widths of lines and lengths of dashes, points.
constexpr double kHandOutline = 0.55;
constexpr double kHandCreaseWidth = 0.3;
constexpr double kHiddenHandOutline = 0.35;
constexpr double kHiddenHandDash = 1.3;
constexpr double kTurnArrow = 1.3;
constexpr double kTurnWeight = 1;

FrameOptions OptionsOf(const FigureHand& hand, const SolidFigureOptions& options) {
  FrameOptions frame;
  frame.width = kViewWidth;
  frame.height = kViewHeight;
  frame.body = options.body;
  frame.view = {options.view, Projection::kOrthographic};
  frame.finger_names = hand.finger_names;
  frame.crop = true;
  frame.hand = hand.view;
  return frame;
}

Color Blended(Color a, Color b, double share) {
  const auto mix = [share](int x, int y) {
    return static_cast<unsigned char>(std::lround((1 - share) * x + share * y));
  };
  return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b)};
}

/// Return the fill colour of a link.
Color FillOf(const HandLinkView& link, const plan::Snapshot& snapshot) {
  const auto finger =
      std::ranges::find(snapshot.fingers, link.link.finger, &plan::FingerState::finger);
  const bool touches = finger != snapshot.fingers.end() &&
                       finger->role != plan::FingerRole::kFree &&
                       finger->role != plan::FingerRole::kReleased;
  if (!touches || !link.is_fingertip) return kHandFill;
  return Blended(kHandFill, FingerColor(link.link.finger), kFingertipTint);
}

/// A glyph in the frame of the object.
FingerGlyph InBody(FingerGlyph glyph, const Isometry3d& to_body) {
  for (Vector3d* p : {&glyph.contact, &glyph.fingertip, &glyph.stem_end, &glyph.end}) {
    *p = to_body * *p;
  }
  for (Vector3d& p : glyph.path) p = to_body * p;
  glyph.outward = to_body.linear() * glyph.outward;
  return glyph;
}

bool IsLink(int label) { return label >= kFirstLink; }

/// Return whether an outline is that of a link in front.
bool IsOutlineOfHand(const SurfaceBuffer& all, double step, int x, int y, int x2, int y2) {
  const bool second = all.DepthAt(x2, y2) > all.DepthAt(x, y);
  if (!IsLink(second ? all.LabelAt(x2, y2) : all.LabelAt(x, y))) return false;
  const int behind = second ? all.LabelAt(x, y) : all.LabelAt(x2, y2);
  return behind == kSolidLabel || IsOutline(all, step, x, y, x2, y2);
}

/// Return whether the surface of the hand bends sharply between two samples.
bool IsCreaseOfHand(const SurfaceBuffer& all, float least_cosine, int x, int y, int x2, int y2) {
  return IsLink(all.LabelAt(x, y)) && all.LabelAt(x, y) == all.LabelAt(x2, y2) &&
         all.NormalAt(x, y).dot(all.NormalAt(x2, y2)) < least_cosine;
}

void StrokeLines(cairo_t* cr, const std::vector<Polyline>& lines, double width) {
  cairo_new_path(cr);
  for (const Polyline& line : lines) {
    cairo_new_sub_path(cr);
    for (const Vector2d& p : line) cairo_line_to(cr, p.x(), p.y());
  }
  cairo_set_line_width(cr, width);
  cairo_stroke(cr);
}

std::vector<Polyline> Scaled(std::vector<Polyline> lines, double scale) {
  for (Polyline& line : lines) {
    for (Vector2d& p : line) p *= scale;
  }
  return lines;
}

/// Scale lines to points, and omit details that are invisible at this size: points of lines, and
/// lines that are shorter than `shortest` points.
std::vector<Polyline> ForPrint(const std::vector<Polyline>& lines, double scale,
                               double shortest = 0) {
  std::vector<Polyline> printed;
  for (const Polyline& line : Scaled(lines, scale)) {
    Eigen::AlignedBox2d box;
    for (const Vector2d& p : line) box.extend(p);
    if (box.isEmpty() || box.sizes().maxCoeff() < shortest) continue;
    printed.push_back(Simplified(line, kPrintTolerance));
  }
  return printed;
}

}  // namespace

/// Colours that fade out towards sides of the panel that cut the hand. If sides of both directions
/// cut it, they fade out towards the ellipse in the panel.
class HandPanels::Fade {
 public:
  /// @param image  the panel without its caption and scale bar, points.
  Fade(const Cuts& cuts, const Eigen::AlignedBox2d& image) : cuts_(cuts), image_(image) {}

  void SetColor(cairo_t* cr, Color color, double opacity = 1) const {
    const bool across = cuts_.left || cuts_.right, along = cuts_.top || cuts_.bottom;
    if (!across && !along) return render::SetColor(cr, color, opacity);
    // The image is the square from −1 to 1 here.
    cairo_pattern_t* pattern = across && along ? cairo_pattern_create_radial(0, 0, 0, 0, 0, 1)
                               : across        ? cairo_pattern_create_linear(-1, 0, 1, 0)
                                               : cairo_pattern_create_linear(0, -1, 0, 1);
    const Vector2d middle = image_.center(), half = image_.sizes() / 2;
    cairo_matrix_t matrix;
    cairo_matrix_init(&matrix, 1 / half.x(), 0, 0, 1 / half.y(), -middle.x() / half.x(),
                      -middle.y() / half.y());
    cairo_pattern_set_matrix(pattern, &matrix);
    const auto add = [&](double at, double share) {
      constexpr double kMax = 255;
      cairo_pattern_add_color_stop_rgba(pattern, at, color.r / kMax, color.g / kMax, color.b / kMax,
                                        share * opacity);
    };
    if (across && along) {
      add(1 - 2 * kFade, 1);
      add(1, 0);
    } else {
      add(0, cuts_.left || cuts_.top ? 0 : 1);
      add(kFade, 1);
      add(1 - kFade, 1);
      add(1, cuts_.right || cuts_.bottom ? 0 : 1);
    }
    cairo_set_source(cr, pattern);
    cairo_pattern_destroy(pattern);
  }

 private:
  const Cuts& cuts_;
  Eigen::AlignedBox2d image_;
};

/// Lines and areas in pixels of the camera.
struct HandPanels::Drawing {
  std::vector<std::pair<Color, std::vector<Polyline>>> fills;
  std::vector<Polyline> outlines, creases, hidden;

  void Fill(cairo_t* cr, double scale, const Fade& fade) const {
    cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
    for (const auto& [color, areas] : fills) {
      cairo_new_path(cr);
      for (const Polyline& area : ForPrint(areas, scale)) AddOutline(cr, area);
      fade.SetColor(cr, color, kHandFillOpacity);
      cairo_fill(cr);
    }
  }
  void Stroke(cairo_t* cr, double scale, const Fade& fade) const {
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    fade.SetColor(cr, kHiddenHandLine);
    cairo_set_dash(cr, &kHiddenHandDash, 1, 0);
    StrokeLines(cr, ForPrint(hidden, scale, kShortestInPrint), kHiddenHandOutline);
    cairo_set_dash(cr, nullptr, 0, 0);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    fade.SetColor(cr, kHandCrease);
    StrokeLines(cr, ForPrint(creases, scale, kShortestInPrint), kHandCreaseWidth);
    fade.SetColor(cr, kHandLine);
    StrokeLines(cr, ForPrint(outlines, scale), kHandOutline);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
  }
};

HandPanels::HandPanels(const object::Polyhedron& solid, const plan::Plan& plan,
                       const FigureHand& hand, const SolidFigureOptions& options)
    : snapshots_(hand.snapshots),
      names_(hand.finger_names),
      model_(solid, plan.scale, plan.friction_angle, snapshots_, OptionsOf(hand, options)),
      camera_(MakeCameras(model_, snapshots_).common) {
  TintByDirection(model_.body.surface);
  const std::vector<ShadedMesh> meshes = MakeLinkMeshes(*hand.view, model_.frame);
  for (plan::EntryIndex entry{0}; entry < count(); ++entry) {
    const std::string progress = hand.progress.empty() ? "" : hand.progress[entry];
    captions_.push_back(PanelLabel(entry) + " " + EntryTitle(plan, entry, names_) +
                        (progress.empty() ? "" : " (" + progress + ")"));
    drawings_.push_back(DrawingOf(snapshots_[entry], meshes, options.body.crease_angle));
  }
  ChooseRows();
}

HandPanels::~HandPanels() = default;

void HandPanels::ChooseRows() {
  Eigen::AlignedBox2d box;
  for (const plan::Snapshot& snapshot : snapshots_) {
    const Isometry3d pose = model_.frame.BodyPose(snapshot.X_WO);
    for (const auto& corners : model_.body.surface.triangles) {
      for (const Vector3d& p : corners) box.extend(camera_.Project(pose * p));
    }
    for (const FingerGlyph& glyph : model_.GlyphsOf(snapshot, /*free_fingers=*/false)) {
      box.extend(camera_.Project(glyph.end));
    }
  }
  Eigen::AlignedBox2d drawn;
  for (const Drawing& drawing : drawings_) {
    for (const auto& [color, areas] : drawing.fills) {
      for (const Polyline& area : areas) {
        for (const Vector2d& p : area) drawn.extend(p);
      }
    }
  }
  constexpr double kBorder = 1;  // camera pixels
  cuts_ = {drawn.min().x() < kBorder, drawn.max().x() > camera_.width - kBorder,
           drawn.min().y() < kBorder, drawn.max().y() > camera_.height - kBorder};
  box.extend(drawn);
  const double margin = kMarginPerWidth * camera_.width;
  top_ = std::clamp(box.min().y() - margin, 0.0, camera_.height / 2.0);
  bottom_ = std::clamp(box.max().y() + margin, camera_.height / 2.0, 1.0 * camera_.height);
}

namespace {

/// Adds posed meshes to a buffer.
class SurfacePlacer {
 public:
  /// @param per_pixel  samples per pixel of the camera.
  SurfacePlacer(const Camera& camera, double per_pixel)
      : camera_(camera),
        per_pixel_(per_pixel),
        per_unit_(per_pixel * camera.PixelsPerUnit(Vector3d::Zero())) {}

  /// Return the number of samples per diameter.
  [[nodiscard]] double per_unit() const { return per_unit_; }

  /// @param lift  distance by which the mesh counts as nearer, in diameters.
  void Add(const ShadedMesh& mesh, int label, const Isometry3d& pose, double lift,
           SurfaceBuffer& surfaces) const {
    const auto place = [&](const Vector3d& p) {
      const Vector3d seen = pose * p;
      const Vector2d at = per_pixel_ * camera_.Project(seen);
      return Vector3d(at.x(), at.y(), -per_unit_ * camera_.Depth(seen));
    };
    Eigen::Matrix3d turn = camera_.axes.transpose() * pose.linear();
    turn.row(1) *= -1;
    surfaces.Add(mesh, label, place, turn, per_unit_ * lift);
  }

 private:
  const Camera& camera_;
  double per_pixel_, per_unit_;
};

/// Add the links of a snapshot.
/// @returns their fill colours.
std::vector<Color> AddLinks(const FrameModel& model, const plan::Snapshot& snapshot,
                            const std::vector<ShadedMesh>& meshes, const SurfacePlacer& placer,
                            SurfaceBuffer& surfaces) {
  const HandView& links = *model.options.hand;
  std::vector<Color> colors;
  for (std::size_t i = 0; i < snapshot.links_W.size(); ++i) {
    Isometry3d pose = snapshot.links_W[i];
    pose.translation() = model.frame.FromWorld(pose.translation());
    placer.Add(meshes[i], kFirstLink + static_cast<int>(i), pose,
               kLiftPerJoint * links[i].link.joints, surfaces);
    colors.push_back(FillOf(links[i], snapshot));
  }
  return colors;
}

/// Return the visible areas of a hand by colour, in samples.
/// @param colors  colours of the links.
std::vector<std::pair<Color, std::vector<Polyline>>> FillsOf(const SurfaceBuffer& all,
                                                             const std::vector<Color>& colors) {
  const auto key = [](const Color& color) { return std::array{color.r, color.g, color.b}; };
  std::map<std::array<unsigned char, 3>, Color> different;
  for (const Color& color : colors) different.emplace(key(color), color);
  std::vector<std::pair<Color, std::vector<Polyline>>> fills;
  for (const auto& [wanted, color] : different) {
    fills.emplace_back(
        color,
        OutlineOf(all.width(), all.height(), kSmallestArea, [&, wanted = wanted](int x, int y) {
          const int label = all.LabelAt(x, y);
          return IsLink(label) && key(colors[label - kFirstLink]) == wanted;
        }));
  }
  return fills;
}

}  // namespace

HandPanels::Drawing HandPanels::DrawingOf(const plan::Snapshot& snapshot,
                                          const std::vector<ShadedMesh>& meshes,
                                          double crease_angle) const {
  const double per_pixel = static_cast<double>(kSamplesAcross) / camera_.width;
  const SurfacePlacer placer(camera_, per_pixel);
  SurfaceBuffer hand(kSamplesAcross, static_cast<int>(std::ceil(per_pixel * camera_.height)));
  const std::vector<Color> colors = AddLinks(model_, snapshot, meshes, placer, hand);
  SurfaceBuffer all = hand;
  hand.RemoveSpecks(kThinDepthStep * placer.per_unit());
  placer.Add(model_.body.surface, kSolidLabel, model_.frame.BodyPose(snapshot.X_WO), 0, all);
  all.RemoveSpecks(kThinDepthStep * placer.per_unit());
  const auto trace = [&](double shortest, const auto& differs) {
    SampleSides sides(all.width(), all.height());
    sides.AddBetween(differs);
    return Scaled(sides.Trace(shortest), 1 / per_pixel);
  };
  const double step = kDepthStep * placer.per_unit();
  const auto least_cosine = static_cast<float>(std::cos(crease_angle));
  Drawing drawing;
  drawing.outlines = trace(kShortestOutline, [&](int x, int y, int x2, int y2) {
    return IsOutlineOfHand(all, step, x, y, x2, y2);
  });
  const double thin_step = kThinDepthStep * placer.per_unit();
  drawing.creases = trace(kShortestCrease, [&](int x, int y, int x2, int y2) {
    return (IsCreaseOfHand(all, least_cosine, x, y, x2, y2) ||
            (all.LabelAt(x, y) == all.LabelAt(x2, y2) &&
             IsOutlineOfHand(all, thin_step, x, y, x2, y2))) &&
           !IsOutlineOfHand(all, step, x, y, x2, y2);
  });
  drawing.hidden = trace(kShortestHidden, [&](int x, int y, int x2, int y2) {
    return all.LabelAt(x, y) == kSolidLabel && all.LabelAt(x2, y2) == kSolidLabel &&
           IsOutline(hand, kHiddenDepthStep * placer.per_unit(), x, y, x2, y2);
  });
  drawing.fills = FillsOf(all, colors);
  for (auto& [color, areas] : drawing.fills) areas = Scaled(std::move(areas), 1 / per_pixel);
  return drawing;
}

double HandPanels::HeightFor(double width) const {
  return width * (bottom_ - top_) / camera_.width + kScaleBarSpace;
}

PanelCamera HandPanels::CameraOf(double width) const {
  const double per_unit = width / camera_.width * camera_.PixelsPerUnit(Vector3d::Zero());
  const Vector2d middle = (camera_.axes.transpose() * camera_.position).head<2>();
  const double scale = width / camera_.width;
  const Vector2d corner(-width / 2, scale * (camera_.height / 2.0 - top_));
  return {camera_.axes, per_unit, middle + corner / per_unit};
}

std::vector<Vector2d> HandPanels::DrawBefore(cairo_t* cr, const plan::Snapshot& snapshot,
                                             const PanelCamera& camera) const {
  if (!snapshot.X_WO_before) return {};
  const Isometry3d before = model_.frame.BodyPose(*snapshot.X_WO_before);
  const Isometry3d after = model_.frame.BodyPose(snapshot.X_WO);
  SolidPainter(cr, model_.body, camera.InFrame(before)).DrawGhost(kBefore);
  std::vector<Vector2d> arrow;
  for (const Vector3d& p : RotationArrow(model_.body.surface, before, after, camera.back())) {
    arrow.push_back(camera(p));
  }
  return arrow;
}

void HandPanels::Draw(cairo_t* cr, int index, double width, bool scale_bar) const {
  const plan::Snapshot& snapshot = snapshots_[index];
  const PanelCamera camera = CameraOf(width);
  const Isometry3d pose = model_.frame.BodyPose(snapshot.X_WO);
  std::vector<FingerGlyph> fingers = model_.GlyphsOf(snapshot, /*free_fingers=*/false);
  for (FingerGlyph& glyph : fingers) glyph = InBody(glyph, pose.inverse());
  const std::vector<Vector2d> arrow = DrawBefore(cr, snapshot, camera);
  SolidPainter painter(cr, model_.body, camera.InFrame(pose));
  painter.DrawBody();
  painter.DrawVisibleEdges();
  const double scale = width / camera_.width;
  const Fade fade(cuts_, {Vector2d(0, scale * top_), Vector2d(width, scale * bottom_)});
  cairo_save(cr);
  cairo_translate(cr, 0, -scale * top_);
  drawings_[index].Fill(cr, scale, fade);
  drawings_[index].Stroke(cr, scale, fade);
  cairo_restore(cr);
  for (const FingerGlyph& glyph : fingers) painter.DrawCone(glyph, model_.friction_angle);
  for (const FingerGlyph& glyph : fingers) painter.DrawMotion(glyph);
  std::vector<Obstacle> covered;
  for (std::size_t i = 1; i < arrow.size(); ++i) {
    covered.push_back({arrow[i - 1], arrow[i], kTurnArrow, kTurnWeight});
  }
  if (!arrow.empty()) DrawArrow(cr, arrow, kTurnArrow, kWhiteGround.rotation, kWhite);
  const std::vector<FingerMarker> markers = painter.MarkersOf(fingers);
  for (const FingerMarker& marker : markers) DrawFingerMarker(cr, marker);
  const Vector2d panel(width, HeightFor(width));
  painter.DrawNumbers(fingers, markers, panel, names_, covered);
  if (scale_bar) DrawScaleBar(cr, panel, camera.scale / model_.frame.diameter_m);
}

}  // namespace regrasp::render
