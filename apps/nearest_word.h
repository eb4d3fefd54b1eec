#pragma once

#include <string>
#include <vector>

namespace regrasp::apps {

/// "; did you mean --object?": the word that was probably meant; empty where none is near.
///
/// A word that begins with what was given is, and otherwise the one that the fewest insertions,
/// deletions, replacements and swaps of neighbours turn it into, at most one in three characters
/// (Damerau 1964); of equal ones the first.
[[nodiscard]] std::string DidYouMean(const std::string& given,
                                     const std::vector<std::string>& words);

}  // namespace regrasp::apps
