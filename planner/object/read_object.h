#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "planner/object/polygon_soup.h"
#include "planner/object/reading.h"

namespace regrasp::object {

// Readers of the common surface formats, in double precision and the same under any locale.
//
// They read what the surface needs (vertices and facets) and skip the rest (normals, colours,
// textures, groups). What a header declares is never trusted with memory. They are written here
// because CGAL's and assimp's say only that a file is bad, and a message must name the element.
// All throw InputError, one line that names the line, facet or vertex; what the surface itself must
// be like is not their business but Polyhedron's.

/// Wavefront OBJ: `v` and `f` (positive or negative indices, with or without texture and normal).
[[nodiscard]] PolygonSoup ReadObj(std::string_view text, const std::string& name);

/// OFF, also COFF, NOFF and their like, as text.
[[nodiscard]] PolygonSoup ReadOff(std::string_view text, const std::string& name);

/// PLY: ascii, binary_little_endian and binary_big_endian; elements and properties of any kind and
/// order around `vertex` (x, y, z) and `face` (vertex_indices or vertex_index).
[[nodiscard]] PolygonSoup ReadPly(std::string_view bytes, const std::string& name);

/// STL, ASCII or binary. Facets share no vertices here: equal coordinates are merged later.
[[nodiscard]] PolygonSoup ReadStl(std::string_view bytes, const std::string& name);

// Clouds of points: vertices without facets, of which only a repair makes a body. Normals, colours
// and what else a file has of a point are skipped.

/// XYZ (also PWN): a point a line, its first three numbers.
[[nodiscard]] PolygonSoup ReadXyz(std::string_view text, const std::string& name);

/// PCD 0.7, ascii and binary; points that are not finite are left out.
[[nodiscard]] PolygonSoup ReadPcd(std::string_view bytes, const std::string& name);

/// What a file of a surface holds, unchecked.
struct SoupFile {
  std::string file;    ///< name without folders
  std::string sha256;  ///< of the file's bytes
  PolygonSoup soup;
};

/// Reads a surface as the file gives it.
/// @throws InputError  it cannot be read, or holds a polygon.
/// @throws TimeUp  the deadline came.
[[nodiscard]] SoupFile ReadSoup(const std::filesystem::path& path, const Reading& reading);

}  // namespace regrasp::object
