#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <utility>
#include <vector>

#include "planner/sets/polygon/plane.h"

namespace regrasp::polygon {

/// What is known of a half-plane without computing.
struct SideTag {
  int id = -1;  ///< given by the caller, to find the side again
  /// Points that the border passes by construction, −1 for none. Where two sides meet in such a
  /// point and a third passes it too, its sign there is 0 without a computation: edges that share a
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

/// The intersection of half-planes with a non-empty interior, or nothing; it may be unbounded.
///
/// Kept as the border's half-planes counter-clockwise, none of them redundant, each with the corner
/// where it begins. In homogeneous coordinates the region is a pointed cone between planes through
/// the origin, so that corners at infinity need no special care, and every decision is the sign of
/// a half-plane at a corner: a 3 × 3 determinant.
template <class NT>
class ConvexRegion {
 public:
  struct Side {
    HalfPlane<NT> half_plane;
    SideTag tag;
    HomogeneousPoint<NT> from;  ///< where the side begins
  };

  /// The part of the plane inside four half-planes that bound a convex quadrilateral in this order,
  /// counter-clockwise; the line at infinity {0, 0, 1} may be one of them.
  ConvexRegion(const std::array<HalfPlane<NT>, 4>& half_planes,
               const std::array<SideTag, 4>& tags) {
    sides_.reserve(kUsualSides);
    for (int k = 0; k < 4; ++k) {
      sides_.push_back({half_planes[k], tags[k], Corner(half_planes[(k + 3) % 4], half_planes[k])});
    }
  }

  /// [0, 1] × [0, 1].
  static ConvexRegion UnitSquare() {
    const NT zero(0);
    const NT one(1);
    return ConvexRegion(
        {HalfPlane<NT>{zero, one, zero}, {-one, zero, one}, {zero, -one, one}, {one, zero, zero}},
        {});
  }

  /// No region.
  ConvexRegion() = default;

  /// The same region over another number type.
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

  /// Cuts away what is outside the half-plane; the region is empty where no interior remains.
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
    // A side stays iff one of its ends is strictly inside. Those that stay follow each other, and
    // the new side closes the border between the last and the first.
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
