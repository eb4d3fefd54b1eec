#pragma once

#include <Eigen/Core>
#include <vector>

#include "planner/object/polygon_soup.h"
#include "render/picture/image.h"

namespace regrasp {

/// From where a surface is looked at, along parallel rays.
struct SurfaceView {
  double azimuth_deg = 0;  ///< of the one who looks, about z from x
  double elevation_deg = 0;
};

/// What of space is in a picture: a square across the view.
struct SurfaceExtent {
  Eigen::Vector3d centre;
  double side;
};

/// The smallest extent that has all surfaces in it, with a margin.
[[nodiscard]] SurfaceExtent ExtentOf(const std::vector<const object::PolygonSoup*>& soups,
                                     const SurfaceView& view);

/// Any surface, whether it bounds a solid or not: facets blue from outside and yellow from inside,
/// invented ones red, dark lines where one part hides another. A cloud of points is darker the
/// farther off it is.
/// @param side  pixels.
[[nodiscard]] render::Image DrawSurface(const object::PolygonSoup& soup, const SurfaceView& view,
                                        const SurfaceExtent& extent, int side);

}  // namespace regrasp
