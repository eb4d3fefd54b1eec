#pragma once

#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/object/triangle_mesh.h"

namespace regrasp::object {
class Polygon;
class Polyhedron;
}  // namespace regrasp::object

namespace regrasp::sampling {

/// Random contacts on an object's surface, in space and in the plane; never in a sealed cavity.
///
/// Its *facets* are the triangles of a solid (Turk 1990) and the edges of a polygon.
class SurfaceSampler {
 public:
  /// Over the diameter: on the border of its face the least slip takes a finger to the next face.
  /// Far more than a good grasp slips.
  static constexpr double kFromBorder = 2e-4;
  /// An edge at which the normal turns by no more than this, radians, is nearly flat: a fingertip
  /// that crosses it stays within every usual friction cone.
  static constexpr double kNearlyFlatAngle = 0.35;
  /// Area over perimeter is half the inradius of a square or a disc, and all of it of a thin strip.
  static constexpr double kSmallFaceClearance = 0.6;
  /// Contacts drawn for one that is valid.
  static constexpr int kMostDraws = 1000;

  /// @param object  outlives this object.
  /// @param finger_radius  its unit of length; 0: points.
  /// @param clearance  least distance of a valid contact from the sharp edges of its face, in
  ///     diameters. On a face too small for that the distance is kSmallFaceClearance of the face's
  ///     area over its perimeter, so every face keeps part of its area. At least kFromBorder, if
  ///     that is less than `clearance`, also applies to nearly flat edges. In the plane the
  ///     distance is `clearance` from both ends of an edge.
  explicit SurfaceSampler(const object::Object& object, double finger_radius = 0,
                          double clearance = kFromBorder);

  /// Whether a finger can be placed at a contact (CanRest, CanReach), away from the border of
  /// its face: by kFromBorder from every edge, by the clearance from sharp edges.
  [[nodiscard]] bool IsValid(const grasp::Contact& contact) const;

  /// Of a solid, by area.
  [[nodiscard]] object::TriangleIndex DrawTriangle(RandomStream& random) const;

  /// Evenly over the whole surface, valid or not.
  [[nodiscard]] grasp::Contact DrawAnywhere(RandomStream& random) const;
  /// Evenly over the whole surface where it is valid; nullopt where none of kMostDraws draws is.
  [[nodiscard]] std::optional<grasp::Contact> TryDraw(RandomStream& random) const;

  /// Evenly over the whole surface or over one face (of no cavity), where it is valid. On nearly
  /// all of a surface contacts are: where none of kMostDraws draws is, one that is not.
  [[nodiscard]] grasp::Contact Draw(RandomStream& random) const;
  [[nodiscard]] grasp::Contact DrawOn(FaceIndex face, RandomStream& random) const;

  /// Near a contact, on its face: beside it by no more than `reach` along each axis of the face, or
  /// where that is off the face about as far from the border there. May be invalid: that costs more
  /// to find out than whether the contact makes a grasp.
  [[nodiscard]] grasp::Contact DrawNear(const grasp::Contact& contact, double reach,
                                        RandomStream& random) const;
  /// The same on whatever face is there; the contact itself where none is.
  [[nodiscard]] grasp::Contact DrawAround(const grasp::Contact& contact, double reach,
                                          RandomStream& random) const;

  /// Area of the surface, length of the boundary.
  [[nodiscard]] double measure() const { return up_to_.back(); }

 private:
  [[nodiscard]] bool IsOffBorder(const grasp::Contact& contact) const;
  /// Of the running sums: some facets that follow each other.
  struct Range {
    double from, to;
  };

  [[nodiscard]] double MeasureOf(int facet) const;
  [[nodiscard]] Range Everywhere() const { return {0, measure()}; }
  [[nodiscard]] Range RangeOf(FaceIndex face) const;
  /// A place among the running sums, and the facet there by its place in facets_.
  [[nodiscard]] double DrawSum(const Range& range, RandomStream& random) const;
  [[nodiscard]] std::size_t PlaceAt(double sum) const;
  [[nodiscard]] grasp::Contact DrawIn(const Range& range, RandomStream& random) const;
  [[nodiscard]] std::optional<grasp::Contact> DrawValid(const Range& range,
                                                        RandomStream& random) const;
  /// A point of the plane that touches at the contact, in the plane of its line.
  [[nodiscard]] Eigen::Vector3d DrawBeside(const grasp::Contact& contact, double reach,
                                           RandomStream& random) const;
  /// A point of the face no farther than `reach` from a point of its border.
  [[nodiscard]] Eigen::Vector3d DrawInwards(FaceIndex face, const Eigen::Vector3d& border,
                                            double reach, RandomStream& random) const;

  const object::Object& object_;
  double finger_radius_;
  double clearance_;                 ///< from sharp edges, in the object's unit of length
  const object::Polyhedron* solid_;  ///< the object, in space
  const object::Polygon* polygon_;   ///< the object, in the plane
  std::vector<int> facets_;          ///< those of one face together
  std::vector<double> up_to_;        ///< running sums of their measures
  std::vector<int> first_facet_;     ///< by face: place in facets_, and their number at the end
};

[[nodiscard]] double TriangleArea(const object::Polyhedron& solid, object::TriangleIndex triangle);

/// The contact at a point of a triangle of the solid: its face's normal, p on the face.
[[nodiscard]] grasp::Contact ContactOnTriangle(const object::Polyhedron& solid,
                                               object::TriangleIndex triangle,
                                               const Eigen::Vector3d& p);

}  // namespace regrasp::sampling
