#include "render/figures/grasp_diagram.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/sets/polygon/concurrent.h"
#include "planner/sets/polygon/convex_region.h"
#include "planner/sets/polygon/plane.h"
#include "planner/sets/polygon/set_cells.h"
#include "render/picture/caption.h"

namespace regrasp::render {

namespace {

using Eigen::Vector2d;
using Region = polygon::ConvexRegion<double>;
using Frame = polygon::EdgeFrame<double>;

constexpr double kHalfTurn = std::numbers::pi;

/// Area per D² below which cones only touch, up to rounding: the square of the tolerance for
/// contact points.
constexpr double kLeastArea = object::kPointTolerance * object::kPointTolerance;

/// Relative reduction of the cone angles for the computation of common points. At φ* the borders of
/// two cones can be collinear, and their intersection would depend on rounding. Corners then have
/// an accuracy of 1e-16 / 1e-9 diameters, which is invisible.
constexpr double kNarrower = 1 - 1e-9;

Vector2d Head(const Eigen::Vector3d& v) { return v.head<2>(); }
Vector2d ToEigen(const polygon::Vector2<double>& v) { return {v.x, v.y}; }
polygon::Vector2<double> FromEigen(const Vector2d& v) { return {v.x(), v.y()}; }

double AngleOf(const Vector2d& v) { return std::atan2(v.y(), v.x()); }
Vector2d Direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

double Area(const Outline& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    twice += Cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
  }
  return twice / 2;
}

Vector2d Centroid(const Outline& outline) {
  const Vector2d& origin = outline.front();
  Vector2d sum = Vector2d::Zero();
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const Vector2d a = outline[i] - origin;
    const Vector2d b = outline[i + 1] - origin;
    sum += Cross(a, b) * (a + b) / 6;
  }
  return origin + sum / Area(outline);
}

/// The points from which all contacts are in their double-sided cones: a convex part for each
/// choice of sides with a non-empty interior.
class CommonPoints {
 public:
  explicit CommonPoints(const object::Polygon& polygon)
      : centre_(Head(polygon.mass_properties().centroid)), diameter_(polygon.diameter()) {}

  [[nodiscard]] std::vector<Outline> Find(const std::vector<DoubleCone>& cones) const {
    std::vector<Outline> parts;
    for (unsigned sides = 0; sides < 1U << cones.size(); ++sides) {
      Region region = Page();
      for (std::size_t k = 0; k < cones.size(); ++k) {
        const double side = ((sides >> k) & 1U) != 0 ? -1 : 1;
        Clip(cones[k].apex, side * cones[k].axis, kNarrower * cones[k].friction_angle, region);
      }
      Outline outline = ToOutline(region);
      if (outline.size() > 2 && Area(outline) > kLeastArea * diameter_ * diameter_) {
        parts.push_back(std::move(outline));
      }
    }
    return parts;
  }

 private:
  [[nodiscard]] Region Page() const {
    const double reach = polygon::kFarthestFocus * diameter_;
    const double x = centre_.x();
    const double y = centre_.y();
    return Region({polygon::HalfPlane<double>{0, 1, reach - y},
                   {-1, 0, reach + x},
                   {0, -1, reach + y},
                   {1, 0, reach - x}},
                  {});
  }

  /// Clip a region to one side of a double-sided cone.
  static void Clip(const Vector2d& apex, const Vector2d& axis, double friction_angle,
                   Region& region) {
    const polygon::Vector2<double> p = FromEigen(apex);
    const double middle = AngleOf(axis);
    region.Clip(polygon::LeftOf(FromEigen(Direction(middle - friction_angle)), p));
    region.Clip(polygon::LeftOf(FromEigen(-Direction(middle + friction_angle)), p));
  }

  static Outline ToOutline(const Region& region) {
    Outline outline;
    for (const Region::Side& side : region.sides()) {
      outline.emplace_back(side.from.x / side.from.w, side.from.y / side.from.w);
    }
    return outline;
  }

  Vector2d centre_;
  double diameter_;
};

/// Return all parts of the focus cell of three edges.
std::vector<Outline> CellOf(const object::Polygon& polygon, const grasp::Grasp& grasp,
                            double friction_angle) {
  polygon::GraspSet set;
  set.tangent = std::tan(friction_angle);
  for (const grasp::Contact& contact : grasp) set.edges.push_back(contact.face);
  std::sort(set.edges.begin(), set.edges.end());
  set.parts = {0, 1, 2, 3, 4, 5, 6, 7};
  return polygon::FocusCell(polygon, set);
}

Frame FrameOf(const object::Polygon& polygon, FaceIndex face, double friction_angle) {
  const auto [a, b] = polygon.edge(face);
  return polygon::MakeEdgeFrame<double>({FromEigen(Head(a)), FromEigen(Head(b))},
                                        std::tan(friction_angle));
}

/// Return φ* of the normals; not positive if they do not positively span the plane.
double LargestSpanningAngle(const grasp::Grasp& grasp) {
  std::vector<double> angles;
  for (const grasp::Contact& contact : grasp) angles.push_back(AngleOf(Head(contact.n)));
  std::sort(angles.begin(), angles.end());
  double largest_gap = angles.front() + 2 * kHalfTurn - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) {
    largest_gap = std::max(largest_gap, angles[i] - angles[i - 1]);
  }
  return (kHalfTurn - largest_gap) / 2;
}

std::vector<DoubleCone> FrictionCones(const grasp::Grasp& grasp, double friction_angle) {
  std::vector<DoubleCone> cones;
  for (const grasp::Contact& contact : grasp) {
    cones.push_back({Head(contact.p), Head(contact.n), friction_angle});
  }
  return cones;
}

