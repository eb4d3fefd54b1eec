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

/// Array of an NPZ file: numbers, or texts if there are any.
struct NpzArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<double> values = {};      ///< values in row-major order
  std::vector<std::string> texts = {};  ///< UTF-8; invalid bytes become U+FFFD
  bool is_truth = false;  ///< whether the numbers are truth values and written as such: 0 is false
};

/// Format arrays as an NPZ file for numpy.load.
/// The file is an uncompressed ZIP archive of arrays in the NPY format 1.0: numbers as <f8, truth
/// values as |b1 and texts as <U.
///
/// Law: equal arrays give equal bytes.
/// @throws std::invalid_argument  if a shape does not match its values.
/// @throws std::length_error      if the file would exceed 2 GB, half of the format's limit.
[[nodiscard]] std::string FormatNpz(const std::vector<NpzArray>& arrays);

/// Read the array of an NPY file, as ReadNpz.
/// @param name  name of the array, also the prefix of messages.
/// @throws InputError  if the file is invalid.
[[nodiscard]] NpzArray ReadNpy(std::string_view bytes, const std::string& name);

/// Read arrays of an NPZ file written by numpy.savez or numpy.savez_compressed.
/// Numbers and truth values become doubles; both memory orders are supported. Arrays of Python
/// objects, which numpy unpickles, are rejected because unpickling can execute code.
/// @param wanted  names of arrays. Other arrays are ignored, missing ones are omitted.
/// @throws InputError  if the file is invalid. The message names the file and the array.
[[nodiscard]] std::vector<NpzArray> ReadNpz(std::string_view bytes, const std::string& file,
                                            const std::vector<std::string>& wanted);

}  // namespace regrasp
