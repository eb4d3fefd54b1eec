#include "render/frames/hand_picture.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "planner/base/number.h"
#include "planner/kinematics/finger_kinematics.h"
#include "render/frames/annotation.h"
#include "render/frames/camera.h"
#include "render/frames/canvas.h"
#include "render/frames/facet_mesh.h"
#include "render/picture/cairo_paint.h"
#include "render/picture/color_table.h"
#include "render/picture/label_layout.h"

namespace regrasp::render {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Visuals = std::vector<kinematics::LinkVisual>;

constexpr double kLinkOpacity = 0.68;
/// How much of white is mixed into the links' colours: what lies in black plastic would be lost.
constexpr double kPaler = 0.45;
/// Where a link is round like the ball, the ball is seen.
constexpr double kOutside = 1.02;
/// Of arrows, in sizes of the hand.
constexpr double kArrowLength = 0.22;
constexpr double kAxisLength = 0.15;
/// x red, y green, z blue.
constexpr std::array<Color, 3> kAxisColors = {{{196, 40, 40}, {30, 130, 60}, {40, 80, 190}}};
constexpr double kArrowRadius = 0.006;
constexpr double kHandArrowHeadLength = 0.05;
constexpr double kHandArrowHeadHalfAngle = 0.35;
/// Where the fingers point this much one way, they are seen from the side to which they bend.
constexpr double kPointsOneWay = 0.35;
/// Cosines of directions that count as one, and as at right angles.
constexpr double kSameAxis = 0.8;
constexpr double kAcross = 1e-3;
// In font sizes.
constexpr double kHandLabelRadius = 1.9;
constexpr double kSmallFont = 0.8;
constexpr double kHandLineHeight = 1.15;
constexpr double kHandHalo = 0.32;
constexpr double kRing = 0.11;
constexpr double kHandLeader = 0.09;
constexpr double kHandShade = 0.75;

/// Where a hand is in its picture: of size 1 about the origin, turned as it is seen best.
struct Placing {
  Isometry3d palm = Isometry3d::Identity();  ///< its pose, in units of the picture
  double size = 1;                           ///< metres a unit
  Vector3d back = Vector3d::UnitX();         ///< towards the eye

  Vector3d operator()(const Vector3d& p) const { return palm * (p / size); }
};

Vector3d OriginAtRest(const kinematics::HandModel& hand, const kinematics::LinkVisual& look) {
  Vector3d origin = Vector3d::Zero();
  if (!look.finger.valid()) return origin;
  const auto& joints = hand.fingers[look.finger].joints;
  for (int i = 0; i < look.after; ++i) origin += joints[i].offset;
  return origin;
}

Vector3d TipAtRest(const kinematics::Finger& finger) {
  Vector3d tip = finger.tip.centre;
  for (const kinematics::Joint& joint : finger.joints) tip += joint.offset;
  return tip;
}

/// The axis of the palm across `up` that is nearest to a direction, where one is near.
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

/// Up is towards the eye where the fingers point across it, otherwise upwards.
Placing PlaceHand(const kinematics::HandModel& hand, const Visuals& visuals) {
  Eigen::AlignedBox3d box;
  for (const kinematics::LinkVisual& look : visuals) {
    if (look.above_palm) continue;
    const Vector3d origin = OriginAtRest(hand, look);
    for (const auto& corners : look.triangles) {
      for (const Vector3d& p : corners) box.extend(origin + p);
    }
    for (const auto& capsule : look.capsules) {
      for (const Vector3d& end : {capsule.from, capsule.to}) {
        box.extend(Vector3d((origin + end).array() - capsule.radius));
        box.extend(Vector3d((origin + end).array() + capsule.radius));
      }
    }
  }
  Vector3d ahead = Vector3d::Zero();
  double reach = 0;
  for (const kinematics::Finger& finger : hand.fingers) {
    const Vector3d tip = TipAtRest(finger);
    box.extend(tip);
    ahead += tip / static_cast<double>(hand.fingers.size());
    reach = std::max(reach, tip.norm());
  }
  ahead -= ahead.dot(hand.up) * hand.up;
  const bool lies = ahead.norm() > kPointsOneWay * reach;
  const Vector3d other = hand.up.unitOrthogonal();
  const Vector3d z = lies ? NearestAxis(ahead, hand.up) : hand.up;
  const Vector3d y = lies ? Vector3d(-hand.up) : other;  // away from the eye, or anywhere
  Placing placing;
  placing.size = box.isEmpty() ? 1 : box.diagonal().norm();
  Eigen::Matrix3d axes;
  axes << y.cross(z), y, z;
  placing.palm.linear() = axes.transpose();
  placing.palm.translation() = -(axes.transpose() * box.center()) / placing.size;
  placing.back =
      lies ? Vector3d(0.35, -1, 0.25).normalized() : Vector3d(0.45, -1, 0.8).normalized();
  return placing;
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

struct HandPictureScene {
  std::vector<FacetMesh> meshes;
  Drawing drawing;
  std::vector<Vector3d> points;  ///< that bound it
};

/// Points that bound a rod.
void AddEnds(const Rod& rod, std::vector<Vector3d>& points) {
  for (const Vector3d& end : {rod.from, rod.to}) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) {
        points.push_back(end + sign * rod.radius * Vector3d::Unit(axis));
      }
    }
  }
}

