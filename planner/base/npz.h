#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace regrasp {

/// An array of an NPZ file: of numbers, or of texts where there are any.
struct NpzArray {
  std::string name;
  std::vector<std::size_t> shape;
  std::vector<double> values = {};      ///< the last index runs fastest
  std::vector<std::string> texts = {};  ///< UTF-8; a byte that is none becomes U+FFFD
  bool is_truth = false;  ///< the numbers are truth values, written as such: 0 is false
};

/// The bytes of an NPZ file as numpy.load reads it: an uncompressed ZIP archive of arrays in the
/// NPY format 1.0, numbers as <f8, truth values as |b1 and texts as <U.
///
/// Law: the same arrays give the same bytes.
/// @throws std::invalid_argument  a shape does not fit its values.
/// @throws std::length_error      the file would take more than 2 GB, half of what the format
/// allows.
[[nodiscard]] std::string FormatNpz(const std::vector<NpzArray>& arrays);

/// The array of an NPY file, as in ReadNpz.
/// @param name  of the array; stands before messages.
/// @throws InputError  what is wrong with it.
[[nodiscard]] NpzArray ReadNpy(std::string_view bytes, const std::string& name);

/// The arrays of an NPZ file as numpy.savez and numpy.savez_compressed write it: numbers and truth
/// values as doubles, in either order of indices. Nothing in it is executed: arrays of Python
/// objects, which numpy unpickles, are refused.
///
/// @param wanted  the names of arrays; others are not looked at. What is not there is left out.
/// @throws InputError  names the file, the array, and what is wrong.
[[nodiscard]] std::vector<NpzArray> ReadNpz(std::string_view bytes, const std::string& file,
                                            const std::vector<std::string>& wanted);

}  // namespace regrasp
