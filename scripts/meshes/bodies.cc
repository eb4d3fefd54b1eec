#include "bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace regrasp_meshes {

namespace {

// All lengths are in metres.

/// Bend level planes into bowls of this radius, so that a flat base becomes slightly hollow and its
/// triangles do not form one face.
Point HollowBase(const Point& p) {
  constexpr double kRadius = 0.25;
  return {p.x(), p.y(), p.z() + (p.x() * p.x() + p.y() * p.y()) / (2 * kRadius)};
}

double EllipsoidField(const Point& p) { return Ellipsoid(p, {0, 0, 0}, {0.055, 0.038, 0.029}); }

double FlaskField(const Point& at) {
  const Point p = HollowBase(at);
  const double belly = RoundedCylinder(p, 0.030, -0.055, 0.010, 0.014);
  const double shoulder = Ellipsoid(p, {0, 0, 0.004}, {0.028, 0.028, 0.024});
  const double neck = RoundedCylinder(p, 0.012, 0.0, 0.058, 0.005);
  const double lip = Ring(p - Point(0, 0, 0.052), 0.0115, 0.0055);
  return Join(Join(Join(belly, shoulder, 0.012), neck, 0.014), lip, 0.006);
}

double MugField(const Point& at) {
  const Point p = HollowBase(at);
  const double wall = RoundedCylinder(p, 0.033, -0.032, 0.032, 0.006);
  const double room = RoundedCylinder(p, 0.0235, -0.021, 0.060, 0.010);
  const Point from_handle = p - Point(0.036, 0, 0);
  const double handle = Ring({from_handle.x(), from_handle.z(), from_handle.y()}, 0.0185, 0.0075);
  return Cut(Join(wall, handle, 0.008), room, 0.006);
}

double SpannerField(const Point& p) {
  const double shaft =
      SweptBall({p.x(), p.y(), 0.9 * p.z()}, {-0.026, 0, 0}, {0.030, 0, 0}, 0.0075, 0.0085);
  const double ring = Ring(p - Point(-0.042, 0, 0), 0.0145, 0.0068);
  const double head = Ellipsoid(p, {0.044, 0, 0}, {0.023, 0.021, 0.0095});
  const Point turned(std::cos(0.26) * (p.x() - 0.044) + std::sin(0.26) * p.y(),
                     -std::sin(0.26) * (p.x() - 0.044) + std::cos(0.26) * p.y(), 0.1 * p.z());
  const double jaw = SweptBall(turned, {0.004, 0, 0}, {0.060, 0, 0}, 0.0085, 0.0095);
  return Cut(Join(Join(shaft, ring, 0.010), head, 0.012), jaw, 0.005);
}

/// Sphere with twelve knobs in the directions of an icosahedron's vertices.
double StarField(const Point& p) {
  constexpr double kBall = 0.031;
  constexpr double kKnob = 0.022;
  constexpr double kSharpness = 11;
  const double length = p.norm();
  if (length == 0) return -kBall;
  double radius = kBall;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double one : {-1.0, 1.0}) {
      for (const double other : {-1.0, 1.0}) {
        Point corner = Point::Zero();
        corner[axis] = one;
        corner[(axis + 1) % 3] = other * std::numbers::phi;
        radius += kKnob * std::exp(kSharpness * (corner.normalized().dot(p) / length - 1));
      }
    }
  }
  return length - radius;
}

double DuckField(const Point& p) {
  const double trunk = Ellipsoid(p, {-0.006, 0, -0.016}, {0.040, 0.027, 0.023});
  const double tail = SweptBall(p, {-0.034, 0, -0.006}, {-0.052, 0, 0.010}, 0.013, 0.006);
  const double neck = SweptBall(p, {0.016, 0, -0.006}, {0.022, 0, 0.022}, 0.017, 0.013);
  const double head = Ellipsoid(p, {0.024, 0, 0.028}, {0.020, 0.018, 0.018});
  const double beak = Ellipsoid(p, {0.046, 0, 0.024}, {0.015, 0.010, 0.0065});
  const double wing =
      Ellipsoid({p.x(), std::abs(p.y()), p.z()}, {-0.012, 0.023, -0.010}, {0.022, 0.009, 0.013});
  const double rump = Join(Join(trunk, tail, 0.016), wing, 0.008);
  return Join(Join(rump, Join(neck, head, 0.012), 0.014), beak, 0.006);
}

}  // namespace

std::vector<Body> AllBodies() {
  return {
      {"ellipsoid", "An ellipsoid of 11 by 7.6 by 5.8 cm.", EllipsoidField, {0, 0, 0}},
      {"flask", "A bottle with a neck and a lip.", FlaskField, {0, 0, -0.02}},
      {"mug", "A mug, hollow, with a handle.", MugField, {0, 0, -0.027}},
      {"spanner", "A spanner with a ring and an open jaw.", SpannerField, {0, 0, 0}},
      {"star", "A ball with twelve knobs.", StarField, {0, 0, 0}},
      {"duck", "A duck with a head, a beak, wings and a tail.", DuckField, {0, 0, -0.016}},
  };
}

}  // namespace regrasp_meshes
