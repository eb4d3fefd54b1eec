#include "render/frames/hand_image.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "planner/base/number.h"
#include "planner/kinematics/finger_kinematics.h"
#include "planner/object/rotation.h"
#include "render/frames/annotation.h"
#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/shaded_mesh.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/caption.h"
#include "render/picture/image.h"

namespace regrasp::render {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Visuals = std::vector<kinematics::LinkVisual>;

constexpr double kLinkOpacity = 0.68;
/// Share of white in link colours: details inside black plastic would be invisible.
constexpr double kPaler = 0.45;
/// Factor on sphere radii, so that the sphere is visible in front of a link of the same shape.
constexpr double kOutside = 1.02;
/// Lengths of arrows per size of the hand.
constexpr double kArrowLength = 0.22;
constexpr double kAxisLength = 0.15;
/// Colours of the axes: x red, y green, z blue.
constexpr std::array<Color, 3> kAxisColors = {{{196, 40, 40}, {30, 130, 60}, {40, 80, 190}}};
constexpr double kArrowRadius = 0.006;
constexpr double kHandArrowHeadLength = 0.05;
constexpr double kHandArrowHeadHalfAngle = 0.35;
/// Mean direction of fingers, per finger length, above which the hand is seen from the side to
/// which fingers bend.
constexpr double kPointsOneWay = 0.35;
/// Cosines of angles that count as parallel and as perpendicular.
constexpr double kSameAxis = 0.8;
constexpr double kAcross = 1e-3;
// Lengths in multiples of the font size.
constexpr double kHandLabelRadius = 1.9;
constexpr double kSmallFont = 0.8;
constexpr double kHandLineHeight = 1.15;
constexpr double kHandHalo = 0.32;
constexpr double kRing = 0.11;
constexpr double kHandLeader = 0.09;
constexpr double kHandShade = 0.75;

/// Placement of a hand in its image: size 1, centred at the origin.
struct HandPlacement {
  Isometry3d palm = Isometry3d::Identity();  ///< pose of the palm, in image units
  double size = 1;                           ///< metres per unit
  Vector3d back = Vector3d::UnitX();         ///< direction towards the eye

  Vector3d operator()(const Vector3d& p) const { return palm * (p / size); }
};

Vector3d OriginAtZero(const kinematics::HandModel& hand, const kinematics::LinkVisual& visual) {
  Vector3d origin = Vector3d::Zero();
  if (!visual.finger.valid()) return origin;
  const auto& joints = hand.fingers[visual.finger].joints;
  for (int i = 0; i < visual.after; ++i) origin += joints[i].offset;
  return origin;
}

Vector3d FingertipAtZero(const kinematics::Finger& finger) {
  Vector3d tip = finger.tip.centre;
  for (const kinematics::Joint& joint : finger.joints) tip += joint.offset;
  return tip;
}

/// Return the palm axis perpendicular to `up` nearest to a direction, or the direction if none is
/// near.
Vector3d NearestAxis(const Vector3d& direction, const Vector3d& up) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const int sign : {-1, 1}) {
      const Vector3d candidate = sign * Vector3d::Unit(axis);
      const bool near = candidate.dot(direction) > kSameAxis * direction.norm();
      if (near && std::abs(candidate.dot(up)) < kAcross) return candidate;
    }
  }
  return direction.normalized();
}

