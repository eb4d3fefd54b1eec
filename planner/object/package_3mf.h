#pragma once

#include <string>
#include <string_view>

#include "planner/base/zip_archive.h"

namespace regrasp::object {

/// Parts of a 3MF package, by their names in the Open Packaging Conventions.
class Package3mf {
 public:
  /// @param bytes  bytes of the package; must outlive this object.
  /// @throws InputError  if they are not a ZIP archive.
  explicit Package3mf(std::string_view bytes) : archive_(bytes) {}

  /// Find the root model part: the target of the one relationship of that type in `_rels/.rels`.
  /// @returns its normalised name.
  /// @throws InputError  if `_rels/.rels` is missing or has none or several such relationships.
  [[nodiscard]] std::string RootModel();

  /// Read a part.
  /// @param part  name as PartName returns it.
  /// @throws InputError  if there is no such part or several parts of this name.
  [[nodiscard]] std::string Read(const std::string& part);

  /// Normalise the name of a part: without the first slash, "." and "..".
  [[nodiscard]] static std::string PartName(std::string_view target);

 private:
  ZipArchive archive_;
};

}  // namespace regrasp::object
