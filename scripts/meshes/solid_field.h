#pragma once

#include <Eigen/Core>
#include <functional>

namespace regrasp_meshes {

using Point = Eigen::Vector3d;

/// A solid as a scalar field: negative inside, about the distance to the surface near it.
using Field = std::function<double(const Point&)>;

/// Distance to an ellipsoid with semi-axes along x, y and z, exact to first order at its surface.
double Ellipsoid(const Point& p, const Point& centre, const Point& semi_axes);

/// Distance to a ball swept from a to b while its radius grows from `at_a` to `at_b` with the
/// share of the way, to first order in how much it grows.
double SweptBall(const Point& p, const Point& a, const Point& b, double at_a, double at_b);

/// Distance to a ring in the plane z = 0 through its centre.
double Ring(const Point& p, double radius, double tube);

/// Distance in a half-plane (from the axis, along the axis) to a rectangle about the axis, from
/// `low` to `high`, its corners rounded.
double RoundedCylinder(const Point& p, double radius, double low, double high, double rounding);

/// The union of two solids, their meeting smoothed over a width of about `blend`: the smooth
/// minimum min(a, b) − (max(0, w − |a − b|))³ / (6 w²), w = blend (Quilez 2013).
double Join(double a, double b, double blend);

/// What the solid b leaves of the solid a, smoothed alike.
double Cut(double a, double b, double blend);

/// Where the line through p along the field's gradient meets the field's zero (Newton).
/// @throws std::runtime_error  it does not converge.
Point ProjectToSurface(const Field& field, const Point& p);

}  // namespace regrasp_meshes