/// Place a hand with `up` towards the eye if the fingers point across it, and upwards otherwise.
HandPlacement PlaceHand(const kinematics::HandModel& hand, const Visuals& visuals) {
  Eigen::AlignedBox3d box;
  for (const kinematics::LinkVisual& visual : visuals) {
    if (visual.above_palm) continue;
    const Vector3d origin = OriginAtZero(hand, visual);
    for (const auto& corners : visual.triangles) {
      for (const Vector3d& p : corners) box.extend(origin + p);
    }
    for (const auto& capsule : visual.capsules) {
      for (const Vector3d& end : {capsule.from, capsule.to}) {
        box.extend(Vector3d((origin + end).array() - capsule.radius));
        box.extend(Vector3d((origin + end).array() + capsule.radius));
      }
    }
  }
  Vector3d ahead = Vector3d::Zero();
  double reach = 0;
  for (const kinematics::Finger& finger : hand.fingers) {
    const Vector3d tip = FingertipAtZero(finger);
    box.extend(tip);
    ahead += tip / static_cast<double>(hand.fingers.size());
    reach = std::max(reach, tip.norm());
  }
  ahead -= ahead.dot(hand.up) * hand.up;
  const bool lies = ahead.norm() > kPointsOneWay * reach;
  const Vector3d other = hand.up.unitOrthogonal();
  const Vector3d z = lies ? NearestAxis(ahead, hand.up) : hand.up;
  const Vector3d y = lies ? Vector3d(-hand.up) : other;  // away from the eye, or arbitrary
  HandPlacement placement;
  placement.size = box.isEmpty() ? 1 : box.diagonal().norm();
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  placement.palm.linear() = axes.transpose();
  placement.palm.translation() = -(axes.transpose() * box.center()) / placement.size;
  placement.back =
      lies ? Vector3d(0.35, -1, 0.25).normalized() : Vector3d(0.45, -1, 0.8).normalized();
  return placement;
}

Color LinkColor(const std::array<float, 3>& rgba) {
  const auto channel = [&](float value) {
    const double paler = kPaler + (1 - kPaler) * std::clamp<double>(value, 0, 1);
    return static_cast<unsigned char>(std::lround(255 * paler));
  };
  return {channel(rgba[0]), channel(rgba[1]), channel(rgba[2])};
}

Color Shaded(Color color) {
  const auto shade = [](int channel) { return static_cast<unsigned char>(kHandShade * channel); };
  return {shade(color.r), shade(color.g), shade(color.b)};
}

struct HandImageScene {
  std::vector<ShadedMesh> meshes;
  Drawing drawing;
  std::vector<Vector3d> points;  ///< points that bound the scene
};

/// Add points that bound a capsule.
void AddEnds(const Capsule& capsule, std::vector<Vector3d>& points) {
  for (const Vector3d& end : {capsule.from, capsule.to}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) {
        points.push_back(end + sign * capsule.radius * Vector3d::Unit(axis));
      }
    }
  }
}

HandImageScene MakeHandScene(const kinematics::HandModel& hand, const Visuals& visuals,
                             const HandPlacement& place) {
  HandImageScene scene;
  Layer links{{}, kLinkOpacity};
  for (const kinematics::LinkVisual& visual : visuals) {
    if (visual.above_palm) continue;
    const Vector3d origin = OriginAtZero(hand, visual);
    ShadedMesh mesh;
    for (std::size_t i = 0; i < visual.triangles.size(); ++i) {
      auto corners = visual.triangles[i];
      auto normals = visual.normals[i];
      for (int k = 0; k < 3; ++k) {
        corners[k] = place(origin + corners[k]);
        normals[k] = place.palm.linear() * normals[k];
        scene.points.push_back(corners[k]);
      }
      mesh.Add(corners, normals);
    }
    for (const auto& [from, to, radius] : visual.capsules) {
      const Capsule capsule{place(origin + from), place(origin + to), radius / place.size};
      links.shapes.push_back({capsule, LinkColor(visual.color)});
      AddEnds(capsule, scene.points);
    }
    if (mesh.triangles.empty()) continue;
    links.shapes.push_back(
        {MeshInstance{static_cast<int>(scene.meshes.size())}, LinkColor(visual.color)});
    scene.meshes.push_back(std::move(mesh));
  }
  for (int i = 0; i < static_cast<int>(hand.fingers.size()); ++i) {
    const kinematics::Finger& finger = hand.fingers[i];
    const Vector3d centre = place(FingertipAtZero(finger));
    const double radius = finger.tip.radius / place.size;
    scene.drawing.shapes.push_back(
        {Sphere{centre, kOutside * radius}, FingerColor(FingerIndex(i))});
    AddEnds({centre, centre, radius}, scene.points);
  }
  scene.drawing.layers.push_back(std::move(links));
  return scene;
}

