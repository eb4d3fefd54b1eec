#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/base/npz.h"

namespace regrasp {

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
