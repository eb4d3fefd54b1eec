#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <utility>
#include <vector>

#include "planner/sets/polygon/plane.h"

namespace regrasp::polygon {

/// Known properties of a half-plane that avoid computations.
struct SideTag {
  int id = -1;  ///< identifier of the side, set by the caller
  /// Points on the border by construction, −1 for none. If two sides meet in such a point that is
  /// also on the border of a third, its sign there is 0 without a computation. Edges that share a
  /// vertex are the one degeneracy that every polygon has.
  std::array<int, 2> through = {-1, -1};

  [[nodiscard]] bool Passes(int point) const {
    return point >= 0 && (through[0] == point || through[1] == point);
  }
  [[nodiscard]] bool MeetsAtPointOf(const SideTag& next, const SideTag& third) const {
    return std::any_of(through.begin(), through.end(),
                       [&](int p) { return next.Passes(p) && third.Passes(p); });
  }
};

/// Intersection of half-planes: a convex region with interior, possibly unbounded, or empty.
///
/// The representation lists the half-planes of the border counter-clockwise, without redundant
/// ones, each with the corner at its start. In homogeneous coordinates the region is a pointed cone
/// between planes through the origin. Corners at infinity therefore need no special case, and every
/// decision is the sign of a half-plane at a corner: a 3 × 3 determinant.
template <class NT>
class ConvexRegion {
 public:
  struct Side {
    HalfPlane<NT> half_plane;
    SideTag tag;
    HomogeneousPoint<NT> from;  ///< start of the side
  };

  /// Make the intersection of four half-planes that bound a convex quadrilateral in this order,
  /// counter-clockwise. One of them may be the line at infinity {0, 0, 1}.
  ConvexRegion(const std::array<HalfPlane<NT>, 4>& half_planes,
               const std::array<SideTag, 4>& tags) {
    sides_.reserve(kUsualSides);
    for (int k = 0; k < 4; ++k) {
      sides_.push_back({half_planes[k], tags[k], Corner(half_planes[(k + 3) % 4], half_planes[k])});
    }
  }

  /// Return [0, 1] × [0, 1].
  static ConvexRegion UnitSquare() {
    const NT zero(0);
    const NT one(1);
    return ConvexRegion(
        {HalfPlane<NT>{zero, one, zero}, {-one, zero, one}, {zero, -one, one}, {one, zero, zero}},
        {});
  }

  /// Make an empty region.
  ConvexRegion() = default;

  /// Convert the region to another number type.
  template <class To, class Map>
  [[nodiscard]] ConvexRegion<To> Convert(const Map& map) const {
    std::vector<typename ConvexRegion<To>::Side> sides;
    for (const Side& s : sides_) {
      sides.push_back({{map(s.half_plane.a), map(s.half_plane.b), map(s.half_plane.c)},
                       s.tag,
                       {map(s.from.x), map(s.from.y), map(s.from.w)}});
    }
    return ConvexRegion<To>(std::move(sides));
  }

  [[nodiscard]] bool empty() const { return sides_.empty(); }
  [[nodiscard]] const std::vector<Side>& sides() const { return sides_; }
  [[nodiscard]] bool HasSide(int id) const {
    return std::any_of(sides_.begin(), sides_.end(), [&](const Side& s) { return s.tag.id == id; });
  }

  /// Intersect the region with a half-plane; the result is empty if no interior remains.
  void Clip(const HalfPlane<NT>& half_plane, const SideTag& tag = {}) {
    const int n = static_cast<int>(sides_.size());
    if (n == 0) return;
    boost::container::small_vector<signed char, kUsualSides> signs(n);
    bool inside = false;
    bool outside = false;
    for (int k = 0; k < n; ++k) {
      const bool meets = sides_[(k + n - 1) % n].tag.MeetsAtPointOf(sides_[k].tag, tag);
      const int sign = meets ? 0 : Sign(Evaluate(half_plane, sides_[k].from));
      signs[k] = static_cast<signed char>(sign);
      inside = inside || sign > 0;
      outside = outside || sign < 0;
    }
    if (!outside) return;
    if (!inside) {
      sides_.clear();
      return;
    }
    // A side remains iff one of its ends is strictly inside. The remaining sides are consecutive,
    // and the new side closes the border between the last and the first.
    const auto is_inside = [&](int k) { return signs[k % n] > 0; };
    int first = 0;
    while (is_inside(first) || !is_inside(first + 1)) ++first;
    int count = 1;
    while (is_inside(first + count)) ++count;
    std::rotate(sides_.begin(), sides_.begin() + first, sides_.end());
    sides_.erase(sides_.begin() + count, sides_.end());
    sides_.front().from = Corner(half_plane, sides_.front().half_plane);
    sides_.push_back({half_plane, tag, Corner(sides_.back().half_plane, half_plane)});
  }

 private:
  template <class>
  friend class ConvexRegion;

  explicit ConvexRegion(std::vector<Side> sides) : sides_(std::move(sides)) {}

  static constexpr int kUsualSides = 8;

  std::vector<Side> sides_;
};

}  // namespace regrasp::polygon
