#pragma once

#include <memory>
#include <span>

#include "planner/object/polyhedron.h"
#include "planner/sets/polyhedron/face_part.h"

namespace regrasp {

/// The union volumes of a solid's faces as CGAL's Nef polyhedra, with pyramids of eight sides
/// inscribed in the friction cones, cut off some diameters from the face: what Phoka 2010
/// intersects.
class NefVolumes {
 public:
  /// @param faces    whose volumes are made; each must be one part.
  /// @param tangent  of the friction half-angle.
  NefVolumes(const object::Polyhedron& solid, const polyhedron::FaceParts& parts,
             std::span<const int> faces, double tangent);
  ~NefVolumes();

  /// Whether the volumes of four faces have an interior in common; that alone is what a benchmark
  /// should measure.
  [[nodiscard]] bool HasCell(std::span<const FaceIndex, 4> faces) const;

 private:
  struct Volumes;
  std::unique_ptr<Volumes> volumes_;
};

}  // namespace regrasp
