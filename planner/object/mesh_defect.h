#pragma once

#include <string>

#include "planner/base/error.h"

namespace regrasp::object {

/// What makes a soup not the surface of one solid.
enum class MeshDefect {
  kEmpty,             ///< no facet, or no volume
  kNotFinite,         ///< a coordinate is NaN, infinite or beyond kMaxCoordinate
  kBadSize,           ///< too small, too thin, or too far from the origin for its size
  kIndexOutOfRange,   ///< a facet names a vertex that is not there
  kDegenerateFacet,   ///< fewer than three corners, a corner named twice, or no area
  kNotPlanar,         ///< a polygon's corners do not lie in one plane
  kNotClosed,         ///< an edge has one facet
  kNotManifold,       ///< an edge has more than two facets, or a vertex joins two fans
  kNotOriented,       ///< neighbouring facets run along their edge the same way
  kSelfIntersecting,  ///< two facets meet elsewhere than at a shared edge or vertex
  kSeveralSolids,     ///< two shells beside each other, or a cavity oriented outward
  kTooLarge,          ///< more facets or entangled pairs of them than can be checked
};

/// A mesh that is refused. `what()` is one line: the file, the facet or vertex as the file counts
/// them (from 0), and what is wrong.
class MeshError : public InputError {
 public:
  MeshError(MeshDefect defect, const std::string& message) : InputError(message), defect_(defect) {}
  [[nodiscard]] MeshDefect defect() const { return defect_; }

 private:
  MeshDefect defect_;
};

}  // namespace regrasp::object
