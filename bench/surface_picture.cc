#include "bench/surface_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/base/angle.h"

namespace regrasp {

using Eigen::Vector3d;
using object::PolygonSoup;

namespace {

/// Pictures are drawn so many times larger, and made smaller.
constexpr int kFiner = 3;

/// Of a picture's side what the surface takes.
constexpr double kFilled = 0.9;

/// A line is drawn where the depth jumps by this, over the extent's side.
constexpr double kJump = 0.03;

const Vector3d kOutside(124, 146, 176), kInside(206, 184, 106), kInvented(214, 78, 52);
const Vector3d kLight = Vector3d(0.35, 0.55, 0.76).normalized();  // right, up, to the eye
constexpr double kAmbient = 0.38;
constexpr double kLineShade = 0.35;

/// Rows: to the right, up, towards the eye.
Eigen::Matrix3d AxesOf(const SurfaceView& view) {
  const double a = Radians(view.azimuth_deg), e = Radians(view.elevation_deg);
  const Vector3d to_eye(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
  const Vector3d right(-std::sin(a), std::cos(a), 0);
  Eigen::Matrix3d axes;
  axes << right.transpose(), to_eye.cross(right).transpose(), to_eye.transpose();
  return axes;
}

/// The vertices that facets use; of a cloud all.
std::vector<Vector3d> UsedVertices(const PolygonSoup& soup) {
  if (soup.facets.empty()) return soup.vertices;
  std::vector<Vector3d> used;
  for (const auto& facet : soup.facets) {
    for (const int v : facet) used.push_back(soup.vertices[v]);
  }
  return used;
}

/// Pixels with the depth of what they show.
class Canvas {
 public:
  explicit Canvas(int side)
      : side_(side),
        colors_(static_cast<std::size_t>(side) * side, Vector3d::Constant(255)),
        depths_(colors_.size(), kNothing) {}

  /// @param corners  x and y in pixels, y downwards, z towards the eye.
  void FillTriangle(const std::array<Vector3d, 3>& corners, const Vector3d& color) {
    const auto& [a, b, c] = corners;
    const double doubled = Cross(b - a, c - a);
    if (doubled == 0) return;
    const auto range = [&](int axis) {
      const auto [least, most] = std::minmax({a[axis], b[axis], c[axis]});
      return std::pair(std::max(0, static_cast<int>(std::floor(least))),
                       std::min(side_ - 1, static_cast<int>(std::ceil(most))));
    };
    const auto [left, right] = range(0);
    const auto [top, bottom] = range(1);
    for (int y = top; y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const Vector3d p(x + 0.5, y + 0.5, 0);
        const double u = Cross(p - a, c - a) / doubled, v = Cross(b - a, p - a) / doubled;
        if (u < 0 || v < 0 || u + v > 1) continue;
        Put(x, y, a.z() + u * (b.z() - a.z()) + v * (c.z() - a.z()), color);
      }
    }
  }

  void FillPoint(const Vector3d& at, const Vector3d& color) {
    constexpr int kHalf = 2;
    for (int y = static_cast<int>(at.y()) - kHalf; y < static_cast<int>(at.y()) + kHalf; ++y) {
      for (int x = static_cast<int>(at.x()) - kHalf; x < static_cast<int>(at.x()) + kHalf; ++x) {
        if (x >= 0 && y >= 0 && x < side_ && y < side_) Put(x, y, at.z(), color);
      }
    }
  }

  void DrawJumps(double least) {
    const std::vector<Vector3d> plain = colors_;
    for (int y = 0; y < side_; ++y) {
      for (int x = 0; x < side_; ++x) {
        const bool jumps = (x > 0 && Differs(At(x, y), At(x - 1, y), least)) ||
                           (y > 0 && Differs(At(x, y), At(x, y - 1), least));
        if (jumps) colors_[At(x, y)] = kLineShade * plain[At(x, y)];
      }
    }
  }

  [[nodiscard]] render::Image ToImage() const {
    render::Image image = render::MakeImage(side_, side_);
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        image.rgb[3 * i + k] = static_cast<unsigned char>(std::clamp(colors_[i][k], 0.0, 255.0));
      }
    }
    return image;
  }

