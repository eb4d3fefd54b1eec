#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp {

/// The files of a ZIP archive in memory. What its headers declare is never trusted with memory.
class ZipArchive {
 public:
  /// @param bytes  outlive this object.
  /// @throws InputError  no ZIP archive.
  explicit ZipArchive(std::string_view bytes);
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  /// In the order of the archive.
  /// @throws InputError  the list is spoilt.
  [[nodiscard]] std::vector<std::string> names();

  /// The bytes of a file, of whose name capitals do not matter; nullopt where there is none.
  /// @throws InputError  its compressed data is spoilt, or there are more than `most` bytes.
  [[nodiscard]] std::optional<std::string> Read(const std::string& name, std::size_t most);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace regrasp
