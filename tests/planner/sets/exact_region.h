#pragma once

#include <array>
#include <vector>

#include "planner/object/polygon.h"

// 2-finger grasps of two edges by clipping with exact numbers: a second method to compare with the
// filtered doubles of the planners.
namespace regrasp::exact {

template <class Number>
struct Vec {
  Number x;
  Number y;

  friend Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y}; }
  friend Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y}; }
  friend Vec operator*(const Number& s, const Vec& a) { return {s * a.x, s * a.y}; }
};

template <class Number>
Number Cross(const Vec<Number>& a, const Vec<Number>& b) {
  return a.x * b.y - a.y * b.x;
}

template <class Number>
Number Dot(const Vec<Number>& a, const Vec<Number>& b) {
  return a.x * b.x + a.y * b.y;
}

template <class Number>
struct Edge {
  Vec<Number> a;
  Vec<Number> along;
  Vec<Number> right;  ///< borders of the cone about the inward normal
  Vec<Number> left;
};

template <class Number>
Edge<Number> MakeEdge(const object::Polygon& polygon, int edge, double tangent) {
  const auto [from, to] = polygon.edge(FaceIndex(edge));
  const Vec<Number> a = {Number(from.x()), Number(from.y())};
  const Vec<Number> along = Vec<Number>{Number(to.x()), Number(to.y())} - a;
  const Vec<Number> normal = {-along.y, along.x};
  const Number t(tangent);
  return {a, along, normal + t * along, normal - t * along};
}

/// Return whether v is in the interior of the edge's cone.
template <class Number>
bool InCone(const Edge<Number>& e, const Vec<Number>& v) {
  return Cross(e.right, v) > 0 && Cross(v, e.left) > 0;
}

/// Return whether C(n_a) and −C(n_b) have a common interior. If two open cones narrower than π
/// intersect, a border or the middle of one is inside the other cone.
template <class Number>
bool ConesOppose(const Edge<Number>& a, const Edge<Number>& b) {
  const auto meets = [](const Edge<Number>& e, const Edge<Number>& f) {
    const Number minus(-1);
    return InCone(e, minus * f.right) || InCone(e, minus * f.left) ||
           InCone(e, minus * (f.right + f.left));
  };
  return meets(a, b) || meets(b, a);
}

template <class Number>
using Corner = std::array<Number, 2>;

/// Convex polygon of parameters (u_a, u_b) in [0, 1]².
template <class Number>
using Region = std::vector<Corner<Number>>;

/// Return the part with sign · cross(border, p_b(u_b) − p_a(u_a)) >= 0.
template <class Number>
Region<Number> Clip(const Region<Number>& region, const Edge<Number>& a, const Edge<Number>& b,
                    const Vec<Number>& border, int sign) {
  const auto value = [&](const Corner<Number>& u) {
    return Number(Number(sign) * Cross(border, (b.a - a.a) + u[1] * b.along - u[0] * a.along));
  };
  Region<Number> clipped;
  for (std::size_t k = 0; k < region.size(); ++k) {
    const Corner<Number>& from = region[k];
    const Corner<Number>& to = region[(k + 1) % region.size()];
    const Number f = value(from);
    const Number g = value(to);
    if (f >= 0) clipped.push_back(from);
    if ((f > 0 && g < 0) || (f < 0 && g > 0)) {
      const Number s = f / (f - g);
      clipped.push_back({from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1])});
    }
  }
  return clipped;
}

/// Return the grasps from outside (sign 1) or stretching (−1), including the border.
template <class Number>
Region<Number> TwoFingerRegion(const Edge<Number>& a, const Edge<Number>& b, int sign) {
  Region<Number> region = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  region = Clip(region, a, b, a.right, sign);
  region = Clip(region, a, b, a.left, -sign);
  region = Clip(region, a, b, b.right, -sign);
  return Clip(region, a, b, b.left, sign);
}

template <class Number>
Number TwiceArea(const Region<Number>& region) {
  Number area = 0;
  for (std::size_t k = 1; k + 1 < region.size(); ++k) {
    area += (region[k][0] - region[0][0]) * (region[k + 1][1] - region[0][1]) -
            (region[k][1] - region[0][1]) * (region[k + 1][0] - region[0][0]);
  }
  return area;
}

}  // namespace regrasp::exact
