#pragma once

#include <random>
#include <span>
#include <string>

namespace regrasp {

/// Return the input with one to four changes: bytes flipped, deleted, duplicated or overwritten,
/// numbers replaced by extreme ones, the end cut off, or a piece of another input inserted.
///
/// Law: the same engine and inputs give the same bytes on every machine.
/// @param others  sources of inserted pieces; at least one.
[[nodiscard]] std::string Mutate(std::string input, std::span<const std::string> others,
                                 std::mt19937_64& random);

}  // namespace regrasp
