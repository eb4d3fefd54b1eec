#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/index.h"
#include "planner/object/mass_properties.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::object {

/// Where a face meets another one: a straight segment in space, a vertex of the polygon (a = b) in
/// the plane.
struct FaceBorder {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  FaceIndex beyond = {};  ///< the other face
  /// No finger that touches both faces here is in a concave edge: less than 180° of material, up to
  /// kCoplanarAngle.
  bool convex = false;
};

/// A face: what is said of it alike in plane and space.
struct Face {
  Eigen::Vector3d inward_normal = Eigen::Vector3d::Zero();  ///< of length 1, into the material
  double measure = 0;                                       ///< area of a face, length of an edge
  /// All that it has with others. In space the outline and holes, a to b with the material of the
  /// face on the left seen from outside; in the plane where the edge begins, then where it ends.
  std::vector<FaceBorder> borders;
  bool enclosed = false;  ///< as Object::IsEnclosed
  bool invented = false;  ///< as Object::IsInvented
  bool barred = false;    ///< not Object::TakesFingers
};

/// The object that is grasped: a solid bounded by flat faces, or a polygon bounded by edges.
///
/// A *face* is a maximal set of coplanar neighbouring facets in space, an edge in the plane. Planar
/// objects live in the plane z = 0 of the same vectors, so that contacts, plans, the checker and
/// the pictures are written once. All lengths are the object file's own units. An Object is valid
/// by construction: closed, oriented, free of self-intersection, one solid, or several that are
/// asked for as one rigid body (shells.h). It does not change.
class Object {
 public:
  virtual ~Object() = default;

  /// 2 for a polygon, 3 for a solid.
  [[nodiscard]] int dimension() const { return dimension_; }

  /// Faces of a solid, edges of a polygon (holes included).
  [[nodiscard]] int face_count() const { return static_cast<int>(faces_.size()); }

  /// The unit normal of a face, pointing into the material.
  [[nodiscard]] const Eigen::Vector3d& inward_normal(FaceIndex face) const {
    return faces_[face].inward_normal;
  }

  /// Area of a face, length of an edge.
  [[nodiscard]] double face_measure(FaceIndex face) const { return faces_[face].measure; }

  /// The point of the face nearest to `point`.
  [[nodiscard]] virtual Eigen::Vector3d ClosestPoint(FaceIndex face,
                                                     const Eigen::Vector3d& point) const = 0;

  /// The faces within `tolerance` of `point`, nearest first, ties by index.
  [[nodiscard]] virtual std::vector<FaceIndex> FacesNear(const Eigen::Vector3d& point,
                                                         double tolerance) const = 0;

  /// The faces within `tolerance` of some point of the segment ab, by index.
  [[nodiscard]] virtual std::vector<FaceIndex> FacesNearSegment(const Eigen::Vector3d& a,
                                                                const Eigen::Vector3d& b,
                                                                double tolerance) const = 0;

  /// Distance from `point` to the face's border (its outline and the outlines of its holes).
  [[nodiscard]] virtual double DistanceToBorder(FaceIndex face,
                                                const Eigen::Vector3d& point) const = 0;

  /// True iff a point that goes from a to b stays on the face: every point of the segment is within
  /// `tolerance` of it, and, seen along the face's normal, none is beside it once the ends are
  /// moved by no more than about the tolerance. Faces need not be convex and may have holes and
  /// slits: both ends inside is not enough, and a slit that is narrower than the tolerance still
  /// parts a face.
  [[nodiscard]] virtual bool ContainsSegment(FaceIndex face, const Eigen::Vector3d& a,
                                             const Eigen::Vector3d& b, double tolerance) const = 0;

  /// All the borders of a face with others.
  [[nodiscard]] const std::vector<FaceBorder>& BordersOf(FaceIndex face) const {
    return faces_[face].borders;
  }

  /// True iff two different faces have a border in common. Takes some nanoseconds where they have
  /// few borders.
  [[nodiscard]] bool AreNeighbours(FaceIndex face, FaceIndex other) const;

  /// Points that two different faces have in common within `tolerance` of `point`: of each border
  /// of the two the nearest one, and the vertices at which they merely touch. Faces that are near
  /// each other, on the two sides of a thin wall, have none.
  [[nodiscard]] std::vector<Eigen::Vector3d> CommonPoints(FaceIndex face, FaceIndex other,
                                                          const Eigen::Vector3d& point,
                                                          double tolerance) const;