HandPictureScene MakeHandScene(const kinematics::HandModel& hand, const Visuals& visuals,
                               const Placing& place) {
  HandPictureScene scene;
  Layer links{{}, kLinkOpacity};
  for (const kinematics::LinkVisual& look : visuals) {
    if (look.above_palm) continue;
    const Vector3d origin = OriginAtRest(hand, look);
    FacetMesh mesh;
    for (std::size_t i = 0; i < look.triangles.size(); ++i) {
      auto corners = look.triangles[i];
      auto normals = look.normals[i];
      for (int k = 0; k < 3; ++k) {
        corners[k] = place(origin + corners[k]);
        normals[k] = place.palm.linear() * normals[k];
        scene.points.push_back(corners[k]);
      }
      mesh.Add(corners, normals);
    }
    for (const auto& [from, to, radius] : look.capsules) {
      const Rod rod{place(origin + from), place(origin + to), radius / place.size};
      links.shapes.push_back({rod, LinkColor(look.color)});
      AddEnds(rod, scene.points);
    }
    if (mesh.triangles.empty()) continue;
    links.shapes.push_back(
        {MeshInstance{static_cast<int>(scene.meshes.size())}, LinkColor(look.color)});
    scene.meshes.push_back(std::move(mesh));
  }
  for (int i = 0; i < static_cast<int>(hand.fingers.size()); ++i) {
    const kinematics::Finger& finger = hand.fingers[i];
    const Vector3d centre = place(TipAtRest(finger));
    const double radius = finger.tip.radius / place.size;
    scene.drawing.shapes.push_back({Ball{centre, kOutside * radius}, FingerColor(FingerIndex(i))});
    AddEnds({centre, centre, radius}, scene.points);
  }
  scene.drawing.layers.push_back(std::move(links));
  return scene;
}

/// An arrow from the palm's origin.
struct PalmArrow {
  Vector3d direction;  ///< of length 1, in the palm's frame
  double length;       ///< in sizes of the hand
  Color color;
  std::string label;
};

/// The axes of the palm's frame, in which poses of objects are given, and the direction up.
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

void AddArrow(const PalmArrow& arrow, const Placing& place, HandPictureScene& scene) {
  const Vector3d from = place(Vector3d::Zero());
  const Vector3d along = place.palm.linear() * arrow.direction;
  const Vector3d tip = from + arrow.length * along;
  const double head_length = kHandArrowHeadLength * arrow.length / kArrowLength;
  scene.drawing.shapes.push_back(
      {Rod{from, tip - 0.9 * head_length * along, kArrowRadius}, arrow.color});
  Isometry3d head = Isometry3d::Identity();
  // The cone opens along its z from its apex.
  head.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), -along).toRotationMatrix();
  head.translation() = tip;
  scene.drawing.shapes.push_back(
      {MeshInstance{static_cast<int>(scene.meshes.size()), head}, arrow.color});
  scene.meshes.push_back(MakeCone(kHandArrowHeadHalfAngle, head_length));
  scene.points.push_back(tip);
}

