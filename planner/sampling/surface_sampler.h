#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {
class Polygon;
class Polyhedron;
}  // namespace regrasp::object

namespace regrasp::sampling {

/// Sampler of random contacts on an object's surface, in space and in the plane.
/// Sealed cavities are excluded. In names, `facets` are the triangles of a solid (Turk 1990) or the
/// edges of a polygon.
class SurfaceSampler {
 public:
  /// Smallest distance from a face's border over the diameter. On the border the least slip moves a
  /// finger to the next face. This distance far exceeds the slip of a good grasp.
  static constexpr double kFromBorder = 2e-4;
  /// Largest change of the normal across a nearly flat edge, radians. A fingertip that crosses such
  /// an edge stays within all usual friction cones.
  static constexpr double kNearlyFlatAngle = 0.35;
  /// Clearance on small faces, relative to area over perimeter. This ratio is half the inradius of
  /// a square or a disc, and the whole inradius of a thin strip.
  static constexpr double kSmallFaceClearance = 0.6;
  /// Largest number of draws per valid contact.
  static constexpr int kMostDraws = 1000;

  /// @param object  object to sample; outlives this object.
  /// @param finger_radius  radius of the fingers in object units; 0: points.
  /// @param clearance  least distance of a valid contact from the sharp edges of its face, in
  ///     diameters. On a face too small for that the distance is kSmallFaceClearance of the face's
  ///     area over its perimeter, so every face keeps part of its area. At least kFromBorder, if
  ///     that is less than `clearance`, also applies to nearly flat edges. In the plane the
  ///     distance is `clearance` from both ends of an edge.
  explicit SurfaceSampler(const object::Object& object, double finger_radius = 0,
                          double clearance = kFromBorder);

  /// Return whether a finger can be placed at a contact (CanRest, CanReach).
  /// The contact must be away from the border of its face: by kFromBorder from every edge, by the
  /// clearance from sharp edges.
  [[nodiscard]] bool IsValid(const grasp::Contact& contact) const;

  /// Draw a triangle of a solid by area.
  [[nodiscard]] object::TriangleIndex DrawTriangle(RandomStream& random) const;

  /// Draw a contact uniformly over the whole surface, valid or not.
  [[nodiscard]] grasp::Contact DrawAnywhere(RandomStream& random) const;
  /// Draw a valid contact uniformly over the whole surface.
  /// @returns nullopt if none of kMostDraws draws is valid.
  [[nodiscard]] std::optional<grasp::Contact> TryDraw(RandomStream& random) const;

  /// Draw a contact uniformly over the whole surface, or over one face outside cavities.
  /// The contact is valid unless none of kMostDraws draws is, which is rare.
  [[nodiscard]] grasp::Contact Draw(RandomStream& random) const;
  [[nodiscard]] grasp::Contact DrawOn(FaceIndex face, RandomStream& random) const;

  /// Draw a contact near another one on its face.
  /// The displacement is at most `reach` along each axis of the face. If that is outside the face,
  /// the contact is about as far from the border as the displacement. It can be invalid, because a
  /// validity test costs more than a test of the grasp.
  [[nodiscard]] grasp::Contact DrawNear(const grasp::Contact& contact, double reach,
                                        RandomStream& random) const;
  /// Draw a contact near another one on any face nearby; returns `contact` if there is none.
  [[nodiscard]] grasp::Contact DrawAround(const grasp::Contact& contact, double reach,
                                          RandomStream& random) const;

  /// Return the area of the surface, or the length of the boundary.
  [[nodiscard]] double measure() const { return up_to_.back(); }

 private:
  [[nodiscard]] bool IsOffBorder(const grasp::Contact& contact) const;
  /// Range of running sums, for consecutive entries of facets_.
  struct Range {
    double from, to;
  };

  [[nodiscard]] double MeasureOf(int facet) const;
  [[nodiscard]] Range Everywhere() const { return {0, measure()}; }
  [[nodiscard]] Range RangeOf(FaceIndex face) const;
  /// Draw a position in the running sums, or return the index in facets_ at a position.
  [[nodiscard]] double DrawSum(const Range& range, RandomStream& random) const;
  [[nodiscard]] std::size_t PlaceAt(double sum) const;
  [[nodiscard]] grasp::Contact DrawIn(const Range& range, RandomStream& random) const;
  [[nodiscard]] std::optional<grasp::Contact> DrawValid(const Range& range,
                                                        RandomStream& random) const;
  /// Draw a point near a contact in its tangent plane or tangent line.
  [[nodiscard]] Eigen::Vector3d DrawBeside(const grasp::Contact& contact, double reach,
                                           RandomStream& random) const;
  /// Draw a point of a face within `reach` of a point of its border.
  [[nodiscard]] Eigen::Vector3d DrawInwards(FaceIndex face, const Eigen::Vector3d& border,
                                            double reach, RandomStream& random) const;

  const object::Object& object_;
  double finger_radius_;
  double clearance_;                 ///< distance from sharp edges, object units
  const object::Polyhedron* solid_;  ///< the object in space, otherwise null
  const object::Polygon* polygon_;   ///< the object in the plane, otherwise null
  std::vector<int> facets_;          ///< grouped by face
  std::vector<double> up_to_;        ///< running sums of their measures
  std::vector<int> first_facet_;     ///< first index in facets_ by face, then their number
};

[[nodiscard]] double TriangleArea(const object::Polyhedron& solid, object::TriangleIndex triangle);

/// Return the contact at a point of a triangle: p on the triangle's face, with the face's normal.
[[nodiscard]] grasp::Contact ContactOnTriangle(const object::Polyhedron& solid,
                                               object::TriangleIndex triangle,
                                               const Eigen::Vector3d& p);

/// Negative result: no random grasp is found, or a planner cannot represent a given grasp.
/// Planners convert it to PlanResult::Status::kNoGrasp.
struct NoGrasp {
  std::string message;
};

/// Draw grasps until the evaluator accepts one.
/// @param draw  function that draws a grasp.
/// @returns nullopt if none of `kMaxSurfaceDraws` grasps is accepted.
[[nodiscard]] std::optional<grasp::Grasp> DrawGoodGrasp(const std::function<grasp::Grasp()>& draw,
                                                        const criteria::GraspEvaluator& evaluator);

/// Draw an accepted grasp with contacts uniformly distributed over an object's surface.
/// In the plane the initial number of contacts is random. If no grasp with that number is accepted,
/// the other numbers of the range follow. Two contacts are skipped for polygons without
/// sufficiently opposed edges.
/// @param contacts     range of the number of contacts; in space only its minimum is used.
/// @param name         name of the grasp in messages.
/// @param before_draw  called before each grasp; can throw to stop.
/// @throws NoGrasp  if none of kMaxSurfaceDraws grasps of each number is accepted, or fingers reach
///     almost no part of the surface.
[[nodiscard]] grasp::Grasp DrawOnSurface(
    const object::Object& object, const grasp::ContactLimits& contacts,
    const criteria::GraspEvaluator& evaluator, RandomStream& random, const std::string& name,
    const std::function<void()>& before_draw = [] {});

/// Largest number of drawn grasps. At 1 µs each they take less than a second, and they suffice for
/// objects that accept one grasp in ten thousand.
inline constexpr int kMaxSurfaceDraws = 200'000;

}  // namespace regrasp::sampling
