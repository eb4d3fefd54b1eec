#pragma once

#include <memory>
#include <span>

#include "planner/object/polyhedron.h"
#include "planner/sets/polyhedron/face_part.h"

namespace regrasp {

/// Union volumes of a solid's faces as Nef polyhedra of CGAL, whose intersections Phoka 2010 uses.
/// Each friction cone is approximated by an inscribed pyramid with eight sides, cut off at a few
/// diameters from the face.
class NefVolumes {
 public:
  /// @param faces    faces whose volumes are built; each must consist of one part.
  /// @param tangent  tangent of the friction angle.
  NefVolumes(const object::Polyhedron& solid, const polyhedron::FaceParts& parts,
             std::span<const int> faces, double tangent);
  ~NefVolumes();

  /// Return true if the volumes of four faces have a common interior. A benchmark should measure
  /// only this function.
  [[nodiscard]] bool HasCell(std::span<const FaceIndex, 4> faces) const;

 private:
  struct Volumes;
  std::unique_ptr<Volumes> volumes_;
};

}  // namespace regrasp