 private:
  static constexpr double kNothing = -std::numeric_limits<double>::infinity();

  static double Cross(const Vector3d& a, const Vector3d& b) {
    return a.x() * b.y() - a.y() * b.x();
  }
  [[nodiscard]] std::size_t At(int x, int y) const {
    return static_cast<std::size_t>(y) * side_ + x;
  }
  [[nodiscard]] bool Differs(std::size_t i, std::size_t j, double least) const {
    if (depths_[i] == depths_[j]) return false;  // nothing is at either
    return std::abs(depths_[i] - depths_[j]) > least;
  }
  void Put(int x, int y, double depth, const Vector3d& color) {
    if (depth <= depths_[At(x, y)]) return;
    depths_[At(x, y)] = depth;
    colors_[At(x, y)] = color;
  }

  int side_;
  std::vector<Vector3d> colors_;
  std::vector<double> depths_;
};

/// @param normal  of length 1, in the axes of the view.
Vector3d ShadeOf(const Vector3d& normal, bool is_invented) {
  const bool is_outside = normal.z() > 0;
  const double light = std::max(0.0, (is_outside ? normal : -normal).dot(kLight));
  const Vector3d& color = is_outside ? (is_invented ? kInvented : kOutside) : kInside;
  return (kAmbient + (1 - kAmbient) * light) * color;
}

void DrawFacets(const PolygonSoup& soup, const std::vector<Vector3d>& places, Canvas& canvas) {
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    const auto& facet = soup.facets[f];
    for (std::size_t k = 1; k + 1 < facet.size(); ++k) {
      const std::array corners = {places[facet[0]], places[facet[k]], places[facet[k + 1]]};
      Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
      if (normal.norm() == 0) continue;
      // With y downwards all turns are mirrored.
      normal = Vector3d(-normal.x(), normal.y(), -normal.z()).normalized();
      canvas.FillTriangle(corners, ShadeOf(normal, !soup.invented.empty() && soup.invented[f]));
    }
  }
}

void DrawPoints(const std::vector<Vector3d>& places, Canvas& canvas) {
  constexpr double kFarthest = 0.45;
  const auto [far, near] = std::ranges::minmax(places, {}, [](const Vector3d& p) { return p.z(); });
  const double depth = std::max(near.z() - far.z(), std::numeric_limits<double>::min());
  for (const Vector3d& p : places) {
    canvas.FillPoint(p, (kFarthest + (1 - kFarthest) * (p.z() - far.z()) / depth) * kOutside);
  }
}

}  // namespace

SurfaceExtent ExtentOf(const std::vector<const PolygonSoup*>& soups, const SurfaceView& view) {
  const Eigen::Matrix3d axes = AxesOf(view);
  Eigen::AlignedBox3d box;
  for (const PolygonSoup* soup : soups) {
    for (const Vector3d& v : UsedVertices(*soup)) box.extend(axes * v);
  }
  return {axes.transpose() * box.center(), std::max(box.sizes().x(), box.sizes().y()) / kFilled};
}

render::Image DrawSurface(const PolygonSoup& soup, const SurfaceView& view,
                          const SurfaceExtent& extent, int side) {
  const Eigen::Matrix3d axes = AxesOf(view);
  const int pixels = kFiner * side;
  std::vector<Vector3d> places;
  for (const Vector3d& v : soup.vertices) {
    const Vector3d at = axes * (v - extent.centre) * (pixels / extent.side);
    places.emplace_back(pixels / 2.0 + at.x(), pixels / 2.0 - at.y(), at.z());
  }
  Canvas canvas(pixels);
  if (soup.facets.empty()) {
    DrawPoints(places, canvas);
  } else {
    DrawFacets(soup, places, canvas);
    canvas.DrawJumps(kJump * pixels);
  }
  return render::Shrink(canvas.ToImage(), kFiner);
}

}  // namespace regrasp