/// An arrow from the origin of the palm frame.
struct PalmArrow {
  Vector3d direction;  ///< unit vector in the palm frame
  double length;       ///< length per size of the hand
  Color color;
  std::string label;
};

/// Return the axes of the palm frame, in which object poses are given, and the direction up.
std::vector<PalmArrow> PalmArrows(const Vector3d& up) {
  std::vector<PalmArrow> arrows;
  bool is_up_drawn = false;
  for (int i = 0; i < 3; ++i) {
    const bool is_up = up.dot(Vector3d::Unit(i)) > 1 - kAcross * kAcross;
    is_up_drawn = is_up_drawn || is_up;
    arrows.push_back({Vector3d::Unit(i), is_up ? kArrowLength : kAxisLength, kAxisColors[i],
                      std::string(1, static_cast<char>('x' + i)) + (is_up ? ", up" : "")});
  }
  if (!is_up_drawn) arrows.push_back({up, kArrowLength, kInk, "up"});
  return arrows;
}

void AddArrow(const PalmArrow& arrow, const HandPlacement& place, HandImageScene& scene) {
  const Vector3d from = place(Vector3d::Zero());
  const Vector3d along = place.palm.linear() * arrow.direction;
  const Vector3d tip = from + arrow.length * along;
  const double head_length = kHandArrowHeadLength * arrow.length / kArrowLength;
  scene.drawing.shapes.push_back(
      {Capsule{from, tip - 0.9 * head_length * along, kArrowRadius}, arrow.color});
  Isometry3d head = Isometry3d::Identity();
  // The cone opens along its z axis from its apex.
  head.linear() = object::AligningRotation(Vector3d::UnitZ(), -along).toRotationMatrix();
  head.translation() = tip;
  scene.drawing.shapes.push_back(
      {MeshInstance{static_cast<int>(scene.meshes.size()), head}, arrow.color});
  scene.meshes.push_back(MakeCone(kHandArrowHeadHalfAngle, head_length));
  scene.points.push_back(tip);
}

void WriteArrowLabels(const CairoImage& image, const Camera& camera, const HandPlacement& place,
                      const std::vector<PalmArrow>& arrows, const TextStyle& style) {
  cairo_t* cr = image.context();
  const double font = kSmallFont * style.font;
  const Vector2d origin = camera.Project(place(Vector3d::Zero()));
  for (const PalmArrow& arrow : arrows) {
    const Vector3d along = place.palm.linear() * arrow.direction;
    const Vector2d tip = camera.Project(place(Vector3d::Zero()) + arrow.length * along);
    const Vector2d away = tip - origin;
    // An arrow towards the eye has its label next to it.
    const Vector2d beyond =
        away.norm() > font ? Vector2d(away.normalized()) : Vector2d(1, 1).normalized();
    SelectFont(cr, font, true);
    const Vector2d start = CentredText(cr, arrow.label, tip + 0.9 * font * beyond);
    cairo_move_to(cr, start.x(), start.y());
    cairo_text_path(cr, arrow.label.c_str());
    FillWithHalo(cr, arrow.color, kHandHalo * font, style.ground.halo);
  }
}

/// Writes name and radius next to each fingertip, away from the middle of the hand.
class FingertipLabels {
 public:
  FingertipLabels(const CairoImage& image, const Camera& camera, const TextStyle& style)
      : image_(image), camera_(camera), style_(style) {}

