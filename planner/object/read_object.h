#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/object/object.h"
#include "planner/object/polygon_soup.h"

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

/// Format of surfaces or point clouds that is read in accordance with its specification.
enum class SurfaceFormat { kObj, kOff, kPly, kStl, kXyz, kPcd, k3mf, kGltf, kCollada, kFbx };

/// Determine the format of a file.
///
/// The extension of the file name determines it. For a name without extension, such as that of a
/// pipe, the first bytes determine it. Every other format is rejected, although assimp reads about
/// forty more. assimp swaps the axes of some (3DS, ASE, DXF), mirrors others (X) and ignores units
/// (AMF, X3D).
/// @param path   name of the file.
/// @param bytes  its contents.
/// @throws InputError  if the format is not supported; names file, extension and supported
///     extensions.
[[nodiscard]] SurfaceFormat FormatOf(const std::filesystem::path& path, std::string_view bytes);

/// Largest distance of a contact from a point of the file, divided by the diameter, to count as on
/// it.
///
/// It is 0.1 mm for an object of 10 cm. A point of the file is a corner of several triangles, so a
/// contact has no normal there. A contact next to it, on one of the triangles, has.
inline constexpr double kAtGivenPoint = 1e-3;

/// Read the points of a file: those of a point cloud, or the vertices of a surface.
/// @throws InputError  if the file cannot be read or is a WKT polygon.
/// @throws TimeUp  if the deadline is reached.
[[nodiscard]] std::vector<Eigen::Vector3d> ReadGivenPoints(const std::filesystem::path& path,
                                                           const Reading& reading);

/// Return the point nearest to `place`. @pre `points` is not empty.
[[nodiscard]] const Eigen::Vector3d& NearestPoint(std::span<const Eigen::Vector3d> points,
                                                  const Eigen::Vector3d& place);

/// Read the bytes of a 3MF file; coordinates are converted to metres.
///
/// Build items and their components place the objects. The unit is millimetre if the model names
/// none. assimp 5.2 is not used because it crashes on components and ignores the unit. Call it only
/// in a process that may crash: see ReadWithAssimp. Source: 3MF Core Specification 1.3, chapters 3
/// and 4.
/// @throws InputError  if the bytes are not a ZIP archive with a model in XML, a number or a
///     reference is invalid, or there are more than kMaxFacets triangles; the text does not contain
///     the file's name.
[[nodiscard]] PolygonSoup Read3mf(std::string_view bytes);

/// Read the bytes of a glTF 2.0 file (`.gltf`, `.glb`), in metres: the triangles of its scene,
/// placed by their nodes.
///
/// Points, lines, materials, cameras and animations are ignored. Features that move or add
/// vertices are refused: skins, morph weights other than 0, instancing, compression, hidden nodes,
/// and every required extension that may change the geometry. A file with several
/// scenes must name one. KHR_mesh_quantization is read.
/// Source: glTF 2.0 Specification (Khronos, 2021).
/// @throws InputError  if the file is invalid; the text has JSON pointer and problem, but no name.
[[nodiscard]] PolygonSoup ReadGltf(std::string_view bytes);

}  // namespace regrasp::object
