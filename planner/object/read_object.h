#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "planner/object/polygon_soup.h"
#include "planner/object/reading.h"

namespace regrasp::object {

// Readers of common surface formats, in double precision and independent of the locale.
//
// They read vertices and polygons and skip all other elements (normals, colours, textures).
// They never allocate memory by an unverified header. The readers of CGAL and assimp are not used
// because they report only that a file is bad; here, messages name the element. All throw
// InputError with one line that names the line, polygon or vertex. Polyhedron checks the surface
// itself.

/// Read Wavefront OBJ: `v` and `f` (positive or negative indices, with or without texture and
/// normal).
[[nodiscard]] PolygonSoup ReadObj(std::string_view text, const std::string& name);

/// Read OFF as text, and its variants such as COFF and NOFF.
[[nodiscard]] PolygonSoup ReadOff(std::string_view text, const std::string& name);

/// Read PLY: ascii, binary_little_endian and binary_big_endian.
///
/// Elements and properties may have any kind and order around `vertex` (x, y, z) and `face`
/// (vertex_indices or vertex_index).
[[nodiscard]] PolygonSoup ReadPly(std::string_view bytes, const std::string& name);

/// Read STL, ASCII or binary. Triangles share no vertices; equal coordinates are merged later.
[[nodiscard]] PolygonSoup ReadStl(std::string_view bytes, const std::string& name);

// Readers of point clouds: vertices without polygons. Only a repair makes a solid from them.
// Normals, colours and all other properties of points are skipped.

/// Read XYZ or PWN: one point per line, its first three numbers.
[[nodiscard]] PolygonSoup ReadXyz(std::string_view text, const std::string& name);

/// Read PCD 0.7, ascii or binary; points that are not finite are dropped.
[[nodiscard]] PolygonSoup ReadPcd(std::string_view bytes, const std::string& name);

/// Unchecked contents of a surface file.
struct SoupFile {
  std::string file;    ///< file name without folders
  std::string sha256;  ///< hash of the file's bytes
  PolygonSoup soup;
};

/// Read a surface without checking it.
/// @throws InputError  if the file cannot be read or is a WKT polygon.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] SoupFile ReadSoup(const std::filesystem::path& path, const Reading& reading);

}  // namespace regrasp::object
