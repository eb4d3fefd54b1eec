#pragma once

#include <Eigen/Core>
#include <functional>

namespace regrasp_meshes {

using Point = Eigen::Vector3d;

/// Solid as a scalar field: negative inside.
/// Near the surface it is approximately the distance to it.
using Field = std::function<double(const Point&)>;

/// Return the distance to an ellipsoid with semi-axes along x, y and z.
/// It is exact to first order at the surface.
double Ellipsoid(const Point& p, const Point& centre, const Point& semi_axes);

/// Return the distance to a ball swept from a to b. Its radius changes linearly from `at_a` to
/// `at_b`. The result is exact to first order in the change.
double SweptBall(const Point& p, const Point& a, const Point& b, double at_a, double at_b);

/// Return the distance to a ring in the plane z = 0 through its centre.
double Ring(const Point& p, double radius, double tube);

/// Return the distance in a half-plane to a rectangle about the axis.
/// Coordinates are the distance from the axis and along it. The rectangle extends from `low` to
/// `high` and has rounded corners.
double RoundedCylinder(const Point& p, double radius, double low, double high, double rounding);

/// Return the union of two solids, blended over a width of about `blend`. This is the smooth
/// minimum min(a, b) − (max(0, w − |a − b|))³ / (6 w²), w = blend (Quilez 2013).
double Join(double a, double b, double blend);

/// Return the difference of the solids a and b, blended like Join.
double Cut(double a, double b, double blend);

/// Project a point onto the field's zero along the gradient (Newton).
/// @throws std::runtime_error  if the iteration does not converge.
Point ProjectToSurface(const Field& field, const Point& p);

}  // namespace regrasp_meshes
