#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "render/frames/annotation.h"
#include "render/frames/fault_marks.h"
#include "render/picture/cairo_paint.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Lengths in multiples of the font size.
constexpr double kFaultMargin = 1.33;
constexpr double kFaultCaptionMargin = 2.6;
constexpr double kLineWidth = 0.11;
constexpr double kTick = 0.42;
constexpr double kFaultHalo = 0.32;
constexpr double kDash = 0.35;
constexpr double kFaultRingGap = 0.3;
constexpr double kAbsentRadius = 0.9;
/// Distance of a text from its mark beyond which a line connects them.
constexpr double kFaultLeader = 1.6;

// Lengths in object diameters.
constexpr double kNormalLength = 0.2;
constexpr double kPlaceRadius = 0.030;
constexpr double kDisturbanceLength = 0.30;
constexpr double kSpotRadius = 0.07;
constexpr double kTwistRadius = 0.16;

constexpr Color kGhost = {110, 118, 132};
constexpr Color kDisturbance = {118, 42, 151};

constexpr int kRimPoints = 72;

/// Return two unit vectors perpendicular to `axis` and to each other.
std::pair<Vector3d, Vector3d> Across(const Vector3d& axis) {
  const Vector3d u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

struct Box {
  Vector2d low, high;
  [[nodiscard]] bool Contains(const Vector2d& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
};

class Overlay {
 public:
  Overlay(cairo_t* cr, const Camera& camera, const NormalizedFrame& frame, const TextStyle& style)
      : cr_(cr),
        camera_(camera),
        frame_(frame),
        style_(style),
        font_(std::max(kSmallestFont, style.font)) {
    cairo_set_line_join(cr_, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr_, CAIRO_LINE_CAP_ROUND);
  }

  void Avoid(std::span<const FingerGlyph> fingers) {
    for (const FingerGlyph& glyph : fingers) {
      for (int i = 0; i < 8; ++i) {
        const double turn = std::numbers::pi * i / 4;
        const double radius = glyph.fingertip_radius * camera_.PixelsPerUnit(glyph.fingertip);
        busy_.push_back(camera_.Project(glyph.fingertip) +
                        radius * Vector2d(std::cos(turn), std::sin(turn)));
      }
      for (const Vector3d& p :
           {glyph.fingertip, glyph.contact, glyph.stem_end, glyph.end,
            Vector3d(glyph.end + 0.05 * glyph.outward), Vector3d(glyph.end + 0.025 * glyph.outward),
            Vector3d((glyph.fingertip + glyph.stem_end) / 2)}) {
        busy_.push_back(camera_.Project(p));
      }
    }
  }

  /// Draw a ring around a faulty finger, which the object can hide.
  void DrawRing(const FingerGlyph& glyph) {
    const double radius =
        glyph.fingertip_radius * camera_.PixelsPerUnit(glyph.fingertip) + kFaultRingGap * font_;
    for (const bool white : {true, false}) {
      SetCircle(cr_, camera_.Project(glyph.fingertip), radius);
      Stroke(cr_, white ? style_.ground.halo : kFaultRed, (white ? 2.6 : 1.4) * kLineWidth * font_);
    }
  }

  void DrawGhost(const BodyShape& body, const Eigen::Isometry3d& X_WO, const std::string& text) {
    const Eigen::Isometry3d pose = frame_.BodyPose(X_WO);
    const auto to_eye = [&](const Vector3d& p) -> Vector3d {
      return pose.linear().transpose() * camera_.ToEye(pose * p);
    };
    Vector2d highest(0, std::numeric_limits<double>::infinity());
    for (const auto& edges : {body.edges, FindOutline(body, to_eye)}) {
      for (const auto& [a, b] : edges) {
        const Vector2d p = camera_.Project(pose * a);
        if (p.y() < highest.y()) highest = p;
        Dash(p, camera_.Project(pose * b), kGhost, 0.8);
      }
    }
    if (std::isfinite(highest.y())) Label(highest, text, kGhost);
  }

  void Draw(const FaultMarks::Dimension& dimension) {
    const Vector2d a = Project(dimension.from);
    const Vector2d b = Project(dimension.to);
    const Vector2d along = (b - a).stableNormalized();
    const Vector2d across(-along.y(), along.x());
    for (const bool halo : {true, false}) {
      Line(a, b, halo);
      for (const Vector2d& end : {a, b}) {
        Line(end - kTick * font_ * across, end + kTick * font_ * across, halo);
      }
    }
    Occupy(a, b);
    Label((a + b) / 2, dimension.text, kFaultRed);
  }

  void Draw(const FaultMarks::Normal& normal) {
    const Color color = normal.expected ? kExpected : kFaultRed;
    const Vector2d from = Project(normal.at);
    const Vector2d to = Project(normal.at + kNormalLength * frame_.diameter_m * normal.along);
    DrawArrow(from, to, color, 2.2);
    Label(to, normal.text, color);
  }

  void Draw(const FaultMarks::Place& place) {
    const Vector3d centre = place.contact - kPlaceRadius * frame_.diameter_m * place.normal;
    const Vector2d at = Project(centre);
    const double radius = kPlaceRadius * camera_.PixelsPerUnit(frame_.FromWorld(centre));
    SetCircle(cr_, at, radius);
    Fill(cr_, kExpected, 0.18);
    SetCircle(cr_, at, radius);
    StrokeDashed(kExpected, 1.3);
    Cross(Project(place.contact), kExpected);
    busy_.push_back(at);
    Label(at, place.text, kExpected, radius);
  }

  /// Draw the rim of the cone and its two sides.
  void Draw(const FaultMarks::Cone& cone, bool planar) {
    auto [u, v] = Across(cone.axis);
    if (planar) {
      u = Vector3d::UnitZ().cross(cone.axis);
      v.setZero();
    }
    const double length = kConeLength * frame_.diameter_m;
    const Vector2d apex = Project(cone.apex);
    std::vector<Vector2d> rim;
    for (int i = 0; i < kRimPoints; ++i) {
      const double turn = 2 * std::numbers::pi * i / kRimPoints;
      const Vector3d side = std::cos(turn) * u + std::sin(turn) * v;
      rim.push_back(Project(cone.apex + length * (std::cos(cone.friction_angle) * cone.axis +
                                                  std::sin(cone.friction_angle) * side)));
    }
    cairo_new_path(cr_);
    AddOutline(cr_, rim);
    StrokeDashed(kFaultRed, 1);
    const Vector2d middle = Project(cone.apex + length * cone.axis) - apex;
    const auto bearing = [&](const Vector2d& p) {
      const Vector2d direction = p - apex;
      return std::atan2(middle.x() * direction.y() - middle.y() * direction.x(),
                        middle.dot(direction));
    };
    const auto [left, right] = std::ranges::minmax_element(rim, {}, bearing);
    Dash(apex, *left, kFaultRed, 1);
    Dash(apex, *right, kFaultRed, 1);
    for (const Vector2d& end : {*left, *right}) Occupy(apex, end);
    if (!cone.text.empty()) Label(*left, cone.text, kFaultRed);
  }

  void Draw(const FaultMarks::Fingertip& tip) {
    const Vector3d at = frame_.FromWorld(tip.centre);
    SetCircle(cr_, camera_.Project(at), tip.radius / frame_.diameter_m * camera_.PixelsPerUnit(at));
    Fill(cr_, kFaultRed, 0.10);
    SetCircle(cr_, camera_.Project(at), tip.radius / frame_.diameter_m * camera_.PixelsPerUnit(at));
    StrokeDashed(kFaultRed, 1.2);
  }

  /// Draw a ring with a text around a place that can be hidden.
  void Draw(const FaultMarks::Spot& spot) {
    const Vector2d at = Project(spot.at);
    const double radius = kSpotRadius * camera_.PixelsPerUnit(frame_.FromWorld(spot.at));
    for (const bool halo : {true, false}) {
      SetCircle(cr_, at, radius);
      Stroke(cr_, halo ? style_.ground.halo : kFaultRed, (halo ? 2.6 : 1.4) * kLineWidth * font_);
    }
    Cross(at, kFaultRed);
    Occupy(at - Vector2d(radius, 0), at + Vector2d(radius, 0));
    if (!spot.text.empty()) Label(at, spot.text, kFaultRed, radius);
  }

  void DrawDisturbance(const plan::FaultDisturbance& disturbance, const Vector3d& centroid) {
    const double D = frame_.diameter_m;
    const Vector2d centre = Project(centroid);
    if (disturbance.force_N.norm() > 0) {
      const Vector3d along = disturbance.force_N.normalized();
      const Vector2d tip = Project(centroid + kDisturbanceLength * D * along);
      DrawArrow(centre, tip, kDisturbance, 3);
      Label(tip, disturbance.name, kDisturbance);
      return;
    }
    if (!(disturbance.torque_Nm.norm() > 0)) return;
    const auto [u, v] = Across(disturbance.torque_Nm.normalized());
    std::vector<Vector2d> rim;
    for (int i = 0; i < kRimPoints; ++i) {
      const double turn = 2 * std::numbers::pi * i / kRimPoints;
      rim.push_back(
          Project(centroid + kTwistRadius * D * (std::cos(turn) * u + std::sin(turn) * v)));
    }
    const std::vector<Vector2d> arc = FreestArc(rim);
    ArrowAlong(arc, kDisturbance, 3);
    Label(arc.front(), disturbance.name, kDisturbance);
  }

  /// Draw the heading at the top left, on as many lines as necessary.
  void DrawHeading(const std::string& text) {
    if (style_.font < kSmallestFont) return;
    const double margin = kFaultMargin * font_;
    SelectFont(cr_, font_, /*bold=*/true);
    base_ = margin;
    for (const std::string& line : BreakLines(cr_, text, camera_.width - 2 * margin)) {
      base_ += 0.8 * font_;
      Text({margin, base_}, line);
      base_ += 0.5 * font_;
    }
  }

  /// Draw a faulty finger that is not in the image below the heading.
  void DrawAbsent(FingerIndex finger) {
    const double margin = kFaultMargin * font_;
    const double radius = kAbsentRadius * font_;
    base_ += 0.4 * font_ + radius;
    const Vector2d centre(margin + radius, base_);
    SetCircle(cr_, centre, radius);
    Fill(cr_, kFaultRed, 0.10);
    SetCircle(cr_, centre, radius);
    StrokeDashed(kFaultRed, 1.3);
    SelectFont(cr_, font_, /*bold=*/true);
    const std::string number = std::to_string(finger);
    const double middle = base_ + 0.36 * font_;
    Text({centre.x() - TextWidth(cr_, number) / 2, middle}, number);
    Text({centre.x() + radius + 0.5 * font_, middle}, "not on the object");
    base_ += radius;
  }

  /// Draw the texts last, on top of everything. They avoid heading and absent fingers.
  void DrawLabels() {
    for (const auto& [at, text, color, gap] : labels_) PlaceLabel(at, text, color, gap);
  }

  [[nodiscard]] std::vector<Obstacle> Covered() const {
    constexpr double kTextWeight = 3;
    std::vector<Obstacle> covered = lines_;
    for (const auto& [low, high] : taken_) {
      const double half = (high.y() - low.y()) / 2;
      const double middle = (low.y() + high.y()) / 2;
      covered.push_back({{low.x() + half, middle}, {high.x() - half, middle}, half, kTextWeight});
    }
    return covered;
  }

 private:
  struct LabelText {
    Vector2d at;
    std::string text;
    Color color;
    double gap;
  };

  /// Return the three quarters of a rim that cross the fewest marks.
  [[nodiscard]] std::vector<Vector2d> FreestArc(std::vector<Vector2d> rim) const {
    constexpr int kStarts = 8;
    std::vector<Vector2d> best;
    long least = std::numeric_limits<long>::max();
    for (int start = 0; start < kStarts; ++start) {
      const std::vector<Vector2d> arc(rim.begin(), rim.begin() + kRimPoints * 3 / 4 + 1);
      const long crossed = std::ranges::count_if(busy_, [&](const Vector2d& p) {
        return std::ranges::any_of(arc, [&](const Vector2d& q) { return (p - q).norm() < font_; });
      });
      if (crossed < least) {
        least = crossed;
        best = arc;
      }
      std::ranges::rotate(rim, rim.begin() + kRimPoints / kStarts);
    }
    return best;
  }

  [[nodiscard]] Vector2d Project(const Vector3d& p_W) const {
    return camera_.Project(frame_.FromWorld(p_W));
  }

  void Text(const Vector2d& at, const std::string& text) {
    cairo_move_to(cr_, at.x(), at.y());
    cairo_text_path(cr_, text.c_str());
    FillWithHalo(cr_, kFaultRed, kFaultHalo * font_, style_.ground.halo);
  }

  void Label(const Vector2d& at, const std::string& text, Color color, double gap = 0) {
    labels_.push_back({at, text, color, gap});
  }

  /// Mark a line as an area that texts should not cover.
  void Occupy(const Vector2d& a, const Vector2d& b) {
    constexpr int kParts = 8;
    for (int i = 0; i <= kParts; ++i) busy_.push_back(a + i * (b - a) / kParts);
    lines_.push_back({a, b, kLineWidth * font_});
  }

  void Line(const Vector2d& a, const Vector2d& b, bool halo) {
    SetColor(cr_, halo ? style_.ground.halo : kFaultRed);
    StrokeLine(cr_, a, b, (halo ? 2.6 : 1.2) * kLineWidth * font_);
  }

  void StrokeDashed(Color color, double weight) {
    const double dash = kDash * font_;
    cairo_set_dash(cr_, &dash, 1, 0);
    Stroke(cr_, color, weight * kLineWidth * font_);
    cairo_set_dash(cr_, nullptr, 0, 0);
  }

  void Dash(const Vector2d& a, const Vector2d& b, Color color, double weight) {
    cairo_new_path(cr_);
    cairo_move_to(cr_, a.x(), a.y());
    cairo_line_to(cr_, b.x(), b.y());
    StrokeDashed(color, weight);
  }

  void Cross(const Vector2d& at, Color color) {
    const double arm = 0.3 * font_;
    SetColor(cr_, color);
    for (const double side : {-1.0, 1.0}) {
      const Vector2d direction(arm, side * arm);
      StrokeLine(cr_, at - direction, at + direction, 1.3 * kLineWidth * font_);
    }
  }

  void DrawArrow(const Vector2d& from, const Vector2d& to, Color color, double weight) {
    ArrowAlong({from, to}, color, weight);
  }

  void ArrowAlong(const std::vector<Vector2d>& path, Color color, double weight) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) Occupy(path[i], path[i + 1]);
    regrasp::render::DrawArrow(cr_, path, weight * kLineWidth * font_, color, style_.ground.halo);
  }

  /// Draw a text near `at` where it covers least, with a line to `at` if it is not next to it.
  void PlaceLabel(const Vector2d& at, const std::string& text, Color color, double gap) {
    SelectFont(cr_, font_, /*bold=*/true);
    const Vector2d half(TextWidth(cr_, text) / 2, 0.6 * font_);
    const Vector2d margin = half + Vector2d::Constant(0.4 * font_);
    // Inside the border, below the heading and above the caption.
    const Vector2d low =
        half + Vector2d(kFaultMargin * font_, std::max(kFaultMargin * font_, base_));
    const Vector2d high = Vector2d(camera_.width, camera_.height) - half -
                          Vector2d(kFaultMargin * font_, kFaultCaptionMargin * font_);
    double least = std::numeric_limits<double>::infinity();
    Vector2d best = at;
    for (const double distance : {0.9, 1.8, 3.0, 4.5, 6.5}) {
      for (int i = 0; i < 16; ++i) {
        const double turn = 2 * std::numbers::pi * i / 16;
        const Vector2d direction(std::cos(turn), std::sin(turn));
        const double away = gap + distance * font_;
        Vector2d centre =
            at + (away * direction.array() + half.array() * direction.array()).matrix();
        centre = centre.cwiseMin(high).cwiseMax(low);
        const double cost = Covered({centre - margin, centre + margin}) + distance / 4;
        if (cost < least) {
          least = cost;
          best = centre;
        }
      }
    }
    const Vector2d near = at.cwiseMax(best - half).cwiseMin(best + half);
    if ((near - at).norm() > gap + kFaultLeader * font_) {
      SetColor(cr_, color);
      StrokeLine(cr_, near, at, 0.6 * kLineWidth * font_);
    }
    cairo_move_to(cr_, best.x() - half.x(), best.y() + 0.36 * font_);
    cairo_text_path(cr_, text.c_str());
    FillWithHalo(cr_, color, kFaultHalo * font_, style_.ground.halo);
    taken_.push_back({best - half, best + half});
  }

  [[nodiscard]] double Covered(const Box& box) const {
    constexpr double kText = 8;
    double covered = 0;
    for (const Vector2d& p : busy_) covered += box.Contains(p) ? 1 : 0;
    for (const Box& other : taken_) {
      const bool apart = (box.low.array() > other.high.array()).any() ||
                         (other.low.array() > box.high.array()).any();
      covered += apart ? 0 : kText;
    }
    return covered;
  }

  cairo_t* cr_;
  const Camera& camera_;
  const NormalizedFrame& frame_;
  const TextStyle& style_;
  double font_;
  std::vector<Vector2d> busy_;   ///< points that texts should not cover
  std::vector<Obstacle> lines_;  ///< lines of marks
  std::vector<Box> taken_;       ///< boxes of texts
  std::vector<LabelText> labels_;
  double base_ = 0;  ///< baseline of the last text at the top left
};

}  // namespace