void WriteArrowLabels(const CairoImage& page, const Camera& camera, const Placing& place,
                      const std::vector<PalmArrow>& arrows, const TextStyle& style) {
  cairo_t* cr = page.context();
  const double font = kSmallFont * style.font;
  const Vector2d origin = camera.Project(place(Vector3d::Zero()));
  for (const PalmArrow& arrow : arrows) {
    const Vector3d along = place.palm.linear() * arrow.direction;
    const Vector2d tip = camera.Project(place(Vector3d::Zero()) + arrow.length * along);
    const Vector2d away = tip - origin;
    // An arrow towards the eye has its label beside it.
    const Vector2d beyond =
        away.norm() > font ? Vector2d(away.normalized()) : Vector2d(1, 1).normalized();
    SelectFont(cr, font, true);
    const Vector2d start = CentredText(cr, arrow.label, tip + 0.9 * font * beyond);
    cairo_move_to(cr, start.x(), start.y());
    cairo_text_path(cr, arrow.label.c_str());
    FillWithHalo(cr, arrow.color, kHandHalo * font, style.ground.halo);
  }
}

/// Name and radius of each ball beside it, away from the middle of the hand.
class TipLabels {
 public:
  TipLabels(const CairoImage& page, const Camera& camera, const TextStyle& style)
      : page_(page), camera_(camera), style_(style) {}

  void Draw(const kinematics::HandModel& hand, const Placing& place,
            std::vector<Obstacle> covered) const {
    const Vector2d middle = camera_.Project(Vector3d::Zero());
    std::vector<LabelAnchor> anchors;
    std::vector<double> radii;
    for (const kinematics::Finger& finger : hand.fingers) {
      const Vector3d centre = place(TipAtRest(finger));
      const Vector2d at = camera_.Project(centre);
      const double radius = finger.tip.radius / place.size * camera_.PixelsPerUnit(centre);
      const Vector2d outward =
          at == middle ? Vector2d(0, -1) : Vector2d((at - middle).normalized());
      anchors.push_back({at + radius * outward, outward, at});
      radii.push_back(radius);
      covered.push_back({at, at, radius});
      // The link behind it.
      const Vector3d last = place(TipAtRest(finger) - finger.tip.centre);
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
  /// The ball's outline, so that it is seen whole where a link hides it.
  void DrawRing(const Vector2d& centre, double radius, Color color) const {
    SetCircle(page_.context(), centre, radius);
    Stroke(page_.context(), Shaded(color), kRing * style_.font);
  }

  void DrawLeader(const Vector2d& ball, double radius, const Vector2d& label, Color color) const {
    const Vector2d away = label - ball;
    const double gap = away.norm() - radius - kHandLabelRadius * style_.font;
    if (gap < 0.5 * style_.font) return;
    SetColor(page_.context(), color);
    StrokeLine(page_.context(), ball + radius * away.normalized(),
               ball + (radius + gap) * away.normalized(), kHandLeader * style_.font);
  }

  void Write(const kinematics::Finger& finger, const Vector2d& centre, Color color) const {
    const Vector2d half_line(0, kHandLineHeight / 2 * style_.font);
    WriteLine(finger.name, centre - half_line, style_.font, true, color);
    WriteLine(FormatFixed(1e3 * finger.tip.radius, 1) + " mm", centre + half_line,
              kSmallFont * style_.font, false, style_.ground.ink);
  }

  void WriteLine(const std::string& text, const Vector2d& centre, double font, bool bold,
                 Color color) const {
    cairo_t* cr = page_.context();
    SelectFont(cr, font, bold);
    Vector2d start = CentredText(cr, text, centre);
    const double width = TextWidth(cr, text);
    start.x() =
        std::clamp(start.x(), 0.5 * font, std::max(0.5 * font, camera_.width - width - 0.5 * font));
    cairo_move_to(cr, start.x(), start.y());
    cairo_text_path(cr, text.c_str());
    FillWithHalo(cr, color, kHandHalo * font, style_.ground.halo);
  }

  const CairoImage& page_;
  const Camera& camera_;
  const TextStyle& style_;
};

}  // namespace

Image DrawHand(const kinematics::HandModel& hand, const Visuals& visuals,
               const std::string& caption, const HandPictureOptions& options) {
  const Placing place = PlaceHand(hand, visuals);
  HandPictureScene scene = MakeHandScene(hand, visuals, place);
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
  const CairoImage page(canvas.Draw(camera, scene.drawing));
  const std::vector<Obstacle> covered = DrawCaption(page, camera, caption, place.size, style);
  TipLabels(page, camera, style).Draw(hand, place, covered);
  WriteArrowLabels(page, camera, place, arrows, style);
  return page.ToImage();
}

}  // namespace regrasp::render
