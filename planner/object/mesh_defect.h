#pragma once

#include <string>

#include "planner/base/error.h"

namespace regrasp::object {

/// Reason why a soup is not the surface of one solid.
enum class MeshDefect {
  kEmpty,             ///< no polygon, or no volume
  kNotFinite,         ///< a coordinate is NaN, infinite or beyond kMaxCoordinate
  kBadSize,           ///< too small, too thin, or too far from the origin for its size
  kIndexOutOfRange,   ///< a vertex index is out of range
  kDegenerateFacet,   ///< fewer than three corners, a repeated corner, or no area
  kNotPlanar,         ///< the corners of a polygon are not in one plane
  kNotClosed,         ///< an edge has one polygon
  kNotManifold,       ///< an edge has more than two polygons, or a vertex joins two fans
  kNotOriented,       ///< two polygons have their common edge in the same direction
  kSelfIntersecting,  ///< two polygons meet outside their common edge or vertices
  kSeveralSolids,     ///< two shells next to each other, or a cavity oriented outward
  kTooLarge,          ///< too many polygons, or too many pairs that may intersect
};

/// Rejection of a mesh.
///
/// `what()` is one line: the file, the polygon or vertex (numbered from 0 in file order), and the
/// problem.
class MeshError : public InputError {
 public:
  MeshError(MeshDefect defect, const std::string& message) : InputError(message), defect_(defect) {}
  [[nodiscard]] MeshDefect defect() const { return defect_; }

 private:
  MeshDefect defect_;
};

}  // namespace regrasp::object
