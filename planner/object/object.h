#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/deadline.h"
#include "planner/base/index.h"
#include "planner/object/wrench_frame.h"

namespace regrasp::object {

/// Border of a face with another one: a segment in space, a vertex of the polygon (a = b) in the
/// plane.
struct FaceBorder {
  Eigen::Vector3d a;
  Eigen::Vector3d b;
  FaceIndex beyond = {};  ///< the other face
  /// Whether the material angle here is below 180°, up to kCoplanarAngle. A finger that touches
  /// both faces is then not in a concave edge.
  bool convex = false;
};

/// Properties of a face that are the same in plane and space.
struct Face {
  Eigen::Vector3d inward_normal = Eigen::Vector3d::Zero();  ///< unit normal, into the material
  double measure = 0;                                       ///< area of a face, length of an edge
  /// All borders with other faces. In space: outline and holes, directed from a to b with the face
  /// on the left as seen from outside. In the plane: the start of the edge, then its end.
  std::vector<FaceBorder> borders;
  bool enclosed = false;  ///< same as Object::IsEnclosed
  bool filled = false;    ///< same as Object::IsFilled
  bool barred = false;    ///< negation of Object::TakesFingers
};

/// The object to grasp: a solid bounded by planar faces, or a polygon bounded by edges.
///
/// A *face* is a maximal set of adjacent coplanar triangles in space, an edge in the plane. Planar
/// objects are in the plane z = 0 and use the same 3D vectors, so that contacts, plans, the checker
/// and images have one implementation. All lengths are in units of the object file. An Object is
/// immutable and valid by construction: closed, oriented, free of self-intersection and connected.
/// With Shells::kUnion it may consist of several solids that move as one rigid body.
class Object {
 public:
  virtual ~Object() = default;

  /// 2 for a polygon, 3 for a solid.
  [[nodiscard]] int dimension() const { return dimension_; }

  /// Number of faces of a solid or edges of a polygon (holes included).
  [[nodiscard]] int face_count() const { return static_cast<int>(faces_.size()); }

  /// Unit normal of a face, pointing into the material.
  [[nodiscard]] const Eigen::Vector3d& inward_normal(FaceIndex face) const {
    return faces_[face].inward_normal;
  }

  /// Area of a face, length of an edge.
  [[nodiscard]] double face_measure(FaceIndex face) const { return faces_[face].measure; }

  /// Return the point of the face nearest to `point`.
  [[nodiscard]] virtual Eigen::Vector3d ClosestPoint(FaceIndex face,
                                                     const Eigen::Vector3d& point) const = 0;

  /// Return the faces within `tolerance` of `point`, nearest first, ties by index.
  [[nodiscard]] virtual std::vector<FaceIndex> FacesNear(const Eigen::Vector3d& point,
                                                         double tolerance) const = 0;

  /// Return the faces within `tolerance` of some point of the segment ab, sorted by index.
  [[nodiscard]] virtual std::vector<FaceIndex> FacesNearSegment(const Eigen::Vector3d& a,
                                                                const Eigen::Vector3d& b,
                                                                double tolerance) const = 0;

  /// Return the distance from `point` to the face's border (outlines of the face and of its holes).
  [[nodiscard]] virtual double DistanceToBorder(FaceIndex face,
                                                const Eigen::Vector3d& point) const = 0;

  /// Return whether a point that moves straight from a to b stays on the face.
  ///
  /// Every point of the segment must be within `tolerance` of the face. Also, the segment's
  /// projection along the face's normal must be inside the face, after moving the ends by at most
  /// about the tolerance. Faces may be non-convex and have holes and slits, so it is not enough
  /// that both ends are inside. A slit divides a face even if it is narrower than the tolerance.
  [[nodiscard]] virtual bool ContainsSegment(FaceIndex face, const Eigen::Vector3d& a,
                                             const Eigen::Vector3d& b, double tolerance) const = 0;

  /// All borders of a face with other faces.
  [[nodiscard]] const std::vector<FaceBorder>& BordersOf(FaceIndex face) const {
    return faces_[face].borders;
  }

  /// Return whether two different faces have a common border. Takes nanoseconds for few borders.
  [[nodiscard]] bool AreNeighbours(FaceIndex face, FaceIndex other) const;

  /// Return points of both faces within `tolerance` of `point`, for two different faces.
  ///
  /// These are the nearest point of each common border, and the vertices at which the faces merely
  /// touch. Faces that are only close to each other, such as the two sides of a thin wall, have
  /// none.
  [[nodiscard]] std::vector<Eigen::Vector3d> CommonPoints(FaceIndex face, FaceIndex other,
                                                          const Eigen::Vector3d& point,
                                                          double tolerance) const;

  /// Whether the face is a wall of a sealed cavity, that is, of a shell inside the outer one.
  ///
  /// No finger can reach it. Always false in the plane, because a finger approaches from above.
  [[nodiscard]] bool IsEnclosed(FaceIndex face) const { return faces_[face].enclosed; }

  /// Whether a repair added the face to fill a gap of the original surface (repair/repair.h).
  [[nodiscard]] bool IsFilled(FaceIndex face) const { return faces_[face].filled; }