  void Draw(const kinematics::HandModel& hand, const HandPlacement& place,
            std::vector<Obstacle> covered) const {
    const Vector2d middle = camera_.Project(Vector3d::Zero());
    std::vector<LabelAnchor> anchors;
    std::vector<double> radii;
    for (const kinematics::Finger& finger : hand.fingers) {
      const Vector3d centre = place(FingertipAtZero(finger));
      const Vector2d at = camera_.Project(centre);
      const double radius = finger.tip.radius / place.size * camera_.PixelsPerUnit(centre);
      const Vector2d outward =
          at == middle ? Vector2d(0, -1) : Vector2d((at - middle).normalized());
      anchors.push_back({at + radius * outward, outward, at});
      radii.push_back(radius);
      covered.push_back({at, at, radius});
      // The link behind the fingertip.
      const Vector3d last = place(FingertipAtZero(finger) - finger.tip.centre);
      covered.push_back({at, camera_.Project(last), radius});
    }
    const std::vector<Vector2d> centres = PlaceLabels(
        anchors, covered, kHandLabelRadius * style_.font, camera_.width, camera_.height);
    for (std::size_t i = 0; i < centres.size(); ++i) {
      const Color color = FingerColor(FingerIndex(static_cast<int>(i)));
      DrawRing(*anchors[i].owner, radii[i], color);
      DrawLeader(*anchors[i].owner, radii[i], centres[i], Shaded(color));
      Write(hand.fingers[i], centres[i], Shaded(color));
    }
  }

 private:
  /// Draw the outline of a fingertip sphere over links that hide it.
  void DrawRing(const Vector2d& centre, double radius, Color color) const {
    SetCircle(image_.context(), centre, radius);
    Stroke(image_.context(), Shaded(color), kRing * style_.font);
  }

  void DrawLeader(const Vector2d& sphere, double radius, const Vector2d& label, Color color) const {
    const Vector2d away = label - sphere;
    const double gap = away.norm() - radius - kHandLabelRadius * style_.font;
    if (gap < 0.5 * style_.font) return;
    SetColor(image_.context(), color);
    StrokeLine(image_.context(), sphere + radius * away.normalized(),
               sphere + (radius + gap) * away.normalized(), kHandLeader * style_.font);
  }

  void Write(const kinematics::Finger& finger, const Vector2d& centre, Color color) const {
    const Vector2d half_line(0, kHandLineHeight / 2 * style_.font);
    WriteLine(finger.name, centre - half_line, style_.font, true, color);
    WriteLine(FormatFixed(1e3 * finger.tip.radius, 1) + " mm", centre + half_line,
              kSmallFont * style_.font, false, style_.ground.ink);
  }

  void WriteLine(const std::string& text, const Vector2d& centre, double font, bool bold,
                 Color color) const {
    cairo_t* cr = image_.context();
    SelectFont(cr, font, bold);
    Vector2d start = CentredText(cr, text, centre);
    const double width = TextWidth(cr, text);
    start.x() =
        std::clamp(start.x(), 0.5 * font, std::max(0.5 * font, camera_.width - width - 0.5 * font));
    cairo_move_to(cr, start.x(), start.y());
    cairo_text_path(cr, text.c_str());
    FillWithHalo(cr, color, kHandHalo * font, style_.ground.halo);
  }

  const CairoImage& image_;
  const Camera& camera_;
  const TextStyle& style_;
};

}  // namespace

Image DrawHand(const kinematics::HandModel& hand, const Visuals& visuals,
               const std::string& caption, const HandImageOptions& options) {
  const HandPlacement place = PlaceHand(hand, visuals);
  HandImageScene scene = MakeHandScene(hand, visuals, place);
  const std::vector<PalmArrow> arrows = PalmArrows(hand.up);
  for (const PalmArrow& arrow : arrows) AddArrow(arrow, place, scene);
  const TextStyle style{FontSize(options.width, options.height), kWhiteGround};
  const double font = style.font / options.height;
  const Margins margins{5 * font, 4.5 * font, 4.6 * font};
  const Eigen::Matrix3d axes = CameraAxes(place.back);
  Camera camera = FitCamera(axes, Projection::kPerspective, options.width, options.height, margins,
                            scene.points);
  camera = Crop(camera, margins, scene.points, options.width / 2, options.height / 2);
  Canvas canvas(scene.meshes, camera.width, camera.height, options.supersampling);
  const CairoImage image(canvas.Draw(camera, scene.drawing));
  const std::vector<Obstacle> covered = DrawCaption(image, camera, caption, place.size, style);
  FingertipLabels(image, camera, style).Draw(hand, place, covered);
  WriteArrowLabels(image, camera, place, arrows, style);
  return image.ToImage();
}

}  // namespace regrasp::render