  /// True iff the face is a wall of a sealed cavity: of a shell that the outside does not see. No
  /// finger comes there, however thin. Never in the plane, where a finger comes from above.
  [[nodiscard]] bool IsEnclosed(FaceIndex face) const { return faces_[face].enclosed; }

  /// True iff a repair invented the face, where the original surface has a gap (repair/repair.h).
  [[nodiscard]] bool IsInvented(FaceIndex face) const { return faces_[face].invented; }

  /// True iff planners place fingers on the face: it can be reached, and it is known to be there or
  /// Reading::allow_invented says that this is no matter.
  [[nodiscard]] bool TakesFingers(FaceIndex face) const { return !faces_[face].barred; }

  /// True iff at a point of a face the face's normal is not what a fingertip would feel
  /// (patch_normal.h), as it is on scans and beside edges: planners place no finger there. Never
  /// unless Reading::patch asks for it, and never in the plane.
  [[nodiscard]] virtual bool IsRough(FaceIndex /*face*/, const Eigen::Vector3d& /*point*/) const {
    return false;
  }

  /// Largest distance between two vertices, D.
  [[nodiscard]] double diameter() const { return diameter_; }

  /// Where torques are taken and over what length: the centroid, and R = D/2.
  [[nodiscard]] WrenchFrame wrench_frame() const {
    return {mass_properties_.centroid, diameter_ / 2, dimension()};
  }

  [[nodiscard]] const MassProperties& mass_properties() const { return mass_properties_; }

 protected:
  Object(int dimension, std::vector<Face> faces, double diameter, MassProperties mass_properties)
      : dimension_(dimension),
        faces_(std::move(faces)),
        diameter_(diameter),
        mass_properties_(std::move(mass_properties)) {}
  Object(const Object&) = default;
  Object(Object&&) = default;
  Object& operator=(const Object&) = default;
  Object& operator=(Object&&) = default;

 private:
  int dimension_;
  std::vector<Face> faces_;
  double diameter_;
  MassProperties mass_properties_;
};

/// Points this close to the surface, and to each other where they must agree, count as there:
/// the tolerance for reading, relative to the object's diameter (docs/formats.md).
inline constexpr double kPointTolerance = 1e-6;

/// Facets whose normals differ by no more than this (radians) are one face.
inline constexpr double kCoplanarAngle = 1e-4;

/// Whether the material turns by less than 180° where one goes from a face to the next across an
/// edge along `along`, which has the first face on its left seen from outside. All of length 1.
[[nodiscard]] inline bool IsConvexTurn(const Eigen::Vector3d& normal, const Eigen::Vector3d& next,
                                       const Eigen::Vector3d& along) {
  return normal.cross(next).dot(along) > -kCoplanarAngle;
}

/// What is asked of the repair of a surface that is no solid (repair/repair.h): with it the same
/// file gives the same solid again.
struct RepairOptions {
  /// 95 % of the surface that is seen from outside lies within this of the solid; over the
  /// diameter.
  double max_deviation = 0.01;
  std::optional<int> facets;        ///< at most so many triangles
  std::optional<int> part;          ///< of several solids the one so many-th by volume, from 1
  std::optional<double> thickness;  ///< of the wall that an open sheet becomes, the object's unit

  bool operator==(const RepairOptions&) const = default;
};

/// What is made of several closed shells; without a choice they are refused, but for a solid and
/// its cavities.
enum class Shells {
  /// All solids that they bound are one rigid body, wherever they are: shells beside each other,
  /// and those inside others. What lies in the material of another is left out. None meets another.
  kUnion,
  /// The one of the largest volume, with its cavities; the others are left out, whatever they meet.
  kLargest,
};

/// That an object was made of a file by a repair.
struct RepairRecord {
  RepairOptions options;
  std::string sha256;  ///< of the solid's bytes, as the program `repair` writes it

  bool operator==(const RepairRecord&) const = default;
};

/// An object together with the file that it was read from.
struct ObjectFile {
  std::string file;    ///< name without folders, as plans name it
  std::string sha256;  ///< of the file's bytes
  std::unique_ptr<const Object> object;
  std::optional<RepairRecord> repair = std::nullopt;  ///< where it is not the file's own surface
  std::string unit = {};                              ///< as PolygonSoup::unit
};

/// Reads a solid (OBJ, OFF, PLY, STL in double precision; every other format through assimp in a
/// limited child process) or a polygon (WKT; files that end in .wkt), by the file's ending.
/// @throws InputError  names the file, the element and what is wrong with it.
[[nodiscard]] ObjectFile ReadObject(const std::filesystem::path& path);

}  // namespace regrasp::object