std::vector<Vector3d> ExtentOf(const FaultMarks& marks, double diameter_m) {
  std::vector<Vector3d> points;
  const auto add_sphere = [&](const Vector3d& centre, double radius) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        points.push_back(centre + sign * radius * Vector3d::Unit(axis));
      }
    }
  };
  for (const auto& dimension : marks.dimensions) {
    for (const Vector3d& end : {dimension.from, dimension.to}) points.push_back(end);
  }
  for (const auto& normal : marks.normals) {
    points.push_back(normal.at + kNormalLength * diameter_m * normal.along);
  }
  for (const auto& place : marks.places) {
    add_sphere(place.contact - kPlaceRadius * diameter_m * place.normal, kPlaceRadius * diameter_m);
  }
  for (const auto& cone : marks.cones) points.push_back(cone.apex);
  for (const auto& tip : marks.fingertips) add_sphere(tip.centre, tip.radius);
  for (const auto& spot : marks.spots) add_sphere(spot.at, kSpotRadius * diameter_m);
  if (marks.disturbance && marks.disturbance->force_N.norm() > 0) {
    points.push_back(marks.centroid +
                     kDisturbanceLength * diameter_m * marks.disturbance->force_N.normalized());
  }
  return points;
}

std::vector<Obstacle> DrawFaultMarks(const CairoImage& image, const Camera& camera,
                                     const NormalizedFrame& frame, const BodyShape& body,
                                     std::span<const FingerGlyph> fingers, const FaultMarks& marks,
                                     const TextStyle& style) {
  Overlay overlay(image.context(), camera, frame, style);
  overlay.Avoid(fingers);
  if (marks.X_WO_before) overlay.DrawGhost(body, *marks.X_WO_before, marks.ghost_text);
  for (const FingerGlyph& glyph : fingers) {
    // A placed finger already has its ring.
    const bool at_fault = std::ranges::find(marks.fingers, glyph.finger) != marks.fingers.end();
    if (at_fault && glyph.role != plan::FingerRole::kPlaced) overlay.DrawRing(glyph);
  }
  for (const auto& tip : marks.fingertips) overlay.Draw(tip);
  for (const auto& spot : marks.spots) overlay.Draw(spot);
  for (const auto& cone : marks.cones) overlay.Draw(cone, marks.planar);
  for (const auto& place : marks.places) overlay.Draw(place);
  for (const auto& dimension : marks.dimensions) overlay.Draw(dimension);
  for (const auto& normal : marks.normals) overlay.Draw(normal);
  if (marks.disturbance) overlay.DrawDisturbance(*marks.disturbance, marks.centroid);
  overlay.DrawHeading(marks.heading);
  for (const FingerIndex finger : marks.fingers) {
    // Fingers of a hand are always in the image.
    const bool shown = !marks.links.empty();
    if (!shown && std::ranges::find(fingers, finger, &FingerGlyph::finger) == fingers.end()) {
      overlay.DrawAbsent(finger);
    }
  }
  overlay.DrawLabels();
  return overlay.Covered();
}

}  // namespace regrasp::render
