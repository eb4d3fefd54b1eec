#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/error.h"

namespace regrasp::object {

/// Unchecked vertices and polygons (`facets`) of a file.
///
/// A polygon lists vertex indices, counter-clockwise from outside. It may be non-convex, but has no
/// holes.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> facets;
  /// For each polygon, whether it fills a gap and is not part of the scanned or drawn surface.
  /// Empty if no polygon is.
  std::vector<bool> filled = {};
  /// Name of the unit of length in the file, such as "inches"; empty if the file has none. If set,
  /// vertices are in metres.
  std::string unit = {};
};

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

/// Serialize a soup for another process on the same machine.
[[nodiscard]] std::string SoupToBytes(const PolygonSoup& soup);

/// Deserialize a soup. @returns nullopt if the bytes are not those of a complete soup.
[[nodiscard]] std::optional<PolygonSoup> SoupFromBytes(std::string_view bytes);

}  // namespace regrasp::object
