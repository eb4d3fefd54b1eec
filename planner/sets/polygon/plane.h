#pragma once

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>
#include <CGAL/number_utils.h>

#include <array>
#include <optional>

namespace regrasp::polygon {

/// Predicates are templates over the number type. They are evaluated with intervals of doubles
/// first. If an interval does not determine the sign, CGAL throws, and the exact type decides. All
/// predicates are polynomials in doubles, so no division is required.
using Interval = CGAL::Interval_nt<false>;
using Exact = CGAL::Mpzf;

/// Scope in which the processor rounds upward, as Interval requires.
class IntervalScope {
 private:
  CGAL::Protect_FPU_rounding<true> upward_;
};

/// Scope inside an IntervalScope in which the processor rounds to nearest again.
class ExactScope {
 public:
  ExactScope() : nearest_(CGAL_FE_TONEAREST) {}

 private:
  CGAL::Protect_FPU_rounding<true> nearest_;
};

/// Return the sign of a number: −1, 0 or 1.
/// @throws CGAL::Uncertain_conversion_exception  if an interval contains 0.
template <class NT>
int Sign(const NT& x) {
  return static_cast<int>(static_cast<CGAL::Sign>(CGAL::sign(x)));
}

/// Return `predicate(NT())` by intervals, or exactly if they cannot decide. Call it in an
/// IntervalScope.
template <class Predicate>
auto DecideFiltered(const Predicate& predicate) {
  try {
    return predicate(Interval());
  } catch (const CGAL::Uncertain_conversion_exception&) {
  }
  const ExactScope exact;
  return predicate(Exact());
}

/// Vector of the plane over any number type.
template <class NT>
struct Vector2 {
  NT x = NT(0);
  NT y = NT(0);

  friend Vector2 operator+(const Vector2& a, const Vector2& b) { return {a.x + b.x, a.y + b.y}; }
  friend Vector2 operator-(const Vector2& a, const Vector2& b) { return {a.x - b.x, a.y - b.y}; }
  friend Vector2 operator-(const Vector2& a) { return {-a.x, -a.y}; }
  friend Vector2 operator*(const NT& s, const Vector2& a) { return {s * a.x, s * a.y}; }
};

template <class NT>
NT Cross(const Vector2<NT>& a, const Vector2<NT>& b) {
  return a.x * b.y - a.y * b.x;
}

template <class NT>
NT Dot(const Vector2<NT>& a, const Vector2<NT>& b) {
  return a.x * b.x + a.y * b.y;
}

/// Point (x/w, y/w) of the plane with w >= 0. For w = 0, it is the direction (x, y) in which a
/// region is unbounded.
template <class NT>
struct HomogeneousPoint {
  NT x = NT(0);
  NT y = NT(0);
  NT w = NT(0);
};

/// Open half-plane a x + b y + c > 0; for a homogeneous point, a x + b y + c w > 0.
template <class NT>
struct HalfPlane {
  NT a = NT(0);
  NT b = NT(0);
  NT c = NT(0);

  friend HalfPlane operator-(const HalfPlane& h) { return {-h.a, -h.b, -h.c}; }
};

template <class NT>
NT Evaluate(const HalfPlane<NT>& h, const HomogeneousPoint<NT>& p) {
  return h.a * p.x + h.b * p.y + h.c * p.w;
}

/// Return the corner at which the border of a convex region turns left from `h` to `k`.
template <class NT>
HomogeneousPoint<NT> Corner(const HalfPlane<NT>& h, const HalfPlane<NT>& k) {
  return {h.b * k.c - h.c * k.b, h.c * k.a - h.a * k.c, h.a * k.b - h.b * k.a};
}

/// Return the half-plane on the left of the line through `p` along `direction`.
template <class NT>
HalfPlane<NT> LeftOf(const Vector2<NT>& direction, const Vector2<NT>& p) {
  return {-direction.y, direction.x, direction.y * p.x - direction.x * p.y};
}

/// Edge of a polygon with the friction cone at its points, over any number type. Normals and
/// directions are not unit vectors.
template <class NT>
struct EdgeFrame {
  Vector2<NT> a;      ///< first end; material on the left
  Vector2<NT> b;      ///< second end
  Vector2<NT> along;  ///< b − a
  Vector2<NT> right;  ///< right border of the cone about the inward normal, normal + tan · along
  Vector2<NT> left;   ///< left border, normal − tan · along
};

/// Ends of an edge as doubles, which are taken as exact.
struct EdgeEnds {
  Vector2<double> a;
  Vector2<double> b;
};

template <class NT>
Vector2<NT> Convert(const Vector2<double>& v) {
  return {NT(v.x), NT(v.y)};
}

template <class NT>
EdgeFrame<NT> MakeEdgeFrame(const EdgeEnds& ends, double tangent) {
  EdgeFrame<NT> frame;
  frame.a = Convert<NT>(ends.a);
  frame.b = Convert<NT>(ends.b);
  frame.along = frame.b - frame.a;
  const Vector2<NT> normal = {-frame.along.y, frame.along.x};
  const Vector2<NT> lean = NT(tangent) * frame.along;
  frame.right = normal + lean;
  frame.left = normal - lean;
  return frame;
}

/// Convex cone of directions, narrower than π: left of `right` and right of `left`.
template <class NT>
struct DirectionCone {
  Vector2<NT> right;
  Vector2<NT> left;

  friend DirectionCone operator-(const DirectionCone& c) { return {-c.right, -c.left}; }
};

/// Return the cone about an edge's inward normal.
template <class NT>
DirectionCone<NT> ConeOf(const EdgeFrame<NT>& frame) {
  return {frame.right, frame.left};
}

/// Return the intersection of two cones; nullopt if they have no common interior.
template <class NT>
std::optional<DirectionCone<NT>> Intersect(const DirectionCone<NT>& a, const DirectionCone<NT>& b) {
  // A border of the intersection is a border of one cone that is inside the other.
  const auto begins_in = [](const Vector2<NT>& v, const DirectionCone<NT>& cone) {
    return Sign(Cross(cone.right, v)) >= 0 && Sign(Cross(v, cone.left)) > 0;
  };
  const auto ends_in = [](const Vector2<NT>& v, const DirectionCone<NT>& cone) {
    return Sign(Cross(cone.right, v)) > 0 && Sign(Cross(v, cone.left)) >= 0;
  };
  DirectionCone<NT> common;
  if (begins_in(a.right, b)) {
    common.right = a.right;
  } else if (begins_in(b.right, a)) {
    common.right = b.right;
  } else {
    return std::nullopt;
  }
  common.left = ends_in(a.left, b) ? a.left : b.left;
  return common;
}

/// Return the common cone of parallel grasps: directions in the cones of `b` and `c` and opposite
/// to the cone of the centre.
template <class NT>
std::optional<DirectionCone<NT>> CommonCone(const EdgeFrame<NT>& centre, const EdgeFrame<NT>& b,
                                            const EdgeFrame<NT>& c) {
  const auto outer = Intersect(ConeOf(b), ConeOf(c));
  return outer ? Intersect(*outer, -ConeOf(centre)) : std::nullopt;
}

}  // namespace regrasp::polygon