std::optional<GraspDiagram> TryTwoFinger(const grasp::Grasp& grasp, double friction_angle) {
  const Vector2d line = Head(grasp[1].p - grasp[0].p).normalized();
  const double first = line.dot(Head(grasp[0].n));
  const double second = -line.dot(Head(grasp[1].n));
  const double least = std::cos(friction_angle);
  const bool pressing = first > least && second > least;
  const bool stretching = -first > least && -second > least;
  if (!pressing && !stretching) return std::nullopt;
  GraspDiagram diagram;
  diagram.kind = DiagramKind::kTwoFinger;
  diagram.cones = FrictionCones(grasp, friction_angle);
  return diagram;
}

std::optional<GraspDiagram> TryConcurrent(const object::Polygon& polygon, const grasp::Grasp& grasp,
                                          double friction) {
  const double friction_angle = std::min(friction, LargestSpanningAngle(grasp));
  if (friction_angle <= 0) return std::nullopt;
  GraspDiagram diagram;
  diagram.kind = DiagramKind::kConcurrent;
  diagram.cones = FrictionCones(grasp, friction_angle);
  const std::vector<Outline> common = CommonPoints(polygon).Find(diagram.cones);
  if (common.empty()) return std::nullopt;
  diagram.focus = Centroid(
      *std::max_element(common.begin(), common.end(),
                        [](const Outline& a, const Outline& b) { return Area(a) < Area(b); }));
  diagram.focus_cell = CellOf(polygon, grasp, friction_angle);
  return diagram;
}

/// Return the middle of the widest range of directions in a cone whose lines through `a` separate
/// `b` from `c`.
/// @param cone  cone whose directions are within π of its right border.
/// @returns nullopt if there is no such direction.
std::optional<Vector2d> SeparatingDirection(const polygon::DirectionCone<double>& cone,
                                            const Vector2d& a, const Vector2d& b,
                                            const Vector2d& c) {
  const Vector2d right = ToEigen(cone.right);
  const Vector2d left = ToEigen(cone.left);
  const double start = AngleOf(right);
  const double width = std::atan2(Cross(right, left), right.dot(left));
  std::vector<double> turns = {0, width};
  for (const Vector2d& line : {Vector2d(b - a), Vector2d(c - a)}) {
    const double turn = std::remainder(AngleOf(line) - start,
                                       kHalfTurn);  // modulo π, because lines have no direction
    for (const double t : {turn, turn + kHalfTurn}) {
      if (t > 0 && t < width) turns.push_back(t);
    }
  }
  std::sort(turns.begin(), turns.end());
  std::optional<Vector2d> best;
  double widest = 0;
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const Vector2d direction = Direction(start + (turns[i] + turns[i + 1]) / 2);
    const bool separates = Cross(direction, b - a) * Cross(direction, c - a) < 0;
    if (separates && turns[i + 1] - turns[i] > widest) {
      widest = turns[i + 1] - turns[i];
      best = direction;
    }
  }
  return best;
}

std::optional<GraspDiagram> TryParallel(const object::Polygon& polygon, const grasp::Grasp& grasp,
                                        double friction_angle) {
  for (int a = 0; a < 3; ++a) {
    const grasp::Contact& centre = grasp[a];
    const grasp::Contact& b = grasp[(a + 1) % 3];
    const grasp::Contact& c = grasp[(a + 2) % 3];
    const auto cone = polygon::CommonCone(FrameOf(polygon, centre.face, friction_angle),
                                          FrameOf(polygon, b.face, friction_angle),
                                          FrameOf(polygon, c.face, friction_angle));
    if (!cone) continue;
    const auto direction = SeparatingDirection(*cone, Head(centre.p), Head(b.p), Head(c.p));
    if (!direction) continue;
    const Vector2d right = ToEigen(cone->right).normalized();
    const Vector2d left = ToEigen(cone->left).normalized();
    const Vector2d axis = (right + left).normalized();
    const double width = std::atan2(Cross(right, left), right.dot(left));
    GraspDiagram diagram;
    diagram.kind = DiagramKind::kParallel;
    diagram.force_direction = *direction;
    for (const grasp::Contact& contact : grasp) {
      const double inward = axis.dot(Head(contact.n)) < 0 ? -1 : 1;
      diagram.cones.push_back({Head(contact.p), inward * axis, width / 2});
    }
    return diagram;
  }
  return std::nullopt;
}

}  // namespace

GraspDiagram DescribeGrasp(const object::Polygon& polygon, const grasp::Grasp& grasp,
                           double friction_angle) {
  if (!(friction_angle > 0) || !(friction_angle < kHalfTurn / 2)) {
    throw std::invalid_argument("DescribeGrasp: the friction angle must be in (0, pi/2)");
  }
  for (const grasp::Contact& contact : grasp) {
    if (!contact.face.valid() || contact.face >= polygon.face_count()) {
      throw std::invalid_argument("DescribeGrasp: every contact must have a face");
    }
  }
  std::optional<GraspDiagram> diagram;
  if (grasp.size() == 2) diagram = TryTwoFinger(grasp, friction_angle);
  if (grasp.size() == 3) {
    // If both types apply, wider cones show more of the grasp.
    diagram = TryConcurrent(polygon, grasp, friction_angle);
    auto parallel = TryParallel(polygon, grasp, friction_angle);
    const auto width = [](const GraspDiagram& d) { return d.cones.front().friction_angle; };
    if (parallel && (!diagram || width(*parallel) > width(*diagram))) diagram = std::move(parallel);
  }
  if (diagram) return *diagram;
  GraspDiagram other;
  other.cones = FrictionCones(grasp, friction_angle);
  return other;
}

}  // namespace regrasp::render
