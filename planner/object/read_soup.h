#pragma once

#include <filesystem>
#include <string>

#include "planner/object/polygon_soup.h"
#include "planner/object/reading.h"

namespace regrasp::object {

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
