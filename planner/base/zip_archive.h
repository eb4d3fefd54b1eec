#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp {

/// Reader of a ZIP archive in memory. Sizes in its headers are not trusted for allocation.
class ZipArchive {
 public:
  /// @param bytes  contents of the archive; outlive this object.
  /// @throws InputError  if it is not a ZIP archive.
  explicit ZipArchive(std::string_view bytes);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  /// Return the names of the files in archive order.
  /// @throws InputError  if the list of files is corrupt.
  [[nodiscard]] std::vector<std::string> names();

  /// Return the contents of a file, whose name is case-insensitive; nullopt if there is none.
  /// @param most  largest accepted number of bytes.
  /// @throws InputError  if its compressed data is corrupt or larger than `most` bytes.
  [[nodiscard]] std::optional<std::string> Read(const std::string& name, std::size_t most);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp
