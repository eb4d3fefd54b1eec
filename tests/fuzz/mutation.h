#pragma once

#include <random>
#include <span>
#include <string>

namespace regrasp {

/// The input with one to four changes: bytes flipped, cut, doubled or overwritten, numbers replaced
/// by extreme ones, the end cut off, a piece of another input put in.
///
/// Law: the same engine and inputs give the same bytes on every machine.
/// @param others  where pieces come from; at least one.
[[nodiscard]] std::string Mutate(std::string input, std::span<const std::string> others,
                                 std::mt19937_64& random);

}  // namespace regrasp
