#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp {

/// Array of an NPZ file: numbers, or texts if there are any.
struct NpzArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<double> values = {};      ///< in row-major order
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