  /// Whether planners may place fingers on the face: it is not enclosed, and not a filled surface
  /// unless Reading::allow_filled is set.
  [[nodiscard]] bool TakesFingers(FaceIndex face) const { return !faces_[face].barred; }

  /// Return whether the normal of a contact patch deviates from the face's normal by more than
  /// FeltPatch::most_angle.
  ///
  /// This happens on scans and near edges (polyhedron.h); planners place no finger there. Always
  /// false in the plane and without Reading::patch.
  [[nodiscard]] virtual bool IsRough(FaceIndex /*face*/, const Eigen::Vector3d& /*point*/) const {
    return false;
  }

  /// Largest distance between two vertices, D.
  [[nodiscard]] double diameter() const { return diameter_; }

  /// Frame of wrenches: the centroid and R = D/2.
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

/// Point tolerance divided by the object's diameter (docs/formats.md).
///
/// Points count as on the surface, and as equal if required, within this distance when files are
/// read.
inline constexpr double kPointTolerance = 1e-6;

/// Largest angle between normals of adjacent polygons of one face, rad.
inline constexpr double kCoplanarAngle = 1e-4;

/// Return whether the material angle at an edge between two faces is below 180°.
/// @param normal  inward unit normal of the first face.
/// @param next  inward unit normal of the second face.
/// @param along  unit vector along the edge, with the first face on its left as seen from outside.
[[nodiscard]] inline bool IsConvexTurn(const Eigen::Vector3d& normal, const Eigen::Vector3d& next,
                                       const Eigen::Vector3d& along) {
  return normal.cross(next).dot(along) > -kCoplanarAngle;
}

/// Options of the repair of a surface that is not a closed solid (repair/repair.h). The same file
/// and options always result in the same solid.
struct RepairOptions {
  /// Largest distance from the solid of 95 % of the surface that is visible from outside, divided
  /// by the diameter.
  double max_deviation = 0.01;
  std::optional<int> facets;        ///< maximum number of triangles
  std::optional<int> part;          ///< rank by volume of the solid to keep, from 1
  std::optional<double> thickness;  ///< wall thickness for an open sheet, in object units

  bool operator==(const RepairOptions&) const = default;
};

/// Treatment of several closed shells. Without a choice they are rejected, unless they are a solid
/// and its cavities.
enum class Shells {
  /// All solids bounded by the shells form one rigid body, next to or inside each other. Shells
  /// inside the material of another are dropped. Shells must not intersect.
  kUnion,
  /// The solid of the largest volume, with its cavities. All other shells are dropped, whatever
  /// they intersect.
  kLargest,
};

/// Record of the repair by which an object was made from a file.
struct RepairRecord {
  RepairOptions options;
  std::string sha256;  ///< hash of the solid's bytes, as written by `repair`

  bool operator==(const RepairRecord&) const = default;
};

/// An object with the file from which it was read.
struct ObjectFile {
  std::string file;    ///< file name without folders, as in plans
  std::string sha256;  ///< hash of the file's bytes
  std::unique_ptr<const Object> object;
  std::optional<RepairRecord> repair = std::nullopt;  ///< set if the surface is not the file's own
  std::string unit = {};                              ///< same as PolygonSoup::unit
};

/// Read a solid or a polygon; the extension of the file name selects the format.
///
/// Solids: OBJ, OFF, PLY and STL in double precision, every other format in a limited child
/// process. Polygons: WKT (`.wkt`).
/// @throws InputError  if the file is invalid; names the file, the element and the problem.
[[nodiscard]] ObjectFile ReadObject(const std::filesystem::path& path);

/// Contact patch by which a fingertip feels the surface normal (polyhedron.h).
struct FeltPatch {
  std::optional<double> radius;  ///< radius in object units; default kUsualPatch · D
  double most_angle = 0;  ///< largest angle between the contact's and the patch's normal, rad
};

/// Default radius of a contact patch divided by the diameter: about a finger's width on an object
/// held in one hand.
inline constexpr double kUsualPatch = 0.02;

/// Options, callbacks and deadline for reading an object.
struct Reading {
  /// Callback with the name of each stage.
  std::function<void(std::string_view)> progress = [](std::string_view) {};
  Deadline deadline;
  /// If set, points with a rough patch take no fingers.
  std::optional<FeltPatch> patch = std::nullopt;
  bool allow_filled = false;   ///< whether filled surfaces of a repair take fingers
  bool counts_defects = true;  ///< whether a rejection counts all defects (mesh_survey.h)
  std::optional<Shells> shells =
      std::nullopt;  ///< treatment of several shells; unused on a valid surface
  /// Callback with a text on the treatment of several closed shells, if `shells` had an effect.
  std::function<void(const std::string&)> on_shells = [](const std::string&) {};

  /// Begin a stage. The deadline is checked only here: stages are not interrupted, except for
  /// assimp, whose process is killed.
  /// @throws TimeUp  if the deadline is reached.
  void Begin(const std::string& stage) const {
    deadline.Check();
    progress(stage);
  }
};

/// Read an object with options; see ReadObject(path).
/// @throws TimeUp  if the deadline is reached; names the file.
[[nodiscard]] ObjectFile ReadObject(const std::filesystem::path& path, const Reading& reading);

}  // namespace regrasp::object
